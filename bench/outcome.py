# SPDX-License-Identifier: GPL-3.0-or-later
"""The end of a subcommand: its Result is saved and printed."""

from __future__ import annotations

import os
import platform
from pathlib import Path

from . import programs, result, store


def place(out: result.Result, options) -> Path:
    """Where the plot of the same name as the result is to be written; its folder is there."""
    where = result.folder(options.cache, out.name)
    where.mkdir(parents=True, exist_ok=True)
    return where / f"{out.name}.png"


def finish(out: result.Result, options, records: store.Store) -> int:
    """Saves the result and prints all of it; the exit code."""
    out.complete = out.complete and not records.stopped
    out.versions |= versions()
    where = result.save(out, options.cache)
    for table in out.tables:
        print(f"\n{table.title}")
        titled = {title: form for title, form in table.columns.values()}
        rows = [
            {table.columns[key][0]: value for key, value in row.items() if key in table.columns} for row in table.rows
        ]
        print(store.show_table(rows, titled))
        if table.note:
            print(table.note)
    print()
    print(result.show(out))
    print(f"{os.path.relpath(where)}/result.json", flush=True)
    return 0 if any(table.rows for table in out.tables) else 1


def versions() -> dict[str, str]:
    """Of the programs that measure; engines say theirs in the settings."""
    import numpy

    return {"python": platform.python_version(), "numpy": numpy.__version__, "blender": blender_version()}


def blender_version() -> str:
    return (programs.version("blender").splitlines() or ["not there"])[0].removeprefix("Blender ")
