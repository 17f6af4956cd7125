# SPDX-License-Identifier: GPL-3.0-or-later
"""Cardioid's arguments after `--` on Blender's command line. Others' arguments there are left alone."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from . import core
from .settings_table import k_integrators


@dataclass(frozen=True)
class Arguments:
    """overrides: settings by their name in scene.cardioid. stats, export: files to write. problems: wrong values."""

    overrides: dict[str, Any] = field(default_factory=dict)
    stats: str = ""
    export: str = ""
    problems: tuple[str, ...] = ()


class _Parser(argparse.ArgumentParser):
    """An argument parser that raises instead of leaving Blender."""

    def error(self, message: str):
        raise ValueError(message)


def _integer(least: int):
    def parse(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if not least <= number <= 0x7FFFFFFF:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number of at least {least}")
        return number

    return parse


def _seconds(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0.0 <= number < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is not a time in seconds")
    return number


def _integrator(text: str) -> str:
    offered = [name for name in k_integrators if name in core.integrators()]
    if text.upper() not in offered:
        raise argparse.ArgumentTypeError(f"'{text}' is not an integrator of this engine; it has {', '.join(offered)}")
    return text.upper()


k_arguments = (
    # option, name in scene.cardioid, parser, value's name, help
    ("--cardioid-samples", "samples", _integer(1), "N", "camera paths a pixel"),
    ("--cardioid-integrator", "integrator", _integrator, "NAME", "PTPPM, PT or SPPM, as far as the engine has them"),
    ("--cardioid-time-limit", "time_limit", _seconds, "SECONDS", "stop a frame after this time; 0: no limit"),
    ("--cardioid-threads", "threads", _integer(0), "N", "threads to render with; 0: as Blender is set"),
    ("--cardioid-seed", "seed", _integer(0), "N", "seed of the noise"),
    ("--cardioid-stats", "stats", str, "FILE.json", "write times, counts and memory of each frame there"),
    ("--cardioid-export", "export", str, "FILE.cardioid", "save the scene for cardioid-render; # is the frame number"),
)


def parse(argv: Sequence[str]) -> Arguments:
    """Cardioid's part of Blender's command line `argv`. Wrong values are told in `problems`, each in one sentence."""
    if "--" not in argv:
        return Arguments()
    values: dict[str, Any] = {}
    problems = []
    rest = list(argv[list(argv).index("--") + 1:])
    for option, name, convert, metavar, text in k_arguments:
        parser = _Parser(add_help=False, allow_abbrev=False)
        parser.add_argument(option, dest=name, type=convert, metavar=metavar, help=text)
        try:
            found, rest = parser.parse_known_args(rest)
        except ValueError as error:
            problems.append(str(error).removeprefix("argument "))
            continue
        if getattr(found, name) is not None:
            values[name] = getattr(found, name)
    problems += [f"{word.split('=')[0]}: there is no such option" for word in rest if word.startswith("--cardioid-")
                 and word.split("=")[0] not in {argument[0] for argument in k_arguments}]
    return Arguments(values, values.pop("stats", ""), values.pop("export", ""), tuple(problems))


def current() -> Arguments:
    """The arguments of this Blender."""
    return parse(sys.argv)
