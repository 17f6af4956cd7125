# SPDX-License-Identifier: GPL-3.0-or-later
"""One render with LuxCore from PyPI.

    .venv/peers/bin/python bench/rivals/render_luxcore.py --scene cornell --mode cache --cpu 30 --out OUT.exr

Modes: `default` (path tracer with nothing set), `path` (as many bounces as all others), `cache` (the same with the
caustic cache of PhotonGI), `bidir`. numpy must be imported before pyluxcore and no other compiled module after it: its
allocator takes the place of the process's. So the film writes the picture itself.
"""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import numpy as np
import pyluxcore

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bench.rivals import runner, scenes, shapes

MODES = ("default", "path", "cache", "bidir")
ROW = 2.0 / scenes.SIZE
"""LuxCore's film lies one row of pixels lower than everybody else's; its window is moved by that."""

COMMON = {
    "film.width": scenes.SIZE,
    "film.height": scenes.SIZE,
    "film.filter.type": "NONE",
    "film.opencl.enable": False,
    "film.outputs.0.type": "RGB",
    "film.outputs.0.filename": "rgb.exr",
    "renderengine.type": "PATHCPU",
    "sampler.type": "SOBOL",
}
EQUAL = {
    "path.pathdepth.total": scenes.BOUNCES,
    "path.pathdepth.diffuse": scenes.BOUNCES,
    "path.pathdepth.glossy": scenes.BOUNCES,
    "path.pathdepth.specular": scenes.BOUNCES,
    "sampler.sobol.adaptive.strength": 0.0,
    "path.clamping.variance.maxvalue": 0.0,
}
CACHE = {
    "path.photongi.sampler.type": "RANDOM",
    "path.photongi.photon.maxcount": 1_000_000,
    "path.photongi.photon.maxdepth": 12,
    "path.photongi.photon.time.start": 0.0,
    "path.photongi.photon.time.end": -1.0,
    "path.photongi.indirect.enabled": False,
    "path.photongi.caustic.enabled": True,
    "path.photongi.caustic.maxsize": 100_000,
    "path.photongi.caustic.lookup.radius": 0.02,
    "path.photongi.caustic.lookup.normalangle": 10.0,
    "path.photongi.caustic.updatespp": 8,
    "path.photongi.caustic.updatespp.radiusreduction": 0.96,
    "path.photongi.caustic.updatespp.minradius": 0.003,
}
"""The add-on's values but for two, in its favour: it traces up to 20 million photons, which took longer than whole runs
of ten seconds, and starts at 7.5 cm, which blurs caustics of bodies of this size."""
BIDIR = {
    "renderengine.type": "BIDIRCPU",
    "path.maxdepth": 16,
    "light.maxdepth": 12,
    "path.russianroulette.depth": 1000,
    "light.russianroulette.depth": 1000,
}
"""Its roulette makes pictures too bright by a tenth, so it is off."""

CONFIGS = {"default": {}, "path": EQUAL, "cache": EQUAL | CACHE, "bidir": EQUAL | BIDIR}


def properties(values: dict) -> pyluxcore.Properties:
    made = pyluxcore.Properties()
    for key, value in values.items():
        made.Set(pyluxcore.Property(key, list(value) if isinstance(value, (tuple, list)) else value))
    return made


def camera_of(camera: scenes.Camera) -> dict:
    return {
        "scene.camera.type": "perspective",
        "scene.camera.lookat.orig": [float(value) for value in camera.origin],
        "scene.camera.lookat.target": [float(value) for value in camera.target],
        "scene.camera.up": [0.0, 0.0, 1.0],
        "scene.camera.fieldofview": camera.fov,
        "scene.camera.screenwindow": [-1.0, 1.0, -1.0 - ROW, 1.0 - ROW],
        "scene.camera.autovolume.enable": False,
        "scene.camera.cliphither": 1e-3,
    }


def material_of(name: str, material: scenes.Material) -> dict:
    start, color = f"scene.materials.{name}.", [float(value) for value in material.color]
    if material.kind == scenes.DIFFUSE:
        return {start + "type": "matte", start + "kd": color}
    if material.kind == scenes.MIRROR:
        return {start + "type": "mirror", start + "kr": color}
    white = {start + "kr": [1.0] * 3, start + "kt": [1.0] * 3}
    return white | {start + "type": "glass", start + "interiorior": material.ior, start + "exteriorior": 1.0}


def lamp_material(lamp: scenes.Lamp) -> dict:
    start = "scene.materials.lamp."
    emission = {"emission": [float(value) for value in lamp.radiance], "emission.gain": [1.0] * 3}
    emission |= {"emission.power": 0.0, "emission.efficency": 0.0, "emission.gain.normalizebycolor": False}
    found = {"type": "matte", "kd": [0.0] * 3} | emission
    return {start + key: value for key, value in found.items()}


def define(scene: pyluxcore.Scene, name: str, body: shapes.Body, normals: np.ndarray | None) -> None:
    points = [tuple(map(float, point)) for point in body.vertices]
    triangles = [tuple(map(int, corners)) for corners in body.triangles]
    smooth = None if normals is None else [tuple(map(float, normal)) for normal in normals]
    scene.DefineMesh(name, points, triangles, smooth, None, None, None)


def scene_of(made: scenes.Scene) -> pyluxcore.Scene:
    scene, parts = pyluxcore.Scene(), camera_of(made.camera) | lamp_material(made.lamp)
    for name, material in made.materials.items():
        parts |= material_of(name, material)
    for mesh in made.meshes:
        define(scene, mesh.name, mesh.body, mesh.normals())
        parts |= {f"scene.objects.{mesh.name}.shape": mesh.name, f"scene.objects.{mesh.name}.material": mesh.material}
    define(scene, "lamp", made.lamp.body(), None)
    parts |= {"scene.objects.lamp.shape": "lamp", "scene.objects.lamp.material": "lamp"}
    scene.Parse(properties(parts))
    return scene


def render(chosen) -> None:
    config = COMMON | CONFIGS[chosen.mode]
    config |= {
        "native.threads.count": chosen.threads,
        "renderengine.seed": chosen.seed,
        "batch.haltspp": chosen.samples,
    }
    scene = scene_of(scenes.ALL[chosen.scene]())
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties(config), scene))
    clock = runner.Clock()
    session.Start()
    while not (session.HasDone() if chosen.samples else clock.cpu() >= chosen.cpu):
        time.sleep(0.02)
        session.UpdateStats()
    session.Pause()
    session.UpdateStats()
    count = session.GetStats().Get("stats.renderengine.total.samplecount").Get()[0]
    session.GetFilm().SaveOutput(chosen.out, pyluxcore.FilmOutputType.RGB, pyluxcore.Properties())
    clock.report(float(count) / scenes.SIZE**2, pyluxcore.Version())


def main() -> None:
    chosen = runner.arguments(sys.argv[1:], MODES)
    pyluxcore.Init(lambda text: None)
    render(chosen)
    sys.stdout.flush()
    os._exit(0)  # its own end may crash


if __name__ == "__main__":
    main()
