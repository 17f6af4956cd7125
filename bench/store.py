# SPDX-License-Identifier: GPL-3.0-or-later
"""Records as JSON lines: a run that is there is not made again, so every command can be stopped and resumed."""

from __future__ import annotations

import csv
import errno
import io
import json
import os
import shutil
import tempfile
import time
from pathlib import Path

from . import measure
from .engines import Engine, Job
from .result import write_atomically

FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}
NEEDED = 500e6
"""Bytes that a subcommand's pictures and films need at reduced size, roughly."""


def is_full(error: OSError) -> bool:
    return error.errno in FULL


class DiskFull(RuntimeError):
    """One sentence: what could not be written, where, how much is needed, and what is kept."""

    @classmethod
    def of(cls, error: OSError | str, where: Path, kept: int | None = None) -> DiskFull:
        """`where`: a folder or file of the full disk, which may be missing; `kept`: records."""
        there = where
        while not there.exists() and there != there.parent:
            there = there.parent
        free = shutil.disk_usage(there).free
        what = getattr(error, "filename", None) or where
        reason = error if isinstance(error, str) else error.strerror
        had = "what was measured before" if kept is None else f"the {kept} records made before"
        return cls(
            f"{reason}: {what} could not be written ({free / 1e6:.1f} MB are free there, about {NEEDED / 1e6:.0f} MB "
            f"are needed); {had} and all older results are kept: free some space or give another --cache, and run "
            "the same command again to go on."
        )


class Store:
    """One file of records. A record's `key` says what was run; the rest is what came of it.

    The budget counts from the store's making. A run is not started when the longest like run of this process, one with
    the same kind (the key's first part) and engine (its second), would not fit into what is left.
    """

    def __init__(self, path: Path, budget: float = 0.0):
        self.path, self.records = path, {}
        self.end = time.monotonic() + budget if budget > 0 else float("inf")
        self.stopped, self.asked = False, None
        self.longest: dict[tuple, float] = {}
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            if is_full(error):
                raise DiskFull.of(error, path) from error
            raise
        if path.exists():
            for text in path.read_text(errors="replace").splitlines():
                try:
                    record = json.loads(text)
                    self.records[tuple(record["key"])] = record
                except (json.JSONDecodeError, KeyError, TypeError):  # the last line of a run that was killed
                    continue

    def left(self) -> float:
        """Seconds of the budget; infinite without one."""
        return self.end - time.monotonic()

    def estimate(self, key: tuple = ()) -> float:
        """Seconds of the longest run like this one; of any, without a key; 0 before the first."""
        if not key:
            return max(self.longest.values(), default=0.0)
        return self.longest.get(tuple(key[:2]), 0.0)

    def out_of_time(self, key: tuple = ()) -> bool:
        """Ask before each run, with its key: whether it must not be started any more."""
        self.asked = time.monotonic()
        over = self.asked + self.estimate(key) > self.end
        self.stopped = self.stopped or over
        return over

    def get(self, *key) -> dict | None:
        return self.records.get(key)

    def add(self, key: tuple, record: dict) -> dict:
        """Keeps a record at once. DiskFull if it cannot: the file is as it was before."""
        if self.asked is not None:
            like = tuple(key[:2])
            self.longest[like] = max(self.longest.get(like, 0.0), time.monotonic() - self.asked)
            self.asked = None
        record = {"key": list(key), "time": time.strftime("%Y-%m-%dT%H:%M:%S"), **record}
        try:
            append_line(self.path, json.dumps(record))
        except OSError as error:
            if is_full(error):
                raise DiskFull.of(error, self.path, len(self.records)) from error
            raise
        self.records[tuple(key)] = record
        return record


def append_line(path: Path, text: str) -> None:
    """Adds a whole line or nothing; a torn line at the end, of a run that was killed, is ended first."""
    size = path.stat().st_size if path.exists() else 0
    with path.open("ab+", buffering=0) as file:
        if size:
            file.seek(size - 1)
            if file.read(1) != b"\n":
                text = "\n" + text
        data = f"{text}\n".encode()
        try:
            written = 0
            while written < len(data):
                written += file.write(data[written:])
        except OSError:
            file.truncate(size)
            raise


def render(engine: Engine, job: Job, until=None) -> dict:
    """Runs a job; returns its cost and what the engine said. RuntimeError, with the end of its output, if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        command, env = engine.command(job, Path(folder))
        cost = measure.run(command, env=env, until=until)
        if cost.code != 0 or (job.out and not Path(job.out).exists()):
            raise failure(f"{engine.key} failed with exit code {cost.code}", cost.lines, Path(job.out or folder))
        record = {"cpu": cost.cpu, "wall": cost.wall, "peak_bytes": cost.peak_bytes, "load": cost.load}
        record["lines"] = cost.lines
        for _, text in cost.lines:
            if text.startswith("RESULT "):
                record |= json.loads(text[7:])
        return record | engine.extra(job, Path(folder))


def failure(what: str, lines: list[tuple[float, str]], where: Path) -> RuntimeError:
    """The error of a program that ended badly, with the end of its output; DiskFull if that was why."""
    said = [text for _, text in lines]
    if any("No space left on device" in text or "File too large" in text for text in said) or disk_is_full(where):
        return DiskFull.of("No space left on device", where)
    return RuntimeError(f"{what}:\n" + "\n".join(said[-15:]))


def disk_is_full(where: Path) -> bool:
    """Whether not even a small picture would fit."""
    folder = next((one for one in (where, *where.parents) if one.is_dir()), Path("/"))
    return shutil.disk_usage(folder).free < 1e6


def write_table(rows: list[dict], stem: Path) -> None:
    """The same rows as CSV and JSON."""
    write_atomically(stem.with_suffix(".json"), json.dumps(rows, indent=1))
    if rows:
        names = list(dict.fromkeys(name for row in rows for name in row))
        out = io.StringIO()
        writer = csv.DictWriter(out, names)
        writer.writeheader()
        writer.writerows(rows)
        write_atomically(stem.with_suffix(".csv"), out.getvalue())


def show_table(rows: list[dict], columns: dict[str, str]) -> str:
    """Rows as aligned text; `columns` gives each column's format."""
    cells = [list(columns)]
    for row in rows:
        cells.append([format(row[c], f) if row.get(c) is not None else "-" for c, f in columns.items()])
    widths = [max(len(line[i]) for line in cells) for i in range(len(columns))]
    return "\n".join(
        "  ".join(cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths)))
        for line in cells
    )


def publish(rows: list[dict], columns: dict[str, str], stem: Path) -> None:
    """Prints the table and writes it beside the pictures."""
    print(show_table(rows, columns))
    write_table(rows, stem)
    print(f"{os.path.relpath(stem)}.csv, .json", flush=True)
