# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of Blender's render result that one render of one layer and view fills."""

from __future__ import annotations

from typing import Any

import bpy

from . import pixels
from .frame_size import Shape
from .messages import RenderProblem
from .passes import Pass


class Target:
    """Opened at the first picture, refined by each later one; `close` merges it for good, also after a cancel."""

    def __init__(self, engine: bpy.types.RenderEngine, layer: str, view: str, shape: Shape, passes: list[Pass]):
        self._engine = engine
        self._layer, self._view = layer, view
        self._size, self._area = shape.size, shape.area
        self._passes = {one.name: one.engine for one in passes}
        self._result = None
        for one in passes:
            if one.name != "Combined":
                engine.add_pass(one.name, len(one.channels), one.channels, layer=layer)

    def show(self, frame: Any) -> None:
        """Writes a picture of the engine into the result and redraws."""
        if self._result is None:
            self._open()
        names = set(frame.names())
        for one in self._result.layers[0].passes:
            source = self._passes.get(one.name)
            if source in names:
                pixels.upload(one, self._fitted(frame.array(source)))
        self._engine.update_result(self._result)

    def leave_black(self) -> None:
        """For a render that was stopped before its first picture: Blender 3.4 crashes when it saves a result without
        passes."""
        if self._result is None:
            self._open()

    def close(self) -> None:
        if self._result is not None:
            self._engine.end_result(self._result, cancel=False, highlight=False, do_merge_results=True)
            self._result = None

    def _open(self) -> None:
        width, height = self._size
        self._result = self._engine.begin_result(0, 0, width, height, layer=self._layer, view=self._view)
        if self._result is None or not self._result.layers:
            raise RenderProblem(f"Blender has no render layer named {self._layer}")
        self._size = self._result.resolution_x, self._result.resolution_y

    def _fitted(self, picture: Any) -> Any:
        part = pixels.cut(picture, self._size, self._area)
        if part is None:
            height, width = picture.shape[:2]
            raise RenderProblem(f"the picture has {width} x {height} pixels and Blender expects "
                                f"{self._size[0]} x {self._size[1]}")
        return part
