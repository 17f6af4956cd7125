# SPDX-License-Identifier: GPL-3.0-or-later
"""A running Blender that a test watches, interrupts and waits for."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import threading
import time


class Live:
    """Collects what the process prints; `with` makes sure that it is gone in the end."""

    def __init__(self, process: subprocess.Popen) -> None:
        self.process = process
        self.text = ""
        self._changed = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def __enter__(self) -> Live:
        return self

    def __exit__(self, *_) -> None:
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self._reader.join(5)

    def _read(self) -> None:
        for line in self.process.stdout:
            with self._changed:
                self.text += line
                self._changed.notify_all()
        with self._changed:
            self._changed.notify_all()

    def wait_for(self, pattern: str, seconds: float) -> str:
        """Waits until a line matches; the test fails when that does not happen."""
        end = time.monotonic() + seconds
        with self._changed:
            while True:
                match = re.search(pattern, self.text, re.MULTILINE)
                if match:
                    return match.group()
                left = end - time.monotonic()
                assert left > 0, f"'{pattern}' did not appear within {seconds} s:\n{self.text[-3000:]}"
                assert self._reader.is_alive(), f"Blender ended before '{pattern}':\n{self.text[-3000:]}"
                self._changed.wait(min(left, 0.5))

    def send(self, number: signal.Signals) -> None:
        self.process.send_signal(number)

    def wait_for_end(self, seconds: float) -> float:
        """Seconds until the process is gone; the test fails when it stays."""
        start = time.monotonic()
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            raise AssertionError(f"Blender is still there after {seconds} s:\n{self.text[-3000:]}") from None
        self._reader.join(5)
        return time.monotonic() - start
