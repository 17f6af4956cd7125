# SPDX-License-Identifier: GPL-3.0-or-later
"""Results as JSON lines: a run that is there is not made again, so every command can be stopped and resumed."""

from __future__ import annotations

import csv
import json
import os
import tempfile
import time
from pathlib import Path

from . import measure
from .engines import Engine, Job


class Store:
    """One file of records. A record's `key` says what was run; the rest is what came of it."""

    def __init__(self, path: Path, budget: float = 0.0):
        path.parent.mkdir(parents=True, exist_ok=True)
        self.path, self.records = path, {}
        self.end = time.monotonic() + budget if budget > 0 else float("inf")
        if path.exists():
            for text in path.read_text().splitlines():
                try:
                    record = json.loads(text)
                except json.JSONDecodeError:  # the last line of a run that was killed
                    continue
                self.records[tuple(record["key"])] = record

    def out_of_time(self) -> bool:
        return time.monotonic() > self.end

    def get(self, *key) -> dict | None:
        return self.records.get(key)

    def add(self, key: tuple, record: dict) -> dict:
        record = {"key": list(key), "time": time.strftime("%Y-%m-%dT%H:%M:%S"), **record}
        with self.path.open("a") as file:
            file.write(json.dumps(record) + "\n")
        self.records[key] = record
        return record


def render(engine: Engine, job: Job, until=None) -> dict:
    """Runs a job; returns its cost and what the engine said. RuntimeError, with the end of its output, if it fails."""
    with tempfile.TemporaryDirectory() as folder:
        command, env = engine.command(job, Path(folder))
        cost = measure.run(command, env=env, until=until)
        if cost.code != 0 or (job.out and not Path(job.out).exists()):
            tail = "\n".join(text for _, text in cost.lines[-15:])
            raise RuntimeError(f"{engine.key} failed with exit code {cost.code}:\n{tail}")
        record = {"cpu": cost.cpu, "wall": cost.wall, "peak_bytes": cost.peak_bytes, "load": cost.load}
        record["lines"] = cost.lines
        for _, text in cost.lines:
            if text.startswith("RESULT "):
                record |= json.loads(text[7:])
        return record | engine.extra(job, Path(folder))


def write_table(rows: list[dict], stem: Path) -> None:
    """The same rows as CSV and JSON."""
    stem.parent.mkdir(parents=True, exist_ok=True)
    stem.with_suffix(".json").write_text(json.dumps(rows, indent=1))
    if rows:
        names = list(dict.fromkeys(name for row in rows for name in row))
        with stem.with_suffix(".csv").open("w", newline="") as file:
            writer = csv.DictWriter(file, names)
            writer.writeheader()
            writer.writerows(rows)


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
