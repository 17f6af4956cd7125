# SPDX-License-Identifier: GPL-3.0-or-later
"""Digests and versions of the programs that are measured, so that a record says of which build it is."""

from __future__ import annotations

import hashlib
import subprocess
from functools import cache
from pathlib import Path

WHEEL = "import importlib.metadata as m; print(m.version('bpy'))"


@cache
def of_file(path: Path) -> str:
    """Eight hexadecimal digits of a program's file."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:8]


@cache
def version(program: str) -> str:
    """What `blender --version` or the wheel of a Python says; empty if it cannot be started."""
    wheel = Path(program).name.startswith("python")
    command = [program, "-c", WHEEL] if wheel else [program, "--version"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True, stdin=subprocess.DEVNULL)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()


@cache
def of_addon(folder: Path) -> str:
    """Of the add-on's Python files and compiled engine."""
    found = hashlib.sha256()
    for path in sorted([*folder.rglob("*.py"), *folder.glob("_core*.so")]):
        found.update(str(path.relative_to(folder)).encode() + path.read_bytes())
    return found.hexdigest()


def digest(host: str, addon: str = "") -> str:
    """Eight digits of a Blender or wheel by its version and, if it is in there, of the add-on in folder `addon`."""
    text = version(host) + (of_addon(Path(addon) / "cardioid") if addon else "")
    return hashlib.sha256(text.encode()).hexdigest()[:8]
