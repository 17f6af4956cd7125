# SPDX-License-Identifier: GPL-3.0-or-later
"""One render with Mitsuba 3 from PyPI.

    .venv/peers/bin/python bench/rivals/render_mitsuba.py --scene cornell --mode path --cpu 30 --out OUT.exr

Modes: `default` (path tracer with nothing set), `path` (as many bounces as all others), `particles` (particle tracer:
what mirrors and glass show is missing), `split` (the method of the references, no part of Mitsuba).
"""

from __future__ import annotations

import sys
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bench import exr
from bench.rivals import runner, scenes

MODES = ("default", "path", "particles", "split")
PASS = 16
"""Samples a pixel and pass; independent ones: passes of the stratified samplers share most of their error."""
VARIANT = "llvm_ad_rgb"


def integrator(mode: str) -> mi.Integrator:
    if mode == "default":
        return mi.load_dict({"type": "path"})
    kind = "ptracer" if mode == "particles" else "path"
    return mi.load_dict({"type": kind, "max_depth": scenes.BOUNCES + 2})


def passes(chosen, clock: runner.Clock):
    """Samples of each pass to come: all that were asked for, or as long as the next one ends nearer to the mark."""
    if chosen.samples:
        full, rest = divmod(chosen.samples, PASS)
        yield from [PASS] * full + [rest] * (rest > 0)
        return
    before, last = clock.cpu(), 0.0
    while before + last / 2 < chosen.cpu:
        yield PASS
        now = clock.cpu()
        before, last = now, now - before


def render(chosen) -> None:
    from bench.rivals import mitsuba_scene

    scene = mitsuba_scene.load(scenes.ALL[chosen.scene]())
    method = integrator(chosen.mode)
    mi.render(scene, integrator=method, spp=1, seed=0).numpy()  # compiles the kernels
    clock = runner.Clock()
    total, samples = np.zeros((scenes.SIZE, scenes.SIZE, 3)), 0
    for index, count in enumerate(passes(chosen, clock)):
        picture = mi.render(scene, integrator=method, spp=count, seed=chosen.seed * 100003 + index).numpy()
        total += picture[..., :3].astype(np.float64) * count
        samples += count
    exr.save(Path(chosen.out), total / samples)
    clock.report(samples, mi.__version__)


def main() -> None:
    chosen = runner.arguments(sys.argv[1:], MODES)
    mi.set_variant(VARIANT)
    dr.set_thread_count(chosen.threads)
    if chosen.mode == "split":
        from bench.rivals import split

        split.render(chosen)
    else:
        render(chosen)


if __name__ == "__main__":
    main()
