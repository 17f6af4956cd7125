# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of clusters, outlier rejection and the filter (thesis chapter 6): quality, cost, convergence, pictures."""

from __future__ import annotations

import os
import sys

from . import filter_convergence, filter_pictures, filter_quality, filter_tables, store
from .engines import CommandLine

PARTS = {
    "quality": filter_quality.run,
    "tables": filter_tables.run,
    "convergence": filter_convergence.run,
    "pictures": filter_pictures.run,
}


def add_arguments(commands) -> None:
    parser = commands.add_parser("filter", help="clusters and filter: tables 6.1 and 6.2, methods compared, pictures")
    parser.add_argument("--part", choices=(*PARTS, "all"), default="all")
    parser.add_argument("--counts", default="4,16,64,256", help="samples (%(default)s)")
    parser.add_argument("--width", type=int, default=384, help="of the pictures of `quality` (%(default)s)")
    parser.add_argument("--pairs", type=int, default=9, help="of the cost of clusters while rendering (%(default)s)")
    parser.add_argument("--pair-width", type=int, default=384, help="of those pairs' pictures (%(default)s)")


def referee_engine(engine: CommandLine, options) -> CommandLine:
    """CARDIOID_REFEREE: another build that renders the references, so that they outlive changes of the judged one."""
    program = os.environ.get("CARDIOID_REFEREE", engine.program)
    return CommandLine(program, engine.addon, options.cache)


def run(options, found) -> int:
    engine = found["cardioid-cli"]
    if engine.problem():
        sys.exit(f"{engine.key} cannot run: {engine.problem()}")
    options.counts = [int(count) for count in options.counts.split(",")]
    records = store.Store(options.cache / "filter.jsonl", options.budget)
    referee = referee_engine(engine, options)
    chosen = PARTS if options.part == "all" else {options.part: PARTS[options.part]}
    return max(part(options, records, engine, referee) for part in chosen.values())
