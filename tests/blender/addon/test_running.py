# SPDX-License-Identifier: GPL-3.0-or-later
"""While a render runs: cancel, progress, pictures, warnings, failures, a second render."""

from __future__ import annotations

import re
import threading
import time

import bpy
import conftest
import fresh_blender
import numpy as np
import pictures
import pytest


class StopAfter:
    """Stands in for Esc: test_break answers True from `seconds` after the first sample on."""

    def __init__(self, fake, seconds):
        self.pressed_at = None
        self.asked = []
        self._seconds = seconds
        self._first = None
        fake.behaviour.on_sample = self._sample

    def _sample(self, _session):
        self._first = self._first or time.monotonic()

    def __call__(self, *_):
        now = time.monotonic()
        self.asked.append(now)
        if self._first and now - self._first >= self._seconds:
            self.pressed_at = self.pressed_at or now
            return True
        return False


class Watched:
    """A render engine of Blender with some of its functions replaced (Blender's own cannot be patched)."""

    def __init__(self, engine, replaced):
        self.__dict__.update(_engine=engine, **replaced)

    def __getattr__(self, name):
        return getattr(self._engine, name)


@pytest.fixture
def replaced(addon, monkeypatch):
    """Functions by name that stand in for the engine's in final renders."""
    functions = {}
    original = addon.final_render.render
    monkeypatch.setattr(addon.final_render, "render",
                        lambda engine, depsgraph: original(Watched(engine, functions), depsgraph))
    return functions


@pytest.fixture
def reports(replaced):
    """What the engine reported, as (kind, text)."""
    told = []
    replaced["report"] = lambda kind, text: told.append((next(iter(kind)), text))
    return told


@pytest.fixture
def status(replaced):
    told = []
    replaced["update_stats"] = lambda stats, info: told.append(info)
    return told


def test_esc_stops_within_a_quarter_second_and_keeps_the_picture(addon, fake, render, replaced):
    bpy.context.scene.cardioid.samples = 100000
    fake.behaviour.sample_seconds = 0.01
    stop = replaced["test_break"] = StopAfter(fake, 0.5)
    channels = render()
    session, pressed = fake.sessions[-1], stop.pressed_at
    assert session.cancelled_at - pressed < 0.1
    assert time.monotonic() - pressed < 1.0
    assert session.finished_at - pressed < 0.25
    assert 1 <= channels["ViewLayer.Combined.B"].max() < 100000
    gaps = np.diff(stop.asked)
    assert gaps.max() < 0.25, "Esc must be looked for several times a second"


def test_esc_during_export_renders_nothing(addon, fake, replaced):
    replaced["test_break"] = lambda: True
    bpy.ops.render.render()
    assert not fake.sessions


def test_esc_during_build(addon, fake, replaced):
    fake.behaviour.build_seconds = 30
    start = time.monotonic()
    replaced["test_break"] = lambda: time.monotonic() - start > 0.4
    bpy.ops.render.render()
    assert time.monotonic() - start < 1.5 and fake.sessions[-1].frame() is None


def test_a_render_stopped_before_its_first_picture_is_saved_as_black(addon, fake, monkeypatch, tmp_path):
    """Without passes in its result Blender 3.4 crashes when it writes the file."""
    fake.behaviour.build_seconds = 60
    monkeypatch.setattr(fake.Session, "start", lambda self: (self._thread.start(), self.cancel()))
    picture = pictures.render(tmp_path / "black", False)
    assert fake.sessions[-1].frame() is None
    assert picture["R"].shape == (24, 40) and not picture["R"].any()


def test_pictures_come_while_it_renders(addon, fake, monkeypatch):
    shown = []
    original = addon.render_result.Target.show
    monkeypatch.setattr(addon.render_result.Target, "show",
                        lambda self, frame: (shown.append(frame.samples), original(self, frame)))
    bpy.context.scene.cardioid.samples = 60
    fake.behaviour.sample_seconds = 0.02
    bpy.ops.render.render()
    assert len(shown) >= 4 and shown == sorted(shown) and shown[-1] == 60 and shown[0] < 20


