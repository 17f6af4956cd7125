# SPDX-License-Identifier: GPL-3.0-or-later
"""The bench's command line; `python -m bench --help` from the repository's root."""

from __future__ import annotations

import argparse
import os
import platform
import sys
from pathlib import Path

from . import caustics, choices, efficiency, engines, filter, nodes, peers, photons, plot, scene_list, stages, store

ROOT = Path(__file__).resolve().parents[1]
REDUCED = ("cornell", "metallic_ring", "open_plane")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m bench",
        description="Cardioid beside other engines. Every command can be "
        "stopped and run again: what has been measured is kept.",
    )
    parser.add_argument(
        "--cache", type=Path, default=ROOT / "build" / "bench", help="pictures, built scenes, results (%(default)s)"
    )
    parser.add_argument("--threads", type=int, default=os.cpu_count() or 1)
    parser.add_argument(
        "--budget", type=float, default=0.0, metavar="SECONDS", help="start no run after this time; 0: no limit"
    )
    parser.add_argument("--ours", default="cardioid", help="the engine that is judged (%(default)s)")
    parser.add_argument("--rival", default="cycles", help="the engine that it is judged by (%(default)s)")
    parser.add_argument("--scene", action="append", default=[], help="only this scene (may be repeated)")
    commands = parser.add_subparsers(dest="command", required=True)
    one = commands.add_parser("efficiency", help="1 / (relative MSE · CPU seconds), interleaved pairs, equal settings")
    one.add_argument(
        "--full", action="store_true", help="all scenes, 15 CPU seconds a run; without it: three scenes, 4 seconds"
    )
    one.add_argument("--pairs", type=int, default=7)
    one.add_argument(
        "--seconds", type=float, default=0.0, help="CPU seconds of a run of the rival (4, or 15 with --full)"
    )
    one.add_argument("--bounces", type=int, default=24)
    one.add_argument("--caustics", action="store_true", help="leave caustics on (off in both engines without this)")
    one.add_argument("--scale", type=float, default=1.0, help="of each scene's picture size")
    one.add_argument("--referee", default="cycles", help="the engine of the references (%(default)s)")
    one.add_argument(
        "--reference", type=float, default=24.0, help="samples of a reference over those of a run (%(default)s)"
    )
    two = commands.add_parser("rays", help="camera paths and rays per CPU second")
    two.add_argument("--samples", type=int, default=64)
    two.add_argument("--runs", type=int, default=3)
    two.add_argument("--scale", type=float, default=1.0)
    two.add_argument(
        "--embree-loop", default="", metavar="COMMAND", help="prints rays_per_cpu_second of a bare Embree loop"
    )
    three = commands.add_parser("start", help="F12 to the first tile; export and build of a million triangles")
    three.add_argument("--runs", type=int, default=5)
    commands.add_parser("memory", help="bytes per triangle and per pixel")
    for module in (caustics, peers, photons, choices, filter, nodes):
        module.add_arguments(commands)
    commands.add_parser("list", help="the engines and scenes, and what is missing for each")
    return parser.parse_args()


def pick(found: dict, name: str, what: str):
    if name not in found:
        sys.exit(f"no {what} named {name}; there are {', '.join(found)}")
    return found[name]


def usable(options, found: dict[str, engines.Engine], *names: str) -> list[engines.Engine]:
    chosen = [pick(found, name, "engine") for name in names]
    for engine in chosen:
        if engine.problem():
            sys.exit(f"{engine.key} cannot run: {engine.problem()}")
    return chosen


def chosen_scenes(options, default) -> list[scene_list.Scene]:
    """The scenes asked for; those that are not there are skipped by name."""
    found = scene_list.all_scenes(options.cache)
    out = []
    for name in options.scene or default:
        scene = pick(found, name, "scene")
        problem = scene.ready()
        if problem:
            print(f"skipped {name}: {problem}")
        else:
            out.append(scene)
    return out


