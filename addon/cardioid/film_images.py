# SPDX-License-Identifier: GPL-3.0-or-later
"""Opened films that do not fit the scene's frame: each is shown in an image datablock, which follows the filter too."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from . import cli_args, core, films, resolve, windows
from .refilter import Refilter

k_tick_seconds = 0.1

_works: dict[str, Refilter] = {}  # by the name of the image
_problems: dict[str, str] = {}


def show(scene: bpy.types.Scene, kept: films.Kept, name: str) -> bpy.types.Image:
    """A new image for the film. It fills when the filter has run: at once in the background."""
    width, height = kept.film.width, kept.film.height
    image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    image.use_view_as_render = True
    films.show_in_image(image.name, kept)
    follow(scene)
    if bpy.app.background:
        _finish(image.name)
    return image


def follow(scene: bpy.types.Scene) -> None:
    """Filters every opened film by the settings of the scene."""
    wanted = resolve.filter_settings(scene, cli_args.current().overrides)
    for kept in films.opened():
        work = _works.get(kept.image)
        if work is not None:
            work.want(wanted)
        elif kept.settings != wanted:
            _works[kept.image] = Refilter(core.load(), kept, wanted, resolve.threads(scene))
    if _works and not bpy.app.background and not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=k_tick_seconds)


def state(image: str) -> tuple[str, float]:
    """As retune.state."""
    work = _works.get(image)
    return ("filtering", work.fraction()) if work is not None else ("", 0.0)


def problem(image: str) -> str:
    return _problems.get(image, "")


def _finish(name: str) -> None:
    while name in _works:
        _poll(name, 0.1)


def _tick() -> float | None:
    for name in list(_works):
        _poll(name, 0.0)
    windows.redraw_panels()
    return k_tick_seconds if _works else None


def _poll(name: str, seconds: float) -> None:
    work = _works[name]
    if name not in bpy.data.images:
        work.cancel()
        _works.pop(name)
        films.drop_image(name)
        return
    try:
        frame = work.poll(seconds)
    except core.load().Error as error:
        _problems[name] = str(error)
        _works.pop(name)
        return
    if frame is not None:
        fill(bpy.data.images[name], frame)
    if not work.busy():
        _works.pop(name)


def fill(image: bpy.types.Image, frame: Any) -> None:
    """The picture's colours and alpha into an image of the same size."""
    picture = np.ascontiguousarray(frame.array("Combined"), np.float32)
    image.pixels.foreach_set(picture.reshape(-1))
    image.update()


def register() -> None:
    """Nothing to do: work begins when a film is opened."""


def unregister() -> None:
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
    for work in _works.values():
        work.cancel()
    _works.clear()
    _problems.clear()
