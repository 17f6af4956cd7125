# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress in the words and numbers that artists know from Blender's status line."""

from __future__ import annotations

from typing import Any

k_separator = " · "


def duration(seconds: float) -> str:
    """43 s: "0:43"; two hours: "2:00:00"."""
    whole = max(0, int(seconds + 0.5))
    hours, minutes, rest = whole // 3600, whole // 60 % 60, whole % 60
    return f"{hours}:{minutes:02}:{rest:02}" if hours else f"{minutes}:{rest:02}"


def memory(size: float) -> str:
    """Bytes as "512M" or "3.2G"."""
    megabytes = size / (1 << 20)
    return f"{megabytes / 1024:.1f}G" if megabytes >= 10000 else f"{megabytes:.0f}M"


def count(number: int) -> str:
    """Photons as "812", "81 k", "1.2 M" or "3.4 G"."""
    for size, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if number >= 0.9995 * size:
            share = number / size
            return f"{share:.1f} {letter}" if share < 9.95 else f"{share:.0f} {letter}"
    return str(number)


def line(progress: dict[str, Any]) -> str:
    """One line for Blender's header:
    "Sample 12/128 · Pass 5 · photons 1.2 M stored of 8.1 M · Remaining 0:43 · Mem 512M"."""
    parts = []
    phase = progress.get("phase", "")
    if phase == "build":
        parts.append(progress.get("message") or "Building the scene")
    elif progress.get("total_samples"):
        parts.append(f"Sample {progress.get('samples', 0)}/{progress['total_samples']}")
        parts += _photons(progress)
        if phase == "render" and progress.get("remaining", 0) > 0 and progress.get("samples"):
            parts.append(f"Remaining {duration(progress['remaining'])}")
    if progress.get("memory_bytes"):
        parts.append(f"Mem {memory(progress['memory_bytes'])}")
    return k_separator.join(parts)


def _photons(progress: dict[str, Any]) -> list[str]:
    parts = []
    if progress.get("passes"):
        parts.append(f"Pass {progress['passes']}")
    if progress.get("photons_emitted"):
        stored, emitted = count(progress.get("photons_stored", 0)), count(progress["photons_emitted"])
        parts.append(f"photons {stored} stored of {emitted}")
    return parts
