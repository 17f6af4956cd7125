# SPDX-License-Identifier: GPL-3.0-or-later
"""A cache of the bench with small made-up pictures: two scenes, three renderers, a name that is HTML."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bench.result import Picture, Result, Table, Verdict, folder, save

WIDTH, HEIGHT = 192, 144
SPOT = (120, 48)
"""Left and top of the square in which the noisy picture differs from the reference."""
HTML = '<img src=x onerror="alert(1)">'
MACHINE = {"cpu": "Testron 9", "cores": 2, "memory_gib": 4.0, "system": "Linux"}


def gradient(level: float) -> np.ndarray:
    """(HEIGHT, WIDTH, 3), 0…1: brighter to the right, `level` in the blue channel."""
    across = np.broadcast_to(np.linspace(0.1, 0.9, WIDTH), (HEIGHT, WIDTH))
    return np.stack([across, across * 0.7, np.full((HEIGHT, WIDTH), level)], axis=2)


def store(path: Path, values: np.ndarray) -> str:
    """Writes 0…1 values as PNG; the file's name."""
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.fromarray((values * 255).astype(np.uint8)).save(path)
    return path.name


def pictures(where: Path, scene: str) -> list[Picture]:
    """Reference, Cycles with noise in one square, Cardioid nearly equal to the reference."""
    noisy = gradient(0.2)
    x, y = SPOT
    noisy[y : y + 44, x : x + 44] = np.random.default_rng(1).random((44, 44, 3))
    files = {
        "ref": store(where / f"{scene}-ref.png", gradient(0.2)),
        "cycles": store(where / f"{scene}-cycles.png", noisy),
        "ours": store(where / f"{scene}-ours.png", gradient(0.21)),
    }
    return [
        Picture(scene, "Cycles 3.4.1", files["cycles"], "24 samples", 30.5, 0.4567, 0.913),
        Picture(scene, "Cardioid", files["ours"], "16 samples", 30.1, 0.01234, 0.999),
        Picture(scene, "Reference", files["ref"], "4096 samples", 900.0, None, None, True),
    ]


def of_direct_light(where: Path) -> list[Picture]:
    """One part of a scene's light, without a reference."""
    return [
        Picture("wine_glass, direct light", label, store(where / f"direct-{label}.png", gradient(level)))
        for label, level in (("PT", 0.3), ("PTPPM", 0.4))
    ]


def peers(cache: Path) -> Result:
    """The result `peers`, its pictures written."""
    where = folder(cache, "peers")
    columns = {"renderer": ["renderer", ""], "relmse": ["relMSE", ".3f"], "cpu": ["CPU s", ".1f"]}
    rows = [
        {"renderer": "Cycles", "relmse": 0.4567, "cpu": 100.0},
        {"renderer": HTML, "relmse": None, "cpu": 9.0},
        {"renderer": "Cardioid", "relmse": 0.012, "cpu": 30.0},
    ]
    return Result(
        "peers",
        "Cardioid beside others",
        "./scripts/bench peers --full",
        reduced=True,
        tables=[Table("peers", "Error and time", columns, rows, "A note")],
        plots=[store(where / "plot.png", gradient(0.5))],
        pictures=[*pictures(where, "cornell"), *pictures(where, "wine_glass"), *of_direct_light(where)],
        verdicts=[
            Verdict("Light is kept", "thesis 5.7", True, "0.999"),
            Verdict("It is the fastest", "thesis 6.4", False, "30.1 s against 12.3 s"),
            Verdict("It scales", "thesis 6.5", None, "one size only"),
        ],
        settings={"Cycles 3.4.1": "no clamping"},
        missing=["LuxCore: not installed"],
        machine=MACHINE,
        versions={"Blender": "3.4.1"},
        commit="abc1234",
        made="2026-01-02T03:04:05+0000",
    )


@pytest.fixture
def cache(tmp_path: Path) -> Path:
    """A folder with the result `peers` and nothing else."""
    save(peers(tmp_path / "cache"), tmp_path / "cache")
    return tmp_path / "cache"
