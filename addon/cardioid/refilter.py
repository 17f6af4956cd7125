# SPDX-License-Identifier: GPL-3.0-or-later
"""Filters a kept film on the engine's own threads; of several wishes the latest wins."""

from __future__ import annotations

import time
from collections.abc import Callable
from types import ModuleType
from typing import Any

from .films import Kept

k_poll_seconds = 0.03


class Refilter:
    """One film, filtered again whenever `want` says something new. `want` may be called from another thread."""

    def __init__(self, module: ModuleType, kept: Kept, settings: dict[str, Any], threads: int = 0):
        self._module, self._kept, self._threads = module, kept, threads
        self.wanted = settings
        self._told: dict[str, Any] | None = None
        self._job: Any = None
        self._start = 0.0

    def want(self, settings: dict[str, Any]) -> None:
        self.wanted = settings

    def poll(self, seconds: float = 0.0) -> Any:
        """Waits at most that long; a new frame, or None while there is none. Raises the engine's Error."""
        wanted = self.wanted
        if wanted != self._told:
            self.cancel()
            self._job = self._module.FilterJob(self._kept.film, _for_job(wanted), self._threads)
            self._job.start()
            self._told, self._start = wanted, time.monotonic()
        if self._job is None or not self._job.wait(seconds):
            return None
        job, self._job = self._job, None
        progress = job.progress()
        if progress.get("phase") == "failed":
            raise self._module.Error([progress.get("message") or "the filter failed without saying why"])
        frame = job.frame()
        if frame is not None:
            self._kept.settings = wanted
            self._kept.stats = {**job.stats(), "elapsed": time.monotonic() - self._start}
        return frame

    def busy(self) -> bool:
        return self._job is not None or self.wanted != self._told

    def fraction(self) -> float:
        job = self._job
        return job.progress().get("fraction", 0.0) if job is not None else 0.0

    def cancel(self) -> None:
        if self._job is not None:
            self._job.cancel()
            self._job = None


def _for_job(settings: dict[str, Any]) -> dict[str, Any]:
    """Switched off, the filter has nothing to work out for passes either."""
    return settings if settings["use_filter"] else {**settings, "filter_method": "none", "firefly_density": 0.0}


def run(work: Refilter, show: Callable[[Any], None], stop: Callable[[], bool], tell: Callable[[float], None],
        linger: float) -> None:
    """Shows each new frame until nothing was wished for `linger` seconds, or `stop` says so. `tell` gets the share
    done, and may wish."""
    busy_at = time.monotonic()
    while not stop():
        frame = work.poll(k_poll_seconds)
        if frame is not None:
            show(frame)
        tell(work.fraction() if work.busy() else 1.0)
        if work.busy():
            busy_at = time.monotonic()
        elif time.monotonic() - busy_at >= linger:
            return
        else:
            time.sleep(k_poll_seconds)
    work.cancel()
