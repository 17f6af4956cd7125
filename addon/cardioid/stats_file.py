# SPDX-License-Identifier: GPL-3.0-or-later
"""Statistics of the frames that this Blender has rendered, for --cardioid-stats."""

from __future__ import annotations

import json
import os
from typing import Any

from .messages import RenderProblem

_renders: list[dict[str, Any]] = []


def add(path: str, entry: dict[str, Any], versions: dict[str, str]) -> None:
    """Adds one rendered frame, layer and view and writes the whole file; a reader never sees half of one."""
    _renders.append(entry)
    write(path, {"cardioid": versions, "renders": _renders})


def write(path: str, content: dict[str, Any]) -> None:
    temporary = f"{path}.{os.getpid()}.part"
    try:
        with open(temporary, "w", encoding="utf-8") as file:
            json.dump(content, file, indent=1, default=str)
        os.replace(temporary, path)
    except OSError as error:
        if os.path.exists(temporary):
            os.unlink(temporary)
        raise RenderProblem(f"--cardioid-stats: {path} cannot be written ({error.strerror})") from error
