# SPDX-License-Identifier: GPL-3.0-or-later
"""The bench's command line: `./scripts/bench --help`. A subcommand is a module with `add_arguments(commands)` and
`run(options, found) -> int`; `found` are the engines by key."""

from __future__ import annotations

import argparse
import copy
import os
import platform
import signal
import sys
import time

from . import (
    choices,
    classes,
    convergence,
    efficiency,
    engines,
    filter,
    filter_references,
    memory,
    nodes,
    options,
    peers,
    photons,
    rays,
    scene_list,
    start,
    store,
    tables,
)

MODULES = {
    "tables": tables,
    "convergence": convergence,
    "filter": filter,
    "classes": classes,
    "peers": peers,
    "rays": rays,
    "nodes": nodes,
    "memory": memory,
    "efficiency": efficiency,
    "start": start,
    "photons": photons,
    "choices": choices,
}
MAKERS = {"references": filter_references}
"""Subcommands that measure nothing: `all` leaves them out."""
STOPPED = 130


class Commands:
    """Subcommands that take the common options too."""

    def __init__(self, parser: argparse.ArgumentParser):
        self.parsers = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def add_parser(self, name: str, **how) -> argparse.ArgumentParser:
        parser = self.parsers.add_parser(name, description=how.get("help"), **how)
        options.add_common(parser.add_argument_group("common options"), again=True)
        return parser


def parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser(
        prog="./scripts/bench",
        description="Cardioid beside other engines and beside its thesis. Every command can be stopped and run again: "
        "what has been measured is kept.",
    )
    options.add_common(made)
    commands = Commands(made)
    for module in (*MODULES.values(), *MAKERS.values()):
        module.add_arguments(commands)
    commands.add_parser("all", help="every subcommand; --budget is shared by them")
    commands.add_parser("list", help="the engines and scenes, and what is missing for each")
    return made


def run_list(chosen, found) -> int:
    for engine in found.values():
        print(f"engine {engine.key:14} {engine.title:28} {engine.problem() or 'ready'}")
    for scene in scene_list.all_scenes(chosen.cache).values():
        state = "ready" if scene.path.exists() else "built on first use" if scene.built else "not there"
        print(f"scene  {scene.name:18} {state}")
    return 0


def run_all(chosen, found) -> int:
    """Each gets an even share of the time that is left; one that fails does not keep the others from running."""
    end, failed = time.monotonic() + (chosen.budget or 0.0), []
    for index, name in enumerate(MODULES):
        own = parser().parse_args([name])
        for key, value in vars(chosen).items():
            if key != "command":
                setattr(own, key, copy.copy(value))
        if chosen.budget:
            own.budget = max(1.0, (end - time.monotonic()) / (len(MODULES) - index))
        options.settle(own)
        print(f"== {name}", flush=True)
        try:
            code = MODULES[name].run(own, found)
        except store.DiskFull:
            raise
        except (RuntimeError, ValueError, SystemExit) as error:
            print(f"{name}: {error}", file=sys.stderr)
            code = 1
        failed += [name] if code else []
    if failed:
        print(f"failed: {', '.join(failed)}")
    return 1 if failed else 0


def dispatch(chosen) -> int:
    found = engines.available(chosen.cache)
    if chosen.command == "list":
        return run_list(chosen, found)
    load = os.getloadavg()[0]
    print(f"{platform.machine()}, {os.cpu_count()} cores, {chosen.threads} threads, load {load:.1f}", flush=True)
    if chosen.command == "all":
        return run_all(chosen, found)
    options.settle(chosen)
    return (MODULES | MAKERS)[chosen.command].run(chosen, found)


def interrupted(*_) -> None:
    raise KeyboardInterrupt


def main(words: list[str] | None = None) -> int:
    """0; 1 after a failure, which is told in a line; 130 after Ctrl-C."""
    chosen = parser().parse_args(words)
    signal.signal(signal.SIGTERM, interrupted)
    try:
        return dispatch(chosen)
    except KeyboardInterrupt:
        print(f"\nStopped. What was measured is kept in {chosen.cache}; the same command goes on.", file=sys.stderr)
        return STOPPED
    except store.DiskFull as error:
        print(f"{error}", file=sys.stderr)
        return 1
    except OSError as error:
        if not store.is_full(error):
            raise
        print(f"{store.DiskFull.of(error, chosen.cache)}", file=sys.stderr)
        return 1
    except RuntimeError as error:
        print(f"{chosen.command}: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
