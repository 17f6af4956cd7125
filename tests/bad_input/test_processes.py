# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input that needs a Blender of its own: wrong options, no memory, a full disk, cancel, quitting, two at once."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

import pytest
from conftest import Blender, Ended
from live import Live

HERE = Path(__file__).parent
RENDER = ["-b", "--factory-startup", "-noaudio", "--addons", "cardioid"]
STAGES = {"export": r"Exporting", "build": r"Building|Embree", "sampling": r"Sample \d"}
# Seconds from the signal until the process is gone: Blender's own way out included, on a busy machine.
PROMPT = 5.0


@pytest.fixture(scope="session")
def files(blender: Blender, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with the scenes of make_files.py."""
    folder = tmp_path_factory.mktemp("scenes")
    ended = blender.run("-b", "--factory-startup", "-noaudio", "--python", HERE / "make_files.py", "--", folder)
    assert (folder / "huge.blend").exists(), ended.text[-3000:]
    return folder


def start(blender: Blender, scene: Path, output: Path) -> Live:
    return Live(blender.start(*RENDER, scene, "-E", "CARDIOID", "-o", output, "-F", "OPEN_EXR", "-f", "1"))


def test_a_good_file_renders(blender: Blender, files: Path, tmp_path: Path) -> None:
    ended = blender.render_file(files / "plain.blend", tmp_path / "p_####")
    ended.check_clean()
    assert (tmp_path / "p_0001.exr").exists(), ended.text
    assert "Error" not in ended.text


@pytest.mark.parametrize(
    ("option", "value", "message"),
    [
        ("--cardioid-samples", "0", "at least 1"),
        ("--cardioid-samples", "many", "many"),
        ("--cardioid-threads", "-3", "-3"),
        ("--cardioid-integrator", "MAGIC", "MAGIC"),
        ("--cardioid-time-limit", "nan", "nan"),
        ("--cardioid-photons", "-1", "at least 0"),
        ("--cardioid-caustic-roughness", "2", "from 0 to 1"),
        ("--cardioid-indirect-caustics", "perhaps", "photons, path_tracing, off"),
        ("--cardioid-sampels", "4", "no such option"),
    ],
)
def test_wrong_options_are_one_error(blender, files, tmp_path, option: str, value: str, message: str) -> None:
    ended = blender.render_file(files / "plain.blend", tmp_path / "p_####", option, value)
    ended.check_clean()
    errors = [line for line in ended.text.splitlines() if line.startswith("Error: Cardioid")]
    assert len(errors) == 1, ended.text
    assert option in errors[0] and message in errors[0]


def test_a_picture_that_does_not_fit_memory_is_an_error_first(blender, files, tmp_path) -> None:
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if memory > 48 << 30:
        pytest.skip("this machine has memory for 16 000 x 16 000 pixels")
    ended = blender.render_file(files / "huge.blend", tmp_path / "p_####", seconds=60)
    ended.check_clean()
    errors = [line for line in ended.text.splitlines() if line.startswith("Error: Cardioid")]
    assert len(errors) == 1, ended.text[-3000:]
    assert re.search(r"needs about [\d.]+ GB.*16000.*this machine has [\d.]+ GB", errors[0]), errors[0]
    assert "Sample 1" not in ended.text


def test_photons_that_do_not_fit_memory_are_an_error_first(blender, files, tmp_path) -> None:
    photons = "--cardioid-photons", str(10**9)
    ended = blender.render_file(files / "caustic.blend", tmp_path / "p_####", *photons, seconds=60)
    ended.check_clean()
    errors = [line for line in ended.text.splitlines() if line.startswith("Error: Cardioid")]
    assert len(errors) == 1, ended.text[-3000:]
    assert re.search(r"needs about [\d.]+ GB.*photons.*memory limit is 4.0 GB", errors[0]), errors[0]
    assert "Sample 1" not in ended.text and not list(tmp_path.glob("p_*"))


@pytest.fixture
def full_disk(tmp_path: Path):
    """A folder on a file system without a free byte."""
    folder = tmp_path / "full"
    folder.mkdir()
    if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", folder]).returncode != 0:
        pytest.skip("only root can mount a small disk")
    try:
        with contextlib.suppress(OSError), (folder / "filler").open("wb", buffering=0) as filler:
            while True:
                filler.write(bytes(4096))
        yield folder
    finally:
        subprocess.run(["umount", folder], check=True)


def test_a_full_disk_is_named(blender, files, full_disk: Path) -> None:
    ended = blender.render_file(files / "plain.blend", full_disk / "p_####")
    ended.check_clean()
    assert "No space left on device" in ended.text


def test_statistics_on_a_full_disk_do_not_cost_the_picture(blender, files, full_disk: Path, tmp_path: Path) -> None:
    stats = full_disk / "stats.json"
    ended = blender.render_file(files / "plain.blend", tmp_path / "p_####", "--cardioid-stats", str(stats))
    ended.check_clean()
    assert (tmp_path / "p_0001.exr").exists()
    assert any("Cardioid" in line and "stats.json" in line for line in ended.text.splitlines()), ended.text
    assert not stats.exists() or stats.stat().st_size == 0


@pytest.mark.parametrize("stage", STAGES)
def test_cancel_ends_promptly(blender, files, tmp_path, stage: str) -> None:
    """Ctrl-C is the Esc of a background render; a second one would kill Blender, one must be enough."""
    scene = "endless" if stage == "sampling" else "heavy"
    with start(blender, files / f"{scene}.blend", tmp_path / "p_####") as live:
        live.wait_for(STAGES[stage], 60)
        live.send(signal.SIGINT)
        live.wait_for_end(PROMPT)
    Ended(live.process.returncode, live.text).check_clean()
    assert "Sent an internal break event" in live.text


def test_a_killed_render_leaves_no_process(blender, files, tmp_path) -> None:
    with start(blender, files / "endless.blend", tmp_path / "p_####") as live:
        live.wait_for(STAGES["sampling"], 60)
        live.send(signal.SIGTERM)
        live.wait_for_end(PROMPT)


def test_python_exit_while_a_session_runs(blender, files) -> None:
    """A script that leaves Blender in the middle of a render: sys.exit in a handler, session and threads alive."""
    with Live(blender.start(*RENDER, files / "endless.blend", "--python", HERE / "leave_while_rendering.py")) as live:
        live.wait_for("LEAVING", 60)
        live.wait_for_end(PROMPT)
    assert live.process.returncode == 7, live.text[-3000:]


def test_two_blenders_at_once(blender, files, tmp_path) -> None:
    with contextlib.ExitStack() as stack:
        outputs = [tmp_path / f"{name}_####" for name in "ab"]
        both = [stack.enter_context(start(blender, files / "plain.blend", output)) for output in outputs]
        for live in both:
            live.wait_for_end(60)
            Ended(live.process.returncode, live.text).check_clean()
    assert (tmp_path / "a_0001.exr").read_bytes()[:4] == (tmp_path / "b_0001.exr").read_bytes()[:4] == b"v/1\x01"


@pytest.mark.skipif(not shutil.which("xvfb-run"), reason="needs Xvfb")
def test_window_second_render_and_quitting(blender, files) -> None:
    """In a window: a second F12 is refused while one runs, and quitting in the middle of a render ends promptly."""
    inner = ["blender", *RENDER[1:], "--window-geometry", "0", "0", "640", "480"]
    inner += [str(files / "endless.blend"), "--python", str(HERE / "window.py")]
    command = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24 +extension GLX", *inner]
    env = {**blender.env, "LIBGL_ALWAYS_SOFTWARE": "1"}
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    process = subprocess.Popen(command, env=env, text=True, errors="replace", start_new_session=True, **pipes)
    with Live(process) as live:
        live.wait_for("QUITTING", 120)
        live.wait_for_end(20)
    assert "SECOND CANCELLED" in live.text, live.text[-3000:]
    assert live.process.returncode == 0, live.text[-3000:]


