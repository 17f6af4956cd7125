# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes on which the filter is judged: their references, surfaces and regions, made on first use and kept."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import exr, measure, quality, reference, regions, store
from .engines import Job

ROOT = Path(__file__).resolve().parents[1]
HYBRID = ("integrator=hybrid",)
MODES = {
    "hybrid": (*HYBRID, "caustic_roughness=0.1"),
    "path tracing": ("integrator=path_tracing", "caustic_roughness=0"),
}
"""The add-on's settings of its integrators, whatever the exported file has."""
BOUNCES = 16
FIRST_SEED = 900_001
"""Of the references; measured runs count from 1."""


@dataclass(frozen=True)
class FilterScene:
    """`parts` × `samples` make the reference, under `settings`: in glossy_spheres photons follow rough metal too."""

    file: str
    mode: str
    parts: int
    samples: int
    settings: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        return self.file + (" (hybrid)" if self.mode == "hybrid" else "")

    @property
    def blend(self) -> Path:
        return ROOT / "scenes" / f"{self.file}.blend"

    def job(self, samples: int, seed: int, width: int, threads: int, settings: tuple[str, ...] = ()) -> Job:
        """A measured render. `width` 0: the file's own size."""
        settings = (*MODES[self.mode], *settings)
        return Job(str(self.blend), "", samples, seed, threads, BOUNCES, True, width, settings=settings)

    def reference_job(self, width: int, threads: int) -> Job:
        """One part of the reference, but for its seed."""
        settings = (*HYBRID, *self.settings)
        return Job(str(self.blend), "", self.samples, 0, threads, BOUNCES, True, width, settings=settings)


GLOSSY, BUST, GRID = ("glossy_spheres", "bust_in_water", "coloured_grid")
SCENES = {
    scene.name: scene
    for scene in (
        FilterScene(GLOSSY, "path tracing", 8, 48, ("caustic_roughness=0.36",)),
        FilterScene(BUST, "path tracing", 8, 48),
        FilterScene(GRID, "path tracing", 4, 64),
        FilterScene(GLOSSY, "hybrid", 8, 48, ("caustic_roughness=0.36",)),
        FilterScene(BUST, "hybrid", 8, 48),
        FilterScene("cornell", "hybrid", 4, 48),
        FilterScene("metallic_ring", "hybrid", 4, 48),
        FilterScene("open_plane", "hybrid", 4, 48),
    )
}
"""Chapter 6 as the thesis renders it, by path tracing; the defaults of the add-on; the camera half of chapter 5."""


def surface(cache: Path, scene: FilterScene, width: int) -> regions.Surface:
    """What the camera sees, from Blender; kept until the file changes."""
    path = cache / "surfaces" / f"{scene.file}-{scene.blend.stat().st_mtime_ns:x}-{width}.exr"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        script = str(Path(__file__).with_name("render_surface.py"))
        command = ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--"]
        part = path.with_name(f"part-{path.name}")
        cost = measure.run([*command, str(scene.blend), str(part), str(width)])
        if cost.code or not part.exists():
            raise store.failure("no surface was rendered", cost.lines, path)
        part.replace(path)
    planes = exr.channels(path)

    def layer(name: str, axes: str) -> np.ndarray:
        return np.stack([planes[f"ViewLayer.Denoising {name}.{axis}"] for axis in axes], -1)

    return regions.Surface(layer("Albedo", "RGB"), layer("Normal", "XYZ"), layer("Depth", "Z")[..., 0])


def referee(records, cache: Path, engine, scene: FilterScene, width: int, threads: int) -> quality.Referee | None:
    """The scene's reference and regions; None if time ran out."""
    job = scene.reference_job(width, threads)
    found = reference.make(records, cache, engine, scene.file, job, scene.parts, FIRST_SEED)
    if found is None or found.parts < scene.parts:
        return None
    parts = np.array([exr.load(path) for path in found.paths], np.float64)
    halves = parts[0::2].mean(0), parts[1::2].mean(0)
    return quality.Referee(parts, regions.regions(halves, surface(cache, scene, width)), found.paths)
