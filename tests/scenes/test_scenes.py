# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of scenes/: small, whole in themselves, built by a script, told in the README, and they render."""

from __future__ import annotations

import gzip
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted((ROOT / "scenes").glob("*.blend"))
LARGEST = 2_500_000
MACHINE_PATHS = re.compile(rb"/(?:home|root|work|Users|mnt|opt)/[\w./-]*|\b[A-Z]:\\(?:Users|Windows)\\")
each_scene = pytest.mark.parametrize("scene", SCENES, ids=lambda path: path.stem)


@pytest.fixture(scope="session")
def opened(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[str, dict]]:
    """What Blender printed for each file and the facts of open_scenes.py, by the file's name; from one Blender."""
    if shutil.which("blender") is None:
        pytest.skip("blender is not installed")
    if not list((ROOT / "addon" / "cardioid").glob("_core*.so")):
        pytest.fail("addon/cardioid has no compiled engine: scripts/test builds it")
    home = tmp_path_factory.mktemp("blender")
    (home / "addons").mkdir()
    (home / "addons" / "cardioid").symlink_to(ROOT / "addon" / "cardioid")
    own = {
        "BLENDER_USER_CONFIG": str(home),
        "BLENDER_USER_SCRIPTS": str(home),
        "PATH": f"/usr/bin:{os.environ['PATH']}",
    }
    command = ["blender", "-b", "--factory-startup", "-noaudio", "--addons", "cardioid", "--python-exit-code", "1"]
    command += ["--python", str(Path(__file__).with_name("open_scenes.py")), "--", *map(str, SCENES)]
    ended = subprocess.run(command, env={**os.environ, **own}, capture_output=True, text=True, timeout=240, check=False)
    parts = re.findall(r"^SCENE-BEGIN (\S+)\n(.*?)^SCENE-END \1 (\{.*?\})$", ended.stdout, re.MULTILINE | re.DOTALL)
    assert parts, ended.stdout[-3000:] + ended.stderr[-3000:]
    return {name: (text, json.loads(found)) for name, text, found in parts}


def facts(opened: dict, scene: Path) -> dict:
    assert scene.name in opened, f"Blender did not get past {scene.name}"
    return opened[scene.name][1]


@each_scene
def test_the_file_is_whole_in_itself(opened, scene: Path) -> None:
    assert facts(opened, scene)["outside"] == []


@each_scene
def test_the_file_is_small_and_names_no_machine(scene: Path) -> None:
    assert scene.stat().st_size <= LARGEST
    assert MACHINE_PATHS.findall(gzip.decompress(scene.read_bytes())) == []


@each_scene
def test_it_renders_without_a_warning(opened, scene: Path) -> None:
    found = facts(opened, scene)
    assert found["camera"] and found["finite"]
    assert found["mean"] > 0.005 and found["spread"] > 0.005
    said = [line for line in opened[scene.name][0].splitlines() if re.search(r"warning|error|traceback", line, re.I)]
    assert said == []


@each_scene
def test_a_script_builds_it_and_the_readme_tells_it(scene: Path) -> None:
    assert (ROOT / "scenes" / f"build_{scene.stem}.py").is_file()
    assert f"`{scene.name}`" in (ROOT / "scenes" / "README.md").read_text()
