# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts Blenders on batches of cases. A batch that fails is halved until the case that breaks it stands alone."""

from __future__ import annotations

import atexit
import fnmatch
import functools
import json
import os
import shutil
import signal
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import hosts
import numpy as np

HERE = Path(__file__).resolve().parent
SECONDS = 900.0
"""A Blender that takes longer is stopped and its batch has failed."""
NOISY_SAMPLES = 128
SAMPLES = {"CYCLES": 1, "CARDIOID": 16}
"""Cycles' first sample is the pixel's centre; Cardioid's many lie around it, within stage.FILTER, and are averaged."""
WARNINGS = ("Material “", "Object “")


@dataclass
class Rendered:
    """What came of a group of cases: pictures (renders, h, w, 3), reasons for skipping, problems, Cardioid's words."""

    pictures: dict[str, np.ndarray] = field(default_factory=dict)
    skipped: dict[str, str] = field(default_factory=dict)
    problems: dict[str, str] = field(default_factory=dict)
    warnings: dict[str, str] = field(default_factory=dict)


def command(host: hosts.Host, argument: str) -> list[str]:
    """The host's Blender with this folder's worker."""
    own, theirs = str(HERE / "worker.py"), str(hosts.HERE / "worker.py")
    return [own if part == theirs else part for part in host.command] + [argument]


@functools.cache
def addon() -> Path:
    """A copy of the add-on, so that a build meanwhile does not change the engine between two Blenders.

    CARDIOID_ADDON names another folder to take it from.
    """
    source = os.environ.get("CARDIOID_ADDON", HERE.parents[1] / "addon")
    folder = Path(tempfile.mkdtemp(prefix="compare-nodes-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    shutil.copytree(source, folder / "addon", ignore=shutil.ignore_patterns("__pycache__"))
    return folder / "addon"


def start(host: hosts.Host, argument: str, folder: str) -> tuple[int, str]:
    """Runs a Blender with preferences of its own; its exit code and what it printed."""
    environment = {f"BLENDER_USER_{part}": folder for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")}
    environment["CARDIOID_ADDON"] = str(addon())
    log = Path(folder) / "log"
    with log.open("w") as out:
        process = subprocess.Popen(
            command(host, argument), env={**os.environ, **environment}, stdin=subprocess.DEVNULL, stdout=out,
            stderr=subprocess.STDOUT, start_new_session=True,
        )  # fmt: skip
        try:
            code = process.wait(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            code = process.wait()
    return code, log.read_text(errors="replace")


def listing(host: hosts.Host) -> dict[str, dict]:
    """All cases: name to the node it uses, its bounds and its group."""
    with tempfile.TemporaryDirectory() as folder:
        _, text = start(host, "--list", folder)
    for found in text.splitlines():
        if found.startswith("CASES "):
            return json.loads(found[6:])
    raise SystemExit(f"{host.name} does not list its cases:\n{text[-3000:]}")


def chosen(listed: dict[str, dict], patterns: list[str]) -> list[str]:
    return [n for n in listed if not patterns or any(fnmatch.fnmatchcase(n, p) for p in patterns)]


def render(host: hosts.Host, engine: str, names: list[str], group: str) -> Rendered:
    result = Rendered()
    waiting = [names]
    while waiting:
        batch = waiting.pop()
        problem = render_batch(host, engine, batch, group == "noisy", result)
        if problem and len(batch) > 1:
            middle = len(batch) // 2
            waiting += [batch[middle:], batch[:middle]]
        elif problem:
            result.problems[batch[0]] = f"{engine}: {problem}"
    return result


def render_batch(host: hosts.Host, engine: str, names: list[str], noisy: bool, result: Rendered) -> str:
    """One Blender; fills `result`, or returns what went wrong."""
    with tempfile.TemporaryDirectory() as folder:
        task, out = Path(folder) / "task.json", Path(folder) / "out"
        task.write_text(json.dumps({
            "engine": engine, "cases": names, "samples": NOISY_SAMPLES if noisy else SAMPLES[engine], "out": str(out),
            "moved": engine == "CYCLES" and not noisy,
        }))  # fmt: skip
        code, text = start(host, str(task), folder)
        notes, pictures = Path(f"{out}.json"), Path(f"{out}.npz")
        told = json.loads(notes.read_text()) if notes.exists() else None
        if code != 0 or told is None or (told["built"] and not pictures.exists()):
            return f"exit code {code}: " + " | ".join(text.strip().splitlines()[-3:])[-300:]
        if told["built"]:
            with np.load(pictures) as file:
                pixels = file["pixels"]
            result.pictures.update({name: pixels[:, i] for i, name in enumerate(told["built"])})
        result.skipped.update(told["skipped"])
        result.problems.update(told["broken"])
        result.warnings.update(warnings_of(text, names))
    return ""


def warnings_of(text: str, names: list[str]) -> dict[str, str]:
    """What Cardioid says about the cases' materials and objects."""
    known, found = set(names), {}
    for entry in text.splitlines():
        for start_of in WARNINGS:
            _, there, rest = entry.partition(start_of)
            name, _, words = rest.partition("”")
            if there and name in known:
                found.setdefault(name, words.lstrip(": "))
    return found
