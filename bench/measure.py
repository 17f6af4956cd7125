# SPDX-License-Identifier: GPL-3.0-or-later
"""What a command costs, seen from outside: CPU seconds and peak memory of its whole process tree."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
_libc = ctypes.CDLL(None, use_errno=True)


@dataclass
class Cost:
    """CPU seconds (user + system) of the process and its descendants; the peak memory of the largest of them."""

    code: int
    cpu: float
    wall: float
    peak_bytes: int
    load: float
    lines: list[tuple[float, str]] = field(default_factory=list)
    """What it printed, each line with the seconds since the start."""


def adopt_orphans() -> None:
    """Makes this process the parent of descendants whose own parent has ended, so that their time is counted too."""
    _libc.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def die_with_parent() -> None:
    """In a child before it becomes its program: a bench that is killed leaves no render behind."""
    _libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)


def run(
    command: list[str],
    *,
    env: dict[str, str] | None = None,
    cwd: Path | None = None,
    timeout: float = 1800.0,
    until: Callable[[str], bool] | None = None,
) -> Cost:
    """Runs a command to its end, or until a printed line satisfies `until`, and counts.

    Time spent in children counts once they have been waited for, as the kernel sums it up the tree; orphans are adopted
    and waited for here.
    """
    adopt_orphans()
    start = time.monotonic()
    process = subprocess.Popen(
        command,
        env={**os.environ, **(env or {})},
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
        preexec_fn=die_with_parent,
    )
    try:
        return followed(process, start, timeout, until)
    except BaseException:  # Ctrl-C above all: nothing that was started goes on
        kill_group(process.pid)
        reap(process.pid)
        raise


def followed(process: subprocess.Popen, start: float, timeout: float, until: Callable[[str], bool] | None) -> Cost:
    """Reads and waits to the end."""
    timer = start + timeout
    lines: list[tuple[float, str]] = []
    assert process.stdout is not None
    os.set_blocking(process.stdout.fileno(), False)
    rest = b""
    stopped = False
    usage = None
    while usage is None:
        data = process.stdout.read()
        if data:
            *whole, rest = (rest + data).split(b"\n")
            now = time.monotonic() - start
            lines += [(now, text.decode(errors="replace")) for text in whole]
            stopped = stopped or (until is not None and any(until(text.decode(errors="replace")) for text in whole))
        if stopped or time.monotonic() > timer:
            kill_group(process.pid)
        pid, status, found = os.wait4(process.pid, os.WNOHANG)
        if pid:
            usage = found
            process.returncode = os.waitstatus_to_exitcode(status)
        elif not data:
            time.sleep(0.002 if until else 0.02)
    data = process.stdout.read()
    lines += [
        (time.monotonic() - start, text.decode(errors="replace"))
        for text in (rest + (data or b"")).split(b"\n")
        if text
    ]
    process.stdout.close()
    cpu, peak = usage.ru_utime + usage.ru_stime, usage.ru_maxrss
    orphans = reap(process.pid)
    wall = time.monotonic() - start
    code = 0 if stopped else process.returncode
    return Cost(code, cpu + orphans[0], wall, max(peak, orphans[1]) * 1024, os.getloadavg()[0], lines)


def kill_group(group: int) -> None:
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, signal.SIGKILL)


def reap(group: int, patience: float = 10.0) -> tuple[float, int]:
    """Waits for adopted descendants of a process group; returns their CPU seconds and largest peak in KiB."""
    cpu, peak, end = 0.0, 0, time.monotonic() + patience
    while True:
        try:
            pid, _, usage = os.wait4(-group, os.WNOHANG)
        except ChildProcessError:
            return cpu, peak
        if pid:
            cpu, peak = cpu + usage.ru_utime + usage.ru_stime, max(peak, usage.ru_maxrss)
        elif time.monotonic() > end:
            kill_group(group)
            end = time.monotonic() + patience
        else:
            time.sleep(0.02)
