# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a session to its end: progress into Blender's status line, pictures into the result, Esc into a cancel."""

from __future__ import annotations

import time
from typing import Any

import bpy

from . import progress as words
from .messages import RenderProblem
from .render_result import Target

k_poll_seconds = 0.05       # Esc is looked for this often
k_first_refresh = 0.2       # seconds between pictures at the start of a render …
k_slow_refresh = 2.0        # … and at most, once it has run for a while
k_refresh_share = 0.1       # part of the time that drawing intermediate pictures may take
k_log_seconds = 1.0         # a line of progress in the log of a background render


class StatusLine:
    """Progress into Blender's header and memory display, no oftener than it is read."""

    def __init__(self, engine: bpy.types.RenderEngine):
        self._engine = engine
        self._text = ""
        self._told = 0.0
        self._peak = 0.0
        self._pause = k_log_seconds if bpy.app.background else k_first_refresh

    def tell(self, progress: dict[str, Any], *, now: bool = False) -> None:
        self._engine.update_progress(min(1.0, max(0.0, progress.get("fraction", 0.0))))
        text = words.line(progress)
        if text == self._text or (not now and time.monotonic() - self._told < self._pause):
            return
        self._text, self._told = text, time.monotonic()
        used = progress.get("memory_bytes", 0) / (1 << 20)
        self._peak = max(self._peak, used)
        self._engine.update_memory_stats(memory_used=used, memory_peak=self._peak)
        self._engine.update_stats("", text)


class Refresh:
    """Decides when the next picture is shown: soon at first, then so seldom that drawing costs little."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._next = 0.0
        self._revision = None

    def due(self, revision: Any) -> bool:
        return revision != self._revision and time.monotonic() >= self._next

    def shown(self, revision: Any, cost: float) -> None:
        now = time.monotonic()
        pause = min(k_slow_refresh, max(k_first_refresh, (now - self._start) * k_refresh_share))
        self._revision = revision
        self._next = now + max(pause, cost / k_refresh_share)


def run(engine: bpy.types.RenderEngine, session: Any, target: Target, *, quiet: bool = False) -> bool:
    """True when the render came to its end, False when the user stopped it; the picture is in the result either way.

    quiet: no status line (material previews). Raises RenderProblem when the engine failed.
    """
    status, refresh = StatusLine(engine), Refresh()
    stopped = False
    session.start()
    while not session.wait(k_poll_seconds):
        if not stopped and engine.test_break():
            session.cancel()
            stopped = True
        progress = session.progress()
        if not quiet:
            status.tell(progress)
        if not stopped and refresh.due(progress.get("revision", 0)):
            _show(session, target, refresh, progress.get("revision", 0))
    progress = session.progress()
    if progress.get("phase") == "failed":
        raise RenderProblem(progress.get("message") or "the engine failed without saying why")
    frame = session.frame()
    if frame is not None:
        target.show(frame)
    else:
        target.leave_black()
    if not quiet:
        status.tell(progress, now=True)
    return not stopped


def _show(session: Any, target: Target, refresh: Refresh, revision: Any) -> None:
    frame = session.frame()
    if frame is not None:
        start = time.monotonic()
        target.show(frame)
        refresh.shown(revision, time.monotonic() - start)
