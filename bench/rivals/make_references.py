# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the references anew: `split.py`'s picture of a scene, its own error and the masks.

.venv/peers/bin/python bench/rivals/make_references.py [--scene NAME] [--cpu 600] [--out bench/rivals/references]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import drjit as dr
import mitsuba as mi

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bench.rivals import masks, runner, scenes, stored


def make(name: str, cpu: float, seed: int) -> stored.Stored:
    from bench.rivals import split

    clock = runner.Clock()
    made = split.Split(scenes.ALL[name](), seed)
    made.run(clock, cpu)
    picture, error = made.picture(), made.error()
    emit, caustic = masks.of(picture, made.caustics(), made.lamp.mean())
    record = {
        "made": f"make_references.py, Mitsuba {mi.__version__}: paths without caustics, caustics by light tracing",
        "cpu_seconds": round(clock.cpu()),
        "seeds": [seed],
        "light_paths": made.light_paths,
        "camera_samples": made.camera.count * split.CAMERA_SAMPLES,
    }
    found = stored.Stored(picture, error, emit, caustic, record)
    record |= stored.measured(picture, error, found)
    return found


def better(name: str, folder: Path, made: stored.Stored) -> stored.Stored:
    """What is there with `made` added. Refused: nothing is there, or of another scene."""
    there = stored.read(folder, name)
    if set(made.record["seeds"]) & set(there.record.get("seeds", [])):
        sys.exit(f"{folder / name}.json: a run with this seed is in there already; give another --seed")
    return stored.merged(there, made)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scene", action="append", choices=list(scenes.ALL), help="all without it; may be repeated")
    parser.add_argument("--cpu", type=float, default=600.0, help="seconds for each (%(default)g)")
    parser.add_argument("--out", type=Path, default=stored.FOLDER)
    parser.add_argument("--add", action="store_true", help="add to the references that are there; needs a new --seed")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=7)
    chosen = parser.parse_args()
    mi.set_variant("llvm_ad_rgb")
    dr.set_thread_count(chosen.threads)
    for name in chosen.scene or scenes.ALL:
        made = make(name, chosen.cpu, chosen.seed)
        made = better(name, chosen.out, made) if chosen.add else made
        stored.write(chosen.out, name, made)
        print(f"{name}: {made.record}", flush=True)


if __name__ == "__main__":
    main()
