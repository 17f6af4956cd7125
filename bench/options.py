# SPDX-License-Identifier: GPL-3.0-or-later
"""What every subcommand of the bench takes, before its name or after it, and what it makes of it."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from . import scene_list, store
from .engines import ROOT, Engine
from .scene_list import Scene

BUDGET = 1080.0
"""Seconds of a subcommand at reduced size: it ends within 20 minutes, building what is missing included."""
REDUCED = ("cornell", "metallic_ring", "open_plane")


def add_common(parser: argparse.ArgumentParser, again: bool = False) -> None:
    """`again`: after the subcommand's name, where an option that is not given must not undo the one before it."""

    def add(*names: str, default, **how) -> None:
        parser.add_argument(*names, default=argparse.SUPPRESS if again else default, **how)

    add("--full", action="store_true", default=False, help="the full size; without it: what two cores do in 20 minutes")
    add(
        "--budget",
        type=float,
        default=None,
        metavar="SECONDS",
        help=f"start no run that would not end within this time; 0: no limit ({BUDGET:g}, or 0 with --full)",
    )
    add(
        "--cache",
        type=Path,
        default=ROOT / "build" / "bench",
        help="pictures, built scenes, results (build/bench)",
    )
    add("--threads", type=int, default=os.cpu_count() or 1, help="of every engine (all)")
    add("--scene", action="append", default=[], metavar="NAME", help="only this scene (may be repeated)")
    add("--ours", default="cardioid", metavar="ENGINE", help="the engine that is judged (cardioid)")
    add("--rival", default="cycles", metavar="ENGINE", help="the engine that it is judged by (cycles)")


def settle(options: argparse.Namespace) -> None:
    """The budget's default, which depends on the size."""
    if options.budget is None:
        options.budget = 0.0 if options.full else BUDGET


def records_of(options, name: str) -> store.Store:
    """The records of a subcommand."""
    return store.Store(options.cache / f"{name}.jsonl", options.budget)


def pick(found: dict, name: str, what: str):
    if name not in found:
        sys.exit(f"no {what} named {name}; there are {', '.join(found)}")
    return found[name]


def usable(found: dict[str, Engine], *names: str) -> list[Engine]:
    """These engines; ends the program with one line if one of them cannot run."""
    chosen = [pick(found, name, "engine") for name in names]
    for engine in chosen:
        if engine.problem():
            sys.exit(f"{engine.key} cannot run: {engine.problem()}")
    return chosen


def chosen_scenes(options, default) -> list[Scene]:
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
