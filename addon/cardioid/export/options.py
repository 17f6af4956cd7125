# SPDX-License-Identifier: GPL-3.0-or-later
"""What the exporter is told and what it hands back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any


class ExportError(Exception):
    """Nothing can be rendered; the message is for the artist."""


class ExportCancelled(Exception):
    """`ExportOptions.should_stop` said so."""


@dataclass(frozen=True)
class ExportOptions:
    """One picture to export.

    resolution: pixels of the whole frame, percentage applied.
    crop: render border in pixels (x, y, width, height) from the bottom left; zeros: the whole frame.
    settings: keywords of `Scene.set_settings`, resolved; width, height and crop are filled in from here.
    passes: names of the passes that will be read; Combined is always there.
    engine: the RenderEngine, for the camera's matrix and shift (stereo) and its override; None: the scene's camera.
    should_stop: asked between objects; True ends the export with ExportCancelled.
    """

    resolution: tuple[int, int]
    crop: tuple[int, int, int, int] = (0, 0, 0, 0)
    settings: dict[str, Any] = field(default_factory=dict)
    passes: tuple[str, ...] = ("Combined",)
    engine: Any = None
    should_stop: Callable[[], bool] | None = None


@dataclass
class Exported:
    """A filled scene. `warnings` name what was left out or replaced; `timings` are seconds by stage."""

    scene: Any
    warnings: list[str] = field(default_factory=list)
    timings: dict[str, float] = field(default_factory=dict)