def run_efficiency(options, found) -> int:
    rival, ours, referee = usable(options, found, options.rival, options.ours, options.referee)
    seconds = options.seconds or (15.0 if options.full else 4.0)
    plan = efficiency.Plan(
        rival,
        ours,
        referee,
        options.pairs,
        seconds,
        options.threads,
        options.bounces,
        options.caustics,
        options.scale,
        options.reference,
    )
    names = list(scene_list.all_scenes(options.cache)) if options.full else REDUCED
    records = store.Store(options.cache / "efficiency.jsonl", options.budget)
    rows = []
    for scene in chosen_scenes(options, names):
        rows += efficiency.compare_scene(records, options.cache, plan, scene)
    stem = options.cache / f"efficiency-{ours.key}-{rival.key}"
    store.publish(rows, efficiency.COLUMNS, stem)
    if plot.efficiency(rows, ours.key, rival.title, stem.with_suffix(".png")):
        print(f"{os.path.relpath(stem)}.png")
    for note in efficiency.notes(rows, ours.key):
        print(note)
    return 0 if rows else 1


def run_rays(options, found) -> int:
    pair = usable(options, found, options.ours, options.rival)
    rows = []
    for scene in chosen_scenes(options, REDUCED[:1]):
        rows += stages.rays(
            pair, scene, options.scale, options.samples, options.runs, options.threads, options.embree_loop
        )
    columns = {
        "scene": "",
        "engine": "",
        "cpu": ".2f",
        "paths_per_cpu_s": ".3e",
        "rays_per_cpu_s": ".3e",
        "of_embree": ".1%",
    }
    store.publish(rows, columns, options.cache / "rays")
    print("Cycles does not count its rays: its rays are its paths times our rays a path.")
    return 0


def run_start(options, found) -> int:
    pair = usable(options, found, options.ours, options.rival)
    grid = options.cache / "scenes" / "grid-708.blend"
    stages.build_grid(grid, 708)
    rows = []
    for name, blend, width in (("default scene", "", 1920), ("million triangles", str(grid), 256)):
        for engine in pair:
            rows.append({"scene": name} | stages.first_tile(engine, blend, width, options.runs, options.threads))
    columns = {"scene": "", "engine": "", "built": ".3f", "first_tile": ".3f", "one_sample": ".3f", "runs": "d"}
    store.publish(rows, columns, options.cache / "start")
    print(
        "Seconds after F12: end of the build; first tile or sample; a whole picture of one sample, seen from outside."
    )
    return 0


def run_memory(options, found) -> int:
    pair = usable(options, found, options.ours, options.rival)
    small, large = (options.cache / "scenes" / f"grid-{side}.blend" for side in (708, 1225))
    triangles = stages.build_grid(small, 708), stages.build_grid(large, 1225)
    rows = [stages.memory(engine, small, large, triangles, options.threads) for engine in pair]
    columns = {"engine": "", "per_triangle": ".1f", "blender_per_triangle": ".1f", "per_pixel": ".1f"}
    store.publish(rows, columns, options.cache / "memory")
    print("Bytes: slopes of the process's peak resident memory; the engine's triangles come on top of Blender's own.")
    return 0


def run_list(options, found) -> int:
    for engine in found.values():
        print(f"engine {engine.key:14} {engine.title:28} {engine.problem() or 'ready'}")
    for scene in scene_list.all_scenes(options.cache).values():
        state = "ready" if scene.path.exists() else "built on first use" if scene.built else "not there"
        print(f"scene  {scene.name:18} {state}")
    return 0


def main() -> int:
    options = arguments()
    found = engines.available(options.cache)
    if options.command != "list":
        print(
            f"{platform.machine()}, {os.cpu_count()} cores, {options.threads} threads, load {os.getloadavg()[0]:.1f}",
            flush=True,
        )
    commands = {
        "efficiency": run_efficiency,
        "rays": run_rays,
        "start": run_start,
        "memory": run_memory,
        "list": run_list,
        "caustics": caustics.run,
        "peers": peers.run,
        "photons": photons.run,
        "choices": choices.run,
        "filter": filter.run,
        "nodes": nodes.run,
    }
    return commands[options.command](options, found)


if __name__ == "__main__":
    sys.exit(main())
