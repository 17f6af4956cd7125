# SPDX-License-Identifier: GPL-3.0-or-later
"""When a finished picture follows its filter: what starts a render that only filters, and what keeps it waiting.
Windows and Blender's jobs are pretended; test_window.py has a real one."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest


class Desk:
    """A window that shows the render result, and the render jobs that were asked for."""

    def __init__(self):
        self.shows = True
        self.answer = {"RUNNING_MODAL"}
        self.job_running = False
        self.started = []

    def showing_result(self, scene):
        return SimpleNamespace(view_layer=scene.view_layers[0]) if self.shows else None

    of_scene = showing_result

    def render(self, window, scene):
        self.started.append(scene.cardioid.filter_size)
        if isinstance(self.answer, Exception):
            raise self.answer
        self.job_running = self.answer == {"RUNNING_MODAL"}
        return self.answer

    def redraw_panels(self):
        """Nothing is drawn."""


@pytest.fixture
def desk(addon, fake, monkeypatch):
    """A finished render in a pretended window; no time passes before a change is taken up."""
    from cardioid import films, retune

    bpy.ops.render.render()
    pretended = Desk()
    app = SimpleNamespace(background=False, is_job_running=lambda kind: pretended.job_running,
                          timers=SimpleNamespace(is_registered=lambda tick: True))
    monkeypatch.setattr(retune, "windows", pretended)
    monkeypatch.setattr(retune, "bpy", SimpleNamespace(app=app, data=bpy.data, context=bpy.context, ops=bpy.ops))
    monkeypatch.setattr(retune, "k_debounce_seconds", 0.0)
    yield pretended
    retune._work = None
    retune._pending.clear()
    films.clear()


def tick():
    from cardioid import retune

    return retune._tick()


def end_job(desk, settings=None):
    """The job ends, having shown these settings (as they are now)."""
    from cardioid import films, retune

    films.get("Scene", "ViewLayer", "").settings = settings or retune.wanted_settings(bpy.context.scene)
    desk.job_running = False
    call_handlers("render_complete")


def call_handlers(name):
    for handler in getattr(bpy.app.handlers, name):
        if handler.__module__ == "cardioid.retune":
            handler(bpy.context.scene, None)


def test_a_change_starts_one_job(desk):
    from cardioid import retune

    scene = bpy.context.scene
    scene.cardioid.filter_size = 5
    assert not desk.started and retune.state("Scene") == ("waiting", 0.0)
    tick()
    assert desk.started == [5] and retune.current().wanted["filter_size"] == 5
    scene.cardioid.filter_size = 7  # goes to the job that runs
    assert tick() is not None
    assert desk.started == [5] and retune.current().wanted["filter_size"] == 7
    end_job(desk)
    assert retune.current() is None and tick() is None and desk.started == [5]


def test_a_change_that_the_job_missed_starts_another(desk):
    from cardioid import films

    bpy.context.scene.cardioid.filter_size = 5
    tick()
    shown = films.get("Scene", "ViewLayer", "").settings | {"filter_size": 5}
    bpy.context.scene.cardioid.filter_size = 9
    end_job(desk, shown)
    tick()
    assert desk.started == [5, 9]


def test_a_failure_is_told_and_not_tried_again(desk):
    from cardioid import films, retune

    bpy.context.scene.cardioid.filter_size = 5
    tick()
    retune.current().failure = "there is not enough memory to filter"
    end_job(desk, {**films.get("Scene", "ViewLayer", "").settings, "use_filter": False})
    assert tick() is None and desk.started == [5] and "not enough memory" in retune.problem("Scene")


def test_esc_does_not_start_another(desk):
    from cardioid import films, retune

    bpy.context.scene.cardioid.filter_size = 5
    tick()
    films.get("Scene", "ViewLayer", "").settings = {"use_filter": False}
    desk.job_running = False
    call_handlers("render_cancel")
    assert retune.current() is None and tick() is None and desk.started == [5]


@pytest.mark.parametrize("what", ["unseen", "not live", "unchanged", "no film", "another setting"])
def test_nothing_to_follow(desk, what):
    from cardioid import films

    scene = bpy.context.scene
    if what == "unseen":
        desk.shows = False
    if what == "not live":
        scene.cardioid.live_filter = False
    if what == "no film":
        films.clear()
    if what == "another setting":
        scene.cardioid.samples = 9
    else:
        scene.cardioid.filter_size = 11 if what == "unchanged" else 5
    tick()
    assert not desk.started


def test_it_waits_for_other_jobs(desk):
    """A render of the artist's, one that Blender refuses, and Blender's refusal while another thread is in Python."""
    from cardioid import retune

    desk.job_running = True
    bpy.context.scene.cardioid.filter_size = 5
    assert tick() is not None and not desk.started
    desk.job_running = False
    desk.answer = {"CANCELLED"}
    assert tick() is not None and desk.started == [5] and retune.current() is None
    desk.answer = RuntimeError("Calling operator error, can't modify blend data in this state (drawing/rendering)")
    assert tick() is not None and retune.current() is None
    desk.answer = {"RUNNING_MODAL"}
    tick()
    assert desk.started == [5, 5, 5] and retune.current() is not None and retune.problem("Scene") == ""


def test_what_blender_says_is_kept_for_the_panel(desk):
    from cardioid import retune

    desk.answer = RuntimeError('Error: No camera found in scene "Scene"')
    bpy.context.scene.cardioid.filter_size = 5
    assert tick() is None
    assert retune.problem("Scene") == 'No camera found in scene "Scene"' and retune.current() is None
    desk.answer = {"RUNNING_MODAL"}
    bpy.context.scene.cardioid.filter_size = 7
    tick()
    assert retune.problem("Scene") == ""


def test_a_job_that_never_begins_is_given_up(desk):
    from cardioid import retune

    bpy.context.scene.cardioid.filter_size = 5
    tick()
    for _ in range(retune.k_lost_ticks):
        tick()
    assert retune.current() is not None
    desk.job_running = False
    for _ in range(retune.k_lost_ticks + 1):
        tick()
    assert retune.current() is None


def test_f12_in_between_traces(desk, fake):
    """A render that the artist starts is none of ours, and takes the place of what was due."""
    from cardioid import films, retune

    bpy.context.scene.cardioid.filter_size = 5
    bpy.ops.render.render()
    assert len(fake.sessions) == 2 and retune.state("Scene") == ("", 0.0)
    assert films.get("Scene", "ViewLayer", "").settings["filter_size"] == 5 and tick() is None and not desk.started


def test_undo_is_a_change(desk):
    from cardioid import films

    films.get("Scene", "ViewLayer", "").settings["filter_size"] = 5
    call_handlers("undo_post")
    tick()
    assert desk.started == [11]


def test_the_sequencers_picture_is_refused(desk):
    from cardioid import retune

    scene = bpy.context.scene
    editor = scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    extent = {"length": 10} if bpy.app.version >= (5, 0) else {"frame_end": 10}
    strips.new_effect("Colour", "COLOR", 1, 1, **extent)
    assert "Sequencer" in retune.obstacle(scene, "ViewLayer")
    scene.render.use_sequencer = False
    assert retune.obstacle(scene, "ViewLayer") == ""


def test_one_layer_of_several(desk):
    from cardioid import retune

    scene = bpy.context.scene
    scene.view_layers.new("Second")
    assert retune.obstacle(scene, "ViewLayer")
    scene.render.use_single_layer = True
    assert retune.obstacle(scene, "ViewLayer") == "" and retune.obstacle(scene, "Second")