def test_progress_text(addon, fake, status):
    bpy.context.scene.cardioid.samples = 128
    fake.behaviour.sample_seconds = 0.02
    fake.behaviour.build_seconds = 0.1
    bpy.ops.render.render()
    assert status[0] == "Exporting the scene"
    running = [text for text in status if "Remaining" in text and "Pass" in text]
    assert running and re.fullmatch(r"Sample \d+/128 · Pass \d+ · photons [\d.]+ [kM] stored of [\d.]+ [kM] · "
                                    r"Remaining 0:43 · Mem 512M", running[0]), status
    assert status[-1] == "Sample 128/128 · Pass 64 · photons 4.8 M stored of 32 M · Mem 512M" and len(status) < 40


def test_words(addon):
    from cardioid import progress

    assert progress.duration(43.2) == "0:43" and progress.duration(7261) == "2:01:01"
    assert [progress.count(number) for number in (0, 999, 1000, 8_140, 81_400, 999_600, 8.1e6, 1.23e9)] == [
        "0", "999", "1.0 k", "8.1 k", "81 k", "1.0 M", "8.1 M", "1.2 G"]
    assert progress.memory(512 << 20) == "512M" and progress.memory(20 << 30) == "20.0G"
    assert progress.line({"phase": "build", "message": "Building BVH"}) == "Building BVH"
    assert progress.line({}) == ""
    running = {"phase": "render", "samples": 12, "total_samples": 128, "remaining": 43.0}
    assert progress.line(running) == "Sample 12/128 · Remaining 0:43"
    assert progress.line({**running, "passes": 5, "photons_emitted": 8_100_000, "photons_stored": 1_200_000}) == (
        "Sample 12/128 · Pass 5 · photons 1.2 M stored of 8.1 M · Remaining 0:43")


def test_warnings_once_in_a_job(addon, fake, reports, tmp_path):
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 3
    scene.render.filepath = str(tmp_path / "f_")
    fake.behaviour.warnings = ["Material “Glass”: node “Toon BSDF” is not supported", "Image “a.png” is missing"]
    bpy.ops.render.render(animation=True)
    assert [text for kind, text in reports if kind == "WARNING"] == [
        f"Cardioid: {warning}" for warning in fake.behaviour.warnings]
    bpy.ops.render.render()
    assert len(reports) == 4  # a new job tells them again


def test_refused_scene(addon, fake):
    fake.behaviour.refuse = [f"Object “Cube.{number}” has a problem" for number in range(9)]
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.render.render()
    assert "Cube.0" in str(caught.value) and "and 4 more" in str(caught.value)
    assert "Traceback" not in str(caught.value)


def test_failed_render(addon, fake):
    fake.behaviour.fail = "the texture cache is full"
    with pytest.raises(RuntimeError, match="Cardioid: the texture cache is full"):
        bpy.ops.render.render()


def test_a_fault_of_the_addon_is_one_sentence(addon, fake, monkeypatch):
    monkeypatch.setattr(fake.Session, "progress", lambda self: 1 / 0)
    with pytest.raises(RuntimeError, match="fault in the add-on: ZeroDivisionError") as caught:
        bpy.ops.render.render()
    assert "Traceback" not in str(caught.value) and str(caught.value).strip().count("\n") == 0
    assert fake.sessions[-1].cancelled_at is not None


def test_wrong_size_of_picture(addon, fake, monkeypatch):
    monkeypatch.setattr(fake.Session, "frame", lambda self: fake.Frame((7, 5), 1))
    with pytest.raises(RuntimeError, match="7 x 5 pixels and Blender expects 40 x 24"):
        bpy.ops.render.render()


