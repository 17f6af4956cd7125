# SPDX-License-Identifier: GPL-3.0-or-later
"""Wavy grids of many triangles, built on first use: for start-up and memory."""

from __future__ import annotations

from pathlib import Path

from . import measure


def build_grid(path: Path, side: int) -> int:
    """A wavy grid of 2·side² triangles as a .blend file, made on first use; returns the number of triangles."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        script = Path(__file__).resolve().parent / "scenes" / "build_grid.py"
        command = [
            "blender",
            "-b",
            "--factory-startup",
            "--python-exit-code",
            "1",
            "-P",
            str(script),
            "--",
            str(path),
            str(side),
        ]
        cost = measure.run(command)
        if not path.exists():
            raise RuntimeError("the grid could not be built:\n" + "\n".join(text for _, text in cost.lines[-8:]))
    return 2 * side * side
