# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of the bench: this repository's files, files of ../shared that a stranger's clone lacks, built ones."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PEERS = ROOT.parent / "shared" / "peers"


@dataclass(frozen=True)
class Scene:
    """`bar`: how many times Cycles' efficiency is asked for. `built`: bench/scenes/build_<name>.py makes the file."""

    name: str
    path: Path
    width: int
    bar: float
    built: bool = False
    masks: Path | None = None

    def ready(self) -> str:
        """Builds the file if it is a built one; returns why it cannot be used, or nothing."""
        if self.built and not self.path.exists():
            self.path.parent.mkdir(parents=True, exist_ok=True)
            script = ROOT / "bench" / "scenes" / f"build_{self.name}.py"
            command = [
                "blender",
                "-b",
                "--factory-startup",
                "--python-exit-code",
                "1",
                "-P",
                str(script),
                "--",
                str(self.path),
            ]
            done = subprocess.run(
                command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, stdin=subprocess.DEVNULL
            )
            if done.returncode:
                return "could not be built: " + " | ".join(done.stdout.strip().splitlines()[-4:])
        return "" if self.path.exists() else f"{os.path.relpath(self.path, ROOT)} is not there"

    def load_masks(self, shape: tuple[int, int]) -> dict[str, np.ndarray]:
        """Masks by name, those that fit the picture; pixels that see the lamp (`emit`) are left out of the others."""
        if self.masks is None or not self.masks.exists():
            return {}
        with np.load(self.masks) as file:
            found = {name: file[name].astype(bool) for name in file.files if file[name].shape == shape}
        emit = found.pop("emit", np.zeros(shape, bool))
        return {"without lamp": ~emit} | {name: mask & ~emit for name, mask in found.items()}


def all_scenes(cache: Path) -> dict[str, Scene]:
    """Every scene by name, plain ones first."""
    own, built = ROOT / "scenes", cache / "scenes"
    found = [
        Scene("cornell", own / "cornell.blend", 384, 3.0),
        Scene("metallic_ring", own / "metallic_ring.blend", 448, 2.0),
        Scene("open_plane", own / "open_plane.blend", 448, 3.0),
    ]
    for name in ("cornell", "ring", "shapes"):
        found.append(
            Scene(
                f"peers_{name}", PEERS / "scenes" / f"{name}.blend", 256, 3.0, masks=PEERS / "ref" / f"{name}_masks.npz"
            )
        )
    found += [
        Scene("textured_interior", built / "textured_interior.blend", 448, 2.0, built=True),
        Scene("hdri_exterior", built / "hdri_exterior.blend", 448, 2.0, built=True),
        Scene("million_triangles", built / "million_triangles.blend", 448, 2.0, built=True),
    ]
    return {scene.name: scene for scene in found}


def caustic_scenes(cache: Path) -> dict[str, Scene]:
    """Scenes that only the comparisons of photons use, by name."""
    built = cache / "scenes"
    found = [
        Scene("pool_sun", built / "pool_sun.blend", 256, 0.0, built=True),
        Scene("open_plane", ROOT / "scenes" / "open_plane.blend", 256, 0.0),
        Scene("twelve_lamps", built / "twelve_lamps.blend", 256, 0.0, built=True),
        Scene("cornell_large_lamp", built / "cornell_large_lamp.blend", 192, 0.0, built=True),
        Scene("cornell_sky", built / "cornell_sky.blend", 192, 0.0, built=True),
    ]
    return {scene.name: scene for scene in found}