def test_no_camera(addon, fake):
    bpy.context.scene.camera = None
    with pytest.raises(RuntimeError, match=r"[Cc]amera"):
        bpy.ops.render.render()


def test_second_render_at_once(addon, fake):
    from cardioid import sessions

    with sessions.exclusive(preview=False):
        with pytest.raises(RuntimeError, match="Another Cardioid render is still running"):
            bpy.ops.render.render()
        with sessions.exclusive(preview=True):
            pass
    bpy.ops.render.render()
    assert len(fake.sessions) == 1


def test_sessions_are_not_kept(addon, fake):
    from cardioid import sessions

    for _ in range(3):
        bpy.ops.render.render()
    assert not sessions._running and threading.active_count() < 20


def test_cancel_all_reaches_a_running_session(addon, fake, monkeypatch):
    from cardioid import sessions

    bpy.context.scene.cardioid.samples = 100000
    fake.behaviour.sample_seconds = 0.01
    timer = threading.Timer(0.5, sessions.cancel_all)
    timer.start()
    start = time.monotonic()
    bpy.ops.render.render()
    assert time.monotonic() - start < 2


def test_material_preview_is_quick_and_silent(addon, fake, replaced, reports, status):
    """The preview of a material: is_preview engines get few samples, no status line and no warnings."""
    fake.behaviour.warnings = ["something"]
    replaced["is_preview"] = True
    bpy.context.scene.cardioid.samples = 500
    bpy.ops.render.render()
    assert fake.scenes[-1].settings["samples"] <= 32 and not reports and not status


k_quit_script = """
scene = use("fake")
fake_engine.behaviour.sample_seconds = 0.01
scene.render.resolution_x = scene.render.resolution_y = 16
scene.cardioid.samples = 10000000
def quit():
    while not fake_engine.sessions:
        time.sleep(0.05)
    time.sleep(0.3)
    cardioid.sessions.cancel_all()
threading.Thread(target=quit, daemon=True).start()
bpy.ops.render.render()
print("LEFT", fake_engine.sessions[0].cancelled_at is not None, flush=True)
sys.exit(0)
"""


def test_blender_quits_while_rendering(tmp_path):
    """The whole process ends by itself, with a render cut off, within seconds."""
    done = fresh_blender.run(tmp_path / "quit.py", k_quit_script)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "LEFT True" in done.stdout and "Traceback" not in done.stdout + done.stderr


k_animation_script = """
scene = use({engine!r})
scene.render.resolution_x, scene.render.resolution_y = 200, 120
scene.cardioid.samples = scene.cardioid.threads = 1
scene.frame_start, scene.frame_end = 1, 200
scene.render.filepath = {folder!r} + "/f_"
resident = []
def note(*_):
    fake_engine.scenes.clear()
    fake_engine.sessions.clear()
    resident.append(int(open("/proc/self/statm").read().split()[1]) * 4096 >> 10)
bpy.app.handlers.render_post.append(note)
bpy.ops.render.render(animation=True)
print("RESIDENT", *resident, "THREADS", len(os.listdir("/proc/self/task")), flush=True)
os._exit(0)
"""


@pytest.mark.parametrize("engine", ["fake", pytest.param("real", marks=conftest.needs_engine)])
def test_flat_memory_over_an_animation(engine, tmp_path):
    """In a process of its own and with one thread: several leave the allocator's arenas a step of 6 MB up or down."""
    script = k_animation_script.format(engine=engine, folder=str(tmp_path / "frames"))
    done = fresh_blender.run(tmp_path / "animation.py", script, 200)
    line = next((line for line in done.stdout.splitlines() if line.startswith("RESIDENT")), done.stdout + done.stderr)
    kilobytes = [int(word) for word in line.split("THREADS")[0].split()[1:]]
    assert len(kilobytes) == 200, line
    assert kilobytes[-1] - kilobytes[100] < 4096, kilobytes
    assert int(line.split("THREADS")[1]) < 40
