# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines that say what runs and how long the rest will take: `[3/12] cornell, PTPPM … 42 s left of the budget, about
180 s to go`."""

from __future__ import annotations

import time

from .store import Store

NOTHING = 0.05
"""Seconds under which a step was only looked up: it says nothing of those that still have to run."""


class Progress:
    """Counts the steps of a subcommand; a step's time is that until the next one begins."""

    def __init__(self, total: int, records: Store, clock=time.monotonic):
        self.total, self.records, self.clock = total, records, clock
        self.done, self.costs, self.began = 0, [], None

    def to_go(self) -> float | None:
        """Seconds that this and the later steps will take, by the mean of those that ran; None before the first."""
        return (self.total - self.done + 1) * sum(self.costs) / len(self.costs) if self.costs else None

    def step(self, what: str) -> None:
        """Tells of the next step, before it starts."""
        now = self.clock()
        if self.began is not None and now - self.began > NOTHING:
            self.costs.append(now - self.began)
        self.began = now
        self.done += 1
        self.total = max(self.total, self.done)
        parts = []
        if self.records.left() != float("inf"):
            parts.append(f"{max(self.records.left(), 0.0):.0f} s left of the budget")
        rest = self.to_go()
        if rest is not None:
            parts.append(f"about {rest:.0f} s to go")
        print(f"[{self.done}/{self.total}] {what}" + (" … " + ", ".join(parts) if parts else ""), flush=True)
