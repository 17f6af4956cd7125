# SPDX-License-Identifier: GPL-3.0-or-later
"""What is known about a case in a host, and as a line of text."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pixels
from batches import Rendered

LEFT_OUT = "is left out"
"""How the add-on's warning begins when an object could not be handed to the engine."""

COVERAGE = 0.4
"""Less than this share of a tile to be seen: the case is wrong, and two black pictures would agree."""


@dataclass
class Result:
    host: str
    case: str
    uses: str
    tolerance: float
    verdict: pixels.Verdict | None = None
    skipped: str = ""
    problem: str = ""
    warning: str = ""
    blind: bool = False
    """A picture that is 0.3 % brighter would pass too."""
    ours: np.ndarray | None = None
    reference: np.ndarray | None = None

    @property
    def passed(self) -> bool:
        return not self.skipped and not self.problem and not self.blind and bool(self.verdict and self.verdict.passed)

    @property
    def failed(self) -> bool:
        return not self.skipped and not self.passed

    def summary(self) -> dict[str, Any]:
        found: dict[str, Any] = {"host": self.host, "case": self.case, "node": self.uses, "passed": self.passed}
        for key in ("skipped", "problem", "warning", "blind"):
            if getattr(self, key):
                found[key] = getattr(self, key)
        if self.verdict:
            found.update(vars(self.verdict), passed=self.passed, tolerance=self.tolerance)
        return found


def result_of(host: str, name: str, told: dict, ours: Any, reference: Any) -> Result:
    """Ours and the reference: what came of the group that the case is in."""
    result = Result(host, name, told["uses"], told["tolerance"], warning=ours.warnings.get(name, ""))
    result.skipped = reference.skipped.get(name, "")
    result.problem = reference.problems.get(name) or ours.problems.get(name) or ""
    if result.warning.startswith(LEFT_OUT):
        result.problem = "Cardioid: " + result.warning
    if result.skipped or result.problem:
        return result
    a, b = ours.pictures.get(name), reference.pictures.get(name)
    if a is None or b is None:
        result.problem = "not rendered"
        return result
    seen = float((b[0, ..., 3] > 0.5).mean())
    if seen < COVERAGE:
        result.problem = f"the case shows nothing on {1 - seen:.0%} of its tile"
        return result
    a, b = a[..., :3], b[..., :3]
    result.ours, result.reference = a[0], b[0]

    def judge(picture: np.ndarray) -> pixels.Verdict:
        if told["group"] == "noisy":
            return pixels.compare_noisy(picture, b[0], told["floor"])
        return pixels.compare(picture, b, told["tolerance"], told["floor"])

    result.verdict = judge(a[0])
    if result.verdict.passed and told["group"] != "noisy":
        result.blind = judge(pixels.mutant(a[0])).passed
    return result


def results_of(host: str, listed: dict, names: list[str], ours: Rendered, reference: Rendered) -> list[Result]:
    return [result_of(host, name, listed[name], ours, reference) for name in names]


def line(result: Result) -> str:
    """One case as text."""
    state = "pass" if result.passed else "skip" if result.skipped else "FAIL"
    text = f"{state} {result.host} {result.case}:"
    if result.skipped or result.problem:
        return f"{text} {result.skipped or result.problem.strip().splitlines()[-1]}"
    found = result.verdict
    ours, reference = (" ".join(f"{v:.6g}" for v in values) for values in (found.ours, found.reference))
    text += f" {100 * found.within:.2f} % agree, {100 * found.explained:.2f} % explained"
    if found.worst > 0.0:
        text += f"; worst {found.worst:.2g} at {found.at[0]},{found.at[1]}: ({ours}) for ({reference})"
    if result.blind:
        text += "; a picture 0.3 % brighter would pass"
    return text + (f"; “{result.warning}”" if result.warning else "")
