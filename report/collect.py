# SPDX-License-Identifier: GPL-3.0-or-later
"""The results of a cache that can be shown, and in words what is wrong with the others."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from pathlib import Path

from bench import result as bench_result
from bench.result import Picture, Result, Table, Verdict

HOW_TO_RUN = "run ./scripts/bench first (./scripts/bench --help lists its subcommands)"
ORDER = ("peers", "convergence", "filter", "classes", "tables", "rays", "nodes", "memory")
"""Of the subcommands in the page; others follow by name."""
DEMO = "demo"
"""The name of the result that holds the scenes' demo pictures."""


@dataclass
class Collected:
    """Results in the page's order, each with its folder; `problems`: one sentence each."""

    results: list[Result] = field(default_factory=list)
    folders: dict[str, Path] = field(default_factory=dict)
    problems: list[str] = field(default_factory=list)


def _fits(one: object, kind: type) -> bool:
    """Whether a value read from JSON has the types that its dataclass promises, as far as the page relies on them."""
    simple = {"str": str, "bool": bool, "list[str]": list, "dict": dict, "dict[str, str]": dict, "list[dict]": list}
    for item in fields(kind):
        value, wanted = getattr(one, item.name), simple.get(item.type)
        if wanted and not isinstance(value, wanted):
            return False
        if item.type == "list[str]" and not all(isinstance(v, str) for v in value):
            return False
        if item.type == "float | None" and not (value is None or type(value) in (int, float)):
            return False
        if item.type == "bool | None" and value not in (None, True, False):
            return False
    return True


def _table_fits(table: Table) -> bool:
    """As `_fits`, and each column has a title and a format, each row is an object."""
    columns = isinstance(table.columns, dict) and all(
        isinstance(c, list) and len(c) == 2 and all(isinstance(text, str) for text in c) for c in table.columns.values()
    )
    return columns and _fits(table, Table) and all(isinstance(row, dict) for row in table.rows)


def read(folder: Path) -> Result:
    """A folder's result, its types checked. ValueError says in words what is wrong."""
    if not (folder / "result.json").exists():
        raise ValueError(f"{folder.name}: no result.json; the run was stopped before its end: run its subcommand again")
    try:
        found = bench_result.load(folder)
    except AttributeError as error:
        raise ValueError(f"{folder / 'result.json'}: no result of the bench ({error})") from error
    sound = (
        _fits(found, Result)
        and all(map(_table_fits, found.tables))
        and all(_fits(p, Picture) for p in found.pictures)
        and all(_fits(v, Verdict) for v in found.verdicts)
    )
    if not sound:
        raise ValueError(f"{folder / 'result.json'}: values of wrong types; run its subcommand again")
    return found


def _mixed(results: list[Result], what: str, value) -> list[str]:
    """A sentence if the results do not agree on `value(result)`."""
    by_value: dict[str, list[str]] = {}
    for one in results:
        by_value.setdefault(value(one) or "unknown", []).append(one.name)
    if len(by_value) < 2:
        return []
    parts = "; ".join(f"{key}: {', '.join(names)}" for key, names in by_value.items())
    return [f"The results are of different {what}. {parts}"]


def machine_text(machine: dict) -> str:
    """One line: processor, cores, memory, system."""
    parts = [str(machine.get("cpu", ""))]
    parts += [f"{machine['cores']} cores"] if machine.get("cores") else []
    parts += [f"{machine['memory_gib']} GiB"] if machine.get("memory_gib") else []
    return ", ".join([part for part in parts if part] + [str(machine["system"])] * bool(machine.get("system")))


def collect(cache: Path) -> Collected:
    """Everything under `<cache>/results`. FileNotFoundError, with how to run the bench, if there is nothing."""
    folders = sorted(p for p in (cache / "results").glob("*") if p.is_dir())
    if not folders:
        raise FileNotFoundError(f"no results in {cache / 'results'}: {HOW_TO_RUN}")
    out = Collected()
    for folder in folders:
        try:
            one = read(folder)
        except ValueError as error:
            out.problems.append(str(error))
            continue
        one.name = folder.name
        out.results.append(one)
        out.folders[folder.name] = folder
    rank = {name: index for index, name in enumerate(ORDER)}
    out.results.sort(key=lambda r: (rank.get(r.name, len(rank)), r.name))
    out.problems += _mixed(out.results, "commits", lambda r: r.commit)
    out.problems += _mixed(out.results, "machines", lambda r: machine_text(r.machine))
    stopped = [r.name for r in out.results if not r.complete]
    if stopped:
        out.problems.append(f"Incomplete, the time budget ended first: {', '.join(stopped)}; run it again to go on")
    dirty = [r.name for r in out.results if r.commit.endswith("+")]
    if dirty:
        out.problems.append(f"Files differed from the commit when these ran: {', '.join(dirty)}")
    return out
