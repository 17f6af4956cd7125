# SPDX-License-Identifier: GPL-3.0-or-later
"""What the artist is told: errors as one sentence, warnings once in a render job."""

from __future__ import annotations

from collections.abc import Iterable

import bpy
from bpy.app.handlers import persistent

k_problems_shown = 5
k_error_is_reported = (4, 5)  # from here on error_set beside a report shows the error twice

_said: set[str] = set()


class RenderProblem(Exception):
    """The picture cannot be rendered; the text is for the artist."""


def summary(problems: Iterable[str]) -> str:
    """Several problems as one message."""
    listed = list(problems)
    text = "; ".join(listed[:k_problems_shown])
    return f"{text}; and {len(listed) - k_problems_shown} more" if len(listed) > k_problems_shown else text


def warn(engine: bpy.types.RenderEngine, warnings: Iterable[str]) -> None:
    """Shows each warning in Blender's info bar, once in a render job however many frames and layers repeat it."""
    for warning in warnings:
        if warning not in _said:
            _said.add(warning)
            engine.report({"WARNING"}, f"Cardioid: {warning}")


def fail(engine: bpy.types.RenderEngine, message: str) -> None:
    """Ends the render with one readable message, in the info bar (and in 3.4 over the picture)."""
    text = f"Cardioid: {message}"
    engine.report({"ERROR"}, text)
    if bpy.app.version < k_error_is_reported:
        engine.error_set(text)


@persistent
def _new_job(*_arguments) -> None:
    _said.clear()


def register() -> None:
    bpy.app.handlers.render_init.append(_new_job)


def unregister() -> None:
    bpy.app.handlers.render_init.remove(_new_job)
    _said.clear()
