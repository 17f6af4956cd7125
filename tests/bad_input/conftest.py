# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender as a program under test: its own preferences, the add-on linked in, a time limit for everything."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

HERE = Path(__file__).parent
ADDON = HERE.parents[1] / "addon" / "cardioid"
# Cycles has no duty to name what it drops; with it these tests only check the scenes themselves.
IS_CARDIOID = os.environ.get("CARDIOID_TEST_ENGINE", "CARDIOID") == "CARDIOID"


@dataclass
class Ended:
    """A Blender that ended: its exit code (negative: killed by that signal) and everything that it printed."""

    code: int
    text: str

    def check_clean(self) -> None:
        """Nothing that an artist must never see."""
        assert self.code >= 0, f"Blender died of signal {-self.code}\n{self.text[-3000:]}"
        assert "Traceback (most recent call last)" not in self.text, self.text[-3000:]


class Blender:
    """Starts Debian's Blender with preferences and scripts in a folder of its own."""

    def __init__(self, home: Path) -> None:
        self.home = home
        addons = home / "addons"
        addons.mkdir()
        (addons / "cardioid").symlink_to(ADDON)
        # Debian's Blender finds its Python by the PATH.
        path = f"/usr/bin:{os.environ['PATH']}"
        self.env = {**os.environ, "PATH": path, "BLENDER_USER_CONFIG": str(home), "BLENDER_USER_SCRIPTS": str(home)}

    def start(self, *arguments: str | Path, env: dict[str, str] | None = None) -> subprocess.Popen:
        """A running Blender; what it prints can be read from .stdout."""
        return subprocess.Popen(
            ["blender", *map(str, arguments)],
            env={**self.env, **(env or {})},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )

    def run(self, *arguments: str | Path, seconds: float = 60, env: dict[str, str] | None = None) -> Ended:
        process = self.start(*arguments, env=env)
        try:
            text, _ = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            text, _ = process.communicate()
            pytest.fail(f"Blender did not end within {seconds:.0f} s\n{text[-3000:]}")
        return Ended(process.returncode, text)

    def render_file(self, scene: Path, output: Path, *after: str, seconds: float = 60) -> Ended:
        """What an artist types: blender -b scene -E CARDIOID -o output -f 1 [-- after]. Writes <output>0001.exr."""
        arguments = ["-b", "--factory-startup", "--addons", "cardioid", scene, "-E", "CARDIOID"]
        arguments += ["-o", output, "-F", "OPEN_EXR", "-x", "1", "-f", "1"]
        return self.run(*arguments, *(["--", *after] if after else []), seconds=seconds)


@pytest.fixture(scope="session")
def blender(tmp_path_factory: pytest.TempPathFactory) -> Blender:
    if shutil.which("blender") is None:
        pytest.skip("blender is not installed")
    if IS_CARDIOID and not list(ADDON.glob("_core*.so")):
        pytest.fail("addon/cardioid has no compiled engine: scripts/test builds it")
    return Blender(tmp_path_factory.mktemp("blender"))


@dataclass
class Case:
    """What one case of cases.py gave: its result (see scene_kit.render) and what Blender printed meanwhile."""

    data: dict
    text: str

    def check_clean(self) -> None:
        Ended(0, self.text).check_clean()
        assert "trace" not in self.data, self.data["trace"]


def finished(cases: dict[str, Case], name: str, *mentions: str) -> dict:
    """The result of a case that must render; Blender's output must contain each of `mentions`."""
    assert name in cases, f"Blender did not survive until {name}; it got to {list(cases)[-1]}"
    case = cases[name]
    case.check_clean()
    assert case.data["status"] == "FINISHED", case.data["status"]
    assert case.data["finite"]
    for word in mentions if IS_CARDIOID else ():
        assert word.lower() in case.text.lower(), f"'{word}' is not in:\n{case.text}"
    return case.data


@pytest.fixture(scope="session")
def cases(blender: Blender) -> dict[str, Case]:
    """Every case of cases.py by name, from one Blender; a case that killed it is missing, and so are those after."""
    arguments = ["-b", "--factory-startup", "-noaudio", "--python", HERE / "cases.py"]
    ended = blender.run(*arguments, seconds=150)
    pattern = re.compile(r"^CASE-BEGIN (\w+)\n(.*?)^CASE-END \1 (\{.*?\})$", re.MULTILINE | re.DOTALL)
    found = {name: Case(json.loads(data), text) for name, text, data in pattern.findall(ended.text)}
    if not found:
        pytest.fail(f"no case ran; exit code {ended.code}\n{ended.text[-3000:]}")
    return found
