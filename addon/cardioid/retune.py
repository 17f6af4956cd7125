# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets a finished picture follow its filter. Blender's render result can be written by a render alone, so a change
starts one that neither exports nor traces: it filters the kept films and fills the result, which the compositor, the
Image Editor and Save As then have. It stays open for a moment, so that one such render serves a slider while it is
being dragged.

`changed` and `start` belong to the main thread; `current` is what the render thread asks.
"""

from __future__ import annotations

import threading
import time
from typing import Any

import bpy
from bpy.app.handlers import persistent

from . import cli_args, film_images, films, frame_size, resolve, windows

k_engine = "CARDIOID"
k_debounce_seconds = 0.15  # after the last change before work starts
k_linger_seconds = 0.5     # for further changes before the compositor gets its turn
k_tick_seconds = 0.1
k_lost_ticks = 50          # without a render job after which a render that never began is given up
k_busy = "Another job is running"
k_drawing = "in this state (drawing/rendering)"  # Blender's words while another thread is in Python for it


class Work:
    """A render that only filters. wanted: the latest settings. share: done of the film that is being filtered.
    missed: ticks without a job. failure: why the filter failed."""

    def __init__(self, scene: bpy.types.Scene, linger: float):
        self.scene = scene.name
        self.wanted = wanted_settings(scene)
        self.threads = resolve.threads(scene)
        self.linger = linger
        self.share = 0.0
        self.missed = 0
        self.failure = ""

    def settings_for(self, scene: str, kept: films.Kept) -> dict[str, Any]:
        """Other scenes that the compositor asks for stay as they are."""
        return self.wanted if scene == self.scene else kept.settings


_work: Work | None = None
_ending = threading.Lock()        # so that no change falls between the last look at it and the end of the work
_pending: dict[str, float] = {}   # scene: when it was changed last
_problems: dict[str, str] = {}    # scene: why its picture does not follow


def current() -> Work | None:
    """The render that only filters, while there is one."""
    return _work


def state(scene: str) -> tuple[str, float]:
    """For the panel: "filtering" and the share done, "waiting", or ""."""
    work = _work
    if work is not None and work.scene == scene:
        return "filtering", work.share
    return ("waiting" if scene in _pending else ""), 0.0


def problem(scene: str) -> str:
    """Why the picture did not follow the last change."""
    return _problems.get(scene, "")


def wanted_settings(scene: bpy.types.Scene) -> dict[str, Any]:
    return resolve.filter_settings(scene, cli_args.current().overrides)


def is_out_of_date(scene: bpy.types.Scene) -> bool:
    """The picture was filtered with other settings than the scene has now."""
    wanted = wanted_settings(scene)
    return any(kept.settings != wanted for kept in films.of_scene(scene.name).values())


def changed(scene: bpy.types.Scene) -> None:
    """The filter's settings of the scene may have changed."""
    if scene.cardioid.live_filter and not bpy.app.background:
        film_images.follow(scene)
    if not films.of_scene(scene.name):
        return
    if not _told_to_work(scene) and _may_follow(scene):
        _pending[scene.name] = time.monotonic()
        _start_timer()


def _told_to_work(scene: bpy.types.Scene) -> bool:
    """The render that filters this scene, if there is one, knows what is wanted now."""
    wanted = wanted_settings(scene)
    with _ending:
        mine = _work is not None and _work.scene == scene.name
        if mine:
            _work.wanted = wanted
    return mine


def _may_follow(scene: bpy.types.Scene) -> bool:
    return not bpy.app.background and scene.cardioid.live_filter and windows.showing_result(scene) is not None and (
        is_out_of_date(scene))


def obstacle(scene: bpy.types.Scene, layer: str) -> str:
    """Why the scene's picture cannot be filtered again, as a sentence; empty: it can. layer: the active one."""
    kept = films.of_scene(scene.name)
    if scene.render.engine != k_engine:
        return "Cardioid is not the render engine"
    if not kept:
        return "There is no film to filter: render first, or open one"
    if _uses_strips(scene):
        return "The picture comes from the Video Sequencer: render again to filter it"
    layers = {layer} if scene.render.use_single_layer else {one.name for one in scene.view_layers if one.use}
    several = {view for _, view in kept} != {""}
    if layers - {name for name, _ in kept} or several != scene.render.use_multiview:
        return "View layers or views have changed since the film was made: render again"
    shape = frame_size.shape(scene.render)
    if any(one.shape != shape for one in kept.values()):
        return "The size or border of the frame has changed since the film was made: render again"
    return ""


