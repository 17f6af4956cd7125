# SPDX-License-Identifier: GPL-3.0-or-later
"""Cardioid's arguments after `--` on Blender's command line. Others' arguments there are left alone."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from . import core
from .settings_table import k_by_name, k_integrators

k_most = 0x7FFFFFFF  # of Blender's whole numbers


@dataclass(frozen=True)
class Arguments:
    """overrides: settings by their name in scene.cardioid. stats, export, film: files to write. print_stats: a table on
    the terminal. problems: wrong values."""

    overrides: dict[str, Any] = field(default_factory=dict)
    stats: str = ""
    print_stats: bool = False
    export: str = ""
    film: str = ""
    problems: tuple[str, ...] = ()


class _Parser(argparse.ArgumentParser):
    """An argument parser that raises instead of leaving Blender."""

    def error(self, message: str):
        raise ValueError(message)


def _integer(least: int, most: int = k_most):
    span = f"of at least {least}" if most == k_most else f"from {least} to {most}"

    def parse(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if not least <= number <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not a whole number {span}")
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


def _number(least: float, most: float):
    def parse(text: str) -> float:
        try:
            number = float(text)
        except ValueError:
            number = float("nan")
        if not least <= number <= most:
            raise argparse.ArgumentTypeError(f"'{text}' is not a number from {least:g} to {most:g}")
        return number

    return parse


def _choice(values: dict[str, Any]):
    """One of `values`' names, in any case; its value."""
    def parse(text: str) -> Any:
        if text.lower() not in values:
            raise argparse.ArgumentTypeError(f"'{text}' is not one of {', '.join(values)}")
        return values[text.lower()]

    return parse


def _of_setting(name: str, metavar: str, text: str, option: str = "") -> tuple:
    """The argument of a setting of the table, with the setting's own limits. option: where its name says it better."""
    setting = k_by_name[name]
    if setting.kind == "int":
        parser = _integer(setting.options["min"], setting.options["max"])
    elif setting.kind == "float":
        parser = _number(setting.options["min"], setting.options["max"])
    else:
        values = {key.lower(): key for key in setting.items} if setting.items else {"on": True, "off": False}
        parser, metavar = _choice(values), "|".join(values)
    return f"--cardioid-{option or name.replace('_', '-')}", name, parser, metavar, text


k_arguments = (
    # option, name in scene.cardioid, parser (None: a flag), value's name, help
    ("--cardioid-samples", "samples", _integer(1), "N", "camera paths a pixel"),
    ("--cardioid-integrator", "integrator", _integrator, "NAME", "PTPPM, PT or SPPM, as far as the engine has them"),
    ("--cardioid-time-limit", "time_limit", _seconds, "SECONDS", "stop a frame after this time; 0: no limit"),
    ("--cardioid-threads", "threads", _integer(0), "N", "threads to render with; 0: as Blender is set"),
    ("--cardioid-seed", "seed", _integer(0), "N", "seed of the noise"),
    _of_setting("indirect_caustics", "", "what makes caustics of scattered light"),
    _of_setting("photons", "N", "photons for each sample of the picture; 0: by the size of the picture"),
    _of_setting("photon_radius", "PIXELS", "radius at the start within which a pixel looks for photons"),
    _of_setting("caustic_roughness", "ROUGHNESS", "reflections up to this roughness throw caustics by photons"),
    _of_setting("radius_shrink", "ALPHA", "the smaller, the faster radii shrink; 1: never"),
    _of_setting("radius_schedule", "", "what makes radii shrink"),
    _of_setting("guided_emission", "", "photons learn where they are needed"),
    _of_setting("blend_caustic_hits", "", "caustics that path tracing finds count too"),
    _of_setting("physical_refraction", "", "radiance changes where light enters glass"),
    _of_setting("use_adaptive_sampling", "", "pixels that are clean enough get no more samples", "adaptive-sampling"),
    _of_setting("adaptive_threshold", "NOISE", "noise at which a pixel is clean enough; 0: by the samples"),
    _of_setting("adaptive_min_samples", "N", "samples that every pixel gets; 0: by the threshold"),
    _of_setting("use_filter", "", "take fireflies and noise out of the picture", "filter"),
    _of_setting("filter_method", "", "how noise is told from picture; none: fireflies only"),
    _of_setting("firefly_density", "DENSITY", "the larger, the more fireflies go; 0: all light stays"),
    _of_setting("luminance_sensitivity", "SHARE", "light within this share of brightness is smoothed together"),
    _of_setting("filter_size", "PIXELS", "width of what is smoothed together"),
    _of_setting("filter_direct", "", "smooth light that comes straight from lamps"),
    _of_setting("filter_indirect", "", "smooth light of one bounce"),
    _of_setting("filter_deep", "", "smooth light of more bounces"),
    _of_setting("texture_width", "WIDTH", "for cross_bilateral: how unlike textures may be"),
    _of_setting("save_film", "", "save a film beside each frame, to filter it again"),
    ("--cardioid-film", "film", str, "FILE.cardioid", "save the film there; # is the frame number"),
    ("--cardioid-stats", "stats", str, "FILE.json", "write times, counts and memory of each frame there"),
    ("--cardioid-print-stats", "print_stats", None, None, "print a table of counts and times after each frame"),
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
        if convert is None:
            parser.add_argument(option, dest=name, action="store_const", const=True, help=text)
        else:
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
    others = {name: values.pop(name) for name in ("stats", "print_stats", "export", "film") if name in values}
    return Arguments(overrides=values, problems=tuple(problems), **others)


def current() -> Arguments:
    """The arguments of this Blender."""
    return parse(sys.argv)
