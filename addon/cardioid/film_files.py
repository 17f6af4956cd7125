# SPDX-License-Identifier: GPL-3.0-or-later
"""Where films go on disk: `<frame without extension>.cardioid` beside the frame that Blender saves."""

from __future__ import annotations

import os
from typing import Any

import bpy

k_extension = ".cardioid"


def path_of(scene: bpy.types.Scene, layer: str, view: str, *, animation: bool, given: str = "") -> str:
    """Absolute path of a film.

    given: from the command line, # stands for the frame's number. Without it the path of the saved frame: frames of an
    animation are numbered, a single picture's path is taken as it is. Several layers and views are told apart.
    """
    if given:
        stem = given.removesuffix(k_extension).replace("#", str(scene.frame_current))
    elif scene.render.is_movie_format:
        stem = f"{_stem(scene.render.filepath, scene)}{scene.frame_current:04}"
    elif animation or _wants_number(scene.render.filepath):
        stem = _stem(scene.render.frame_path(frame=scene.frame_current), scene)
    else:
        stem = _stem(scene.render.filepath, scene)
    if sum(1 for one in scene.view_layers if one.use) > 1:
        stem += f"_{bpy.path.clean_name(layer)}"
    if view:
        suffix = scene.render.views[view].file_suffix if view in scene.render.views else ""
        stem += suffix or f"_{view}"
    return bpy.path.abspath(stem + k_extension)


def save(film: Any, path: str) -> None:
    """Raises the engine's Error or OSError; an older file at `path` stays then."""
    folder = os.path.dirname(path)
    if folder:
        os.makedirs(folder, exist_ok=True)
    film.save(path)


def _wants_number(path: str) -> bool:
    """A folder alone, or a place for the number."""
    name = bpy.path.basename(path)
    return not name or "#" in name


def _stem(path: str, scene: bpy.types.Scene) -> str:
    """Without the extension of a picture: `frame.v2` has none."""
    stem, extension = os.path.splitext(path)
    known = {*bpy.path.extensions_image, scene.render.file_extension, k_extension}
    return stem if extension.lower() in known else path