def _uses_strips(scene: bpy.types.Scene) -> bool:
    editor = scene.sequence_editor
    if editor is None or not scene.render.use_sequencer:
        return False
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    return any(strip.type != "SOUND" and not strip.mute for strip in strips)


def start(scene: bpy.types.Scene, *, write_still: bool = False) -> str:
    """Filters the scene's films into the render result: at once in the background, as a job in a window. What is in the
    way, as a sentence; empty when all is well."""
    global _work
    window = windows.of_scene(scene)
    layer = window.view_layer if window else bpy.context.view_layer
    found = obstacle(scene, layer.name)
    if found:
        return found
    if bpy.app.is_job_running("RENDER"):
        return k_busy
    _pending.pop(scene.name, None)
    _problems.pop(scene.name, None)
    _work = Work(scene, k_linger_seconds if window else 0.0)
    try:
        if window is None:
            bpy.ops.render.render(scene=scene.name, write_still=write_still)
            _work = None
        elif "RUNNING_MODAL" in windows.render(window, scene):
            _start_timer()
        else:
            _work = None
            return k_busy
    except RuntimeError as error:
        _work = None
        return k_busy if k_drawing in str(error) else _reason(error)
    return ""


def _reason(error: RuntimeError) -> str:
    """What Blender or the engine says, without who says it."""
    return str(error).removeprefix("Error: ").removeprefix("Cardioid: ").strip()


def _start_timer() -> None:
    if not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=k_tick_seconds)


def _tick() -> float | None:
    """Starts what is due, and shows in the panels how it goes."""
    global _work
    windows.redraw_panels()
    work = _work  # the render thread may end it meanwhile
    if work is not None:
        work.missed = 0 if bpy.app.is_job_running("RENDER") else work.missed + 1
        if work.missed > k_lost_ticks:
            _work = None
    for name, since in list(_pending.items()):
        scene = bpy.data.scenes.get(name)
        if scene is None:
            _pending.pop(name, None)
        elif _work is None and time.monotonic() - since >= k_debounce_seconds:
            _pending.pop(name, None)
            found = start(scene)
            if found == k_busy:
                _pending[name] = time.monotonic()
            else:
                _problems[name] = found
    return k_tick_seconds if _work is not None or _pending else None


@persistent
def _render_begins(scene: bpy.types.Scene, *_arguments) -> None:
    """A render that traces makes the old films useless: their memory is for the new one."""
    if _work is None:
        films.drop(scene.name)
        films.drop_orphans()
        _pending.pop(scene.name, None)
        _problems.pop(scene.name, None)


@persistent
def _render_ends(scene: bpy.types.Scene, *_arguments) -> None:
    """Called by the render thread: a change that came too late is left to the timer."""
    global _work
    with _ending:
        if _work is not None and _work.scene == scene.name:
            wanted = _work.wanted
            if _work.failure:
                _problems[scene.name] = _work.failure  # and would fail again
            elif any(kept.settings != wanted for kept in films.of_scene(scene.name).values()):
                _pending[scene.name] = time.monotonic()
            _work = None


@persistent
def _render_stopped(scene: bpy.types.Scene, *_arguments) -> None:
    """By the artist, who does not want it to begin again, or by a failure."""
    global _work
    if _work is not None and _work.scene == scene.name:
        if _work.failure:
            _problems[scene.name] = _work.failure
        _work = None


@persistent
def _undone(scene: bpy.types.Scene, *_arguments) -> None:
    """Undo changes settings without telling."""
    for one in bpy.data.scenes:
        if films.of_scene(one.name):
            changed(one)


_handlers = (("render_init", _render_begins), ("render_complete", _render_ends), ("render_cancel", _render_stopped),
             ("undo_post", _undone), ("redo_post", _undone))


def register() -> None:
    for name, handler in _handlers:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    global _work
    for name, handler in _handlers:
        getattr(bpy.app.handlers, name).remove(handler)
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
    _work = None
    _pending.clear()
    _problems.clear()
