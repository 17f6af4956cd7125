# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases: each builds nodes in the material of one tile and names the output that the tile emits."""

from __future__ import annotations

import fnmatch
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

TOLERANCE = 1e-3
NOISE = 2e-3
"""Relative bound of procedural noise."""
FLOOR = 1e-2
"""Values below this are compared as if they were this large."""


class Skip(Exception):
    """This Blender has not got the node, property or socket."""


@dataclass(frozen=True)
class Case:
    """One tile. `build(tile)` returns an output socket.

    stage: the shape and the place of the tile (stage.py). floor: see FLOOR; larger where the value depends on the exact
    place of the sample, which the engines choose within a hundredth of a pixel. noisy: an integral, rendered with many
    samples; only its mean is compared. perspective: seen by a camera with perspective (for flat tiles only).
    uses: the node type that the case is about.
    """

    name: str
    build: Callable[[Any], Any]
    uses: str
    stage: str = "flat"
    tolerance: float = TOLERANCE
    floor: float = FLOOR
    noisy: bool = False
    perspective: bool = False

    @property
    def group(self) -> str:
        """Cases of one group share a picture."""
        return "noisy" if self.noisy else "perspective" if self.perspective else "exact"


CASES: dict[str, Case] = {}


def add(case: Case) -> None:
    if case.name in CASES:
        raise ValueError(f"two cases are called {case.name}")
    CASES[case.name] = case


def row(
    name: str,
    kind: str,
    inputs: dict[Any, Any] | None = None,
    output: Any = 0,
    *,
    setup: Callable[[Any], None] | None = None,
    stage: str = "flat",
    tolerance: float = TOLERANCE,
    floor: float = FLOOR,
    noisy: bool = False,
    perspective: bool = False,
    **properties: Any,
) -> None:
    """A case of one node: its properties, its inputs (constants, or functions of the tile) and the output shown
    (None: the first that is in use)."""

    def build(tile: Any) -> Any:
        node = tile.node(kind, inputs, setup=setup, **properties)
        return tile.output(node, output)

    add(Case(name, build, kind, stage, tolerance, floor, noisy, perspective))


def case(name: str, uses: str, **options: Any) -> Callable[[Callable[[Any], Any]], Callable[[Any], Any]]:
    """Registers a function that builds more than one node."""

    def register(build: Callable[[Any], Any]) -> Callable[[Any], Any]:
        add(Case(name, build, uses, **options))
        return build

    return register


def matching(patterns: Iterable[str]) -> list[str]:
    """Names that fit one of the patterns (glob); all of them without patterns."""
    wanted = list(patterns)
    return [n for n in CASES if not wanted or any(fnmatch.fnmatchcase(n, p) for p in wanted)]
