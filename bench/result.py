# SPDX-License-Identifier: GPL-3.0-or-later
"""What a subcommand of the bench found: a folder `<cache>/results/<name>/` with result.json, a CSV file per table,
plots and pictures. The report and the docs' gallery are built from these folders alone.

result.json holds the fields of `Result`; paths in it are relative to its folder. Pictures are PNG, display-referred,
one exposure per scene; those that are to be compared with a slider share `scene` and size.
"""

from __future__ import annotations

import csv
import io
import json
import os
import platform
import subprocess
import tempfile
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FORMAT = 1


@dataclass
class Table:
    """Rows by column; `columns`: key → [title, format]. A comparison has error, energy ratio and CPU seconds."""

    name: str
    """Of its CSV file."""
    title: str
    columns: dict[str, list[str]]
    rows: list[dict]
    note: str = ""


@dataclass
class Picture:
    """One renderer's picture. `energy`: mean over the reference's; `error`: relMSE; None: not measured."""

    scene: str
    label: str
    file: str
    settings: str = ""
    cpu: float | None = None
    error: float | None = None
    energy: float | None = None
    reference: bool = False


@dataclass
class Verdict:
    """A claim and whether this run bears it out. `holds` None: cannot be told from this run."""

    claim: str
    source: str
    holds: bool | None
    figures: str


@dataclass
class Result:
    """`full`: the command for the full size; `reduced`: this run was smaller; `missing`: what was left out, and why."""

    name: str
    title: str
    full: str
    reduced: bool
    tables: list[Table] = field(default_factory=list)
    plots: list[str] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)
    verdicts: list[Verdict] = field(default_factory=list)
    settings: dict[str, str] = field(default_factory=dict)
    """Who ran how: renderer → its settings in words (samples, bounces, sampler, what differs from its defaults)."""
    missing: list[str] = field(default_factory=list)
    complete: bool = True
    """False: the budget ended first."""
    machine: dict = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)
    commit: str = ""
    made: str = ""


def machine() -> dict:
    """The processor, its cores, memory in GiB and the system."""
    cpu = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = [
            line.split(":", 1)[1].strip() for line in cpuinfo.read_text().splitlines() if line.startswith("model name")
        ]
        cpu = names[0] if names else cpu
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return {"cpu": cpu, "cores": os.cpu_count(), "memory_gib": round(memory, 1), "system": platform.platform()}


def commit() -> str:
    """The checkout's commit, with `+` when files differ from it; empty without git."""
    found = subprocess.run(
        ["git", "-C", str(ROOT), "describe", "--always", "--dirty=+", "--exclude=*"],
        capture_output=True,
        text=True,
        check=False,
    )
    return found.stdout.strip()


def write_atomically(path: Path, text: str) -> None:
    """To a temporary name first: a full disk or a kill leaves the old file. OSError names the path."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.NamedTemporaryFile("w", dir=path.parent, prefix=f".{path.name}.", delete=False, newline="") as file:
        try:
            file.write(text)
            file.flush()
            os.chmod(file.name, 0o644)
            os.replace(file.name, path)
        except OSError:
            os.unlink(file.name)
            raise


def csv_text(table: Table) -> str:
    """The table's rows under their keys; columns that are not shown follow."""
    names = list(dict.fromkeys([*table.columns, *(key for row in table.rows for key in row)]))
    out = io.StringIO()
    writer = csv.DictWriter(out, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(table.rows)
    return out.getvalue()


def plain(value):
    """A number or truth value of numpy's as Python's own, for JSON."""
    return value.item()


def folder(cache: Path, name: str) -> Path:
    """Where a subcommand's result, plots and pictures are."""
    return cache / "results" / name


def save(result: Result, cache: Path) -> Path:
    """Writes result.json and the CSV files; fills in machine, commit and time. Returns the folder."""
    result.machine = result.machine or machine()
    result.commit = result.commit or commit()
    result.made = result.made or time.strftime("%Y-%m-%dT%H:%M:%S%z")
    where = folder(cache, result.name)
    missing = [name for name in (*result.plots, *(p.file for p in result.pictures)) if not (where / name).exists()]
    if missing:
        raise FileNotFoundError(f"{result.name}: the result names files that are not there: {', '.join(missing)}")
    for table in result.tables:
        write_atomically(where / f"{table.name}.csv", csv_text(table))
    write_atomically(
        where / "result.json", json.dumps({"format": FORMAT, **asdict(result)}, indent=1, default=plain) + "\n"
    )
    return where


def load(where: Path) -> Result:
    """A folder's result. ValueError if it is none, or of another format."""
    path = where / "result.json"
    try:
        raw = json.loads(path.read_text())
        if raw.pop("format") != FORMAT:
            raise ValueError("another format")
        made = {"tables": Table, "pictures": Picture, "verdicts": Verdict}
        return Result(
            **{key: [made[key](**one) for one in value] if key in made else value for key, value in raw.items()}
        )
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: no result of the bench ({error}); run its subcommand again") from error


def load_all(cache: Path) -> list[Result]:
    """All results of a cache, by name."""
    found = sorted((cache / "results").glob("*/result.json"))
    return [load(path.parent) for path in found]


def show(result: Result) -> str:
    """The verdicts, what is missing and how to run in full, as text; tables are printed by `store.show_table`."""
    words = {True: "holds", False: "DOES NOT HOLD", None: "cannot be told"}
    out = [f"{words[v.holds]}: {v.claim} ({v.source}): {v.figures}" for v in result.verdicts]
    out += [f"left out: {text}" for text in result.missing]
    if not result.complete:
        out.append("The time budget ended first; run the same command again to go on.")
    if result.reduced:
        out.append(f"Reduced size. In full: {result.full}")
    return "\n".join(out)
