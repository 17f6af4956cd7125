# SPDX-License-Identifier: GPL-3.0-or-later
"""Sessions that are running in this Blender: one final render at a time, and none left behind when Blender quits."""

from __future__ import annotations

import atexit
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .messages import RenderProblem

_running: list[Any] = []
_final = threading.Lock()


@contextmanager
def exclusive(*, preview: bool) -> Iterator[None]:
    """Holds the place of the final render; previews (material balls) need none."""
    if preview:
        yield
        return
    if not _final.acquire(blocking=False):
        raise RenderProblem("Another Cardioid render is still running in this Blender; wait for it or stop it first")
    try:
        yield
    finally:
        _final.release()


@contextmanager
def opened(session: Any) -> Iterator[Any]:
    """Keeps track of a session while it lives; it is cancelled and finished on the way out, whatever happened."""
    _running.append(session)
    try:
        yield session
    finally:
        session.cancel()
        _running.remove(session)


def cancel_all() -> None:
    """Asks every running session to stop."""
    for session in list(_running):
        session.cancel()


def register() -> None:
    atexit.register(cancel_all)


def unregister() -> None:
    cancel_all()
    atexit.unregister(cancel_all)
