# SPDX-License-Identifier: GPL-3.0-or-later
"""What the programs that run inside a renderer share: one render by the clock or by samples, one line of JSON.

    RESULT {"cpu": …, "wall": …, "samples": …, "version": "…"}

`cpu` and `wall` are seconds of the rendering as the process itself sees them; who started it counts the whole process.
"""

from __future__ import annotations

import argparse
import json
import time


def arguments(words: list[str], modes: tuple[str, ...]) -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    parser.add_argument("--mode", choices=modes, required=True)
    parser.add_argument("--out", required=True, metavar="FILE.exr")
    parser.add_argument("--scene", default="", help="of bench/rivals/scenes.py")
    parser.add_argument("--blend", default="", metavar="FILE", help="the same as a file (Cycles)")
    parser.add_argument("--samples", type=int, default=0, help="a pixel")
    parser.add_argument("--cpu", type=float, default=0.0, help="seconds; renders until then instead")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    chosen = parser.parse_args(words)
    if (chosen.samples > 0) == (chosen.cpu > 0):
        parser.error("give either --samples or --cpu")
    return chosen


class Clock:
    """CPU and wall seconds since it was made, of this process and all its threads."""

    def __init__(self) -> None:
        self._cpu, self._wall = time.process_time(), time.monotonic()

    def cpu(self) -> float:
        return time.process_time() - self._cpu

    def report(self, samples: float, version: str) -> None:
        found = {"cpu": round(self.cpu(), 3), "wall": round(time.monotonic() - self._wall, 3)}
        print("RESULT " + json.dumps(found | {"samples": round(samples, 2), "version": version}), flush=True)
