# SPDX-License-Identifier: GPL-3.0-or-later
"""The Blenders that render the cases, the processes that do it, and what came of each picture."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CACHE = ROOT / "build" / "render-cache"
SILENCE = 60.0
"""Seconds without a finished picture after which a process is stopped and its case has failed."""

Job = tuple[str, str, int]
"""Case, role ("ours" or "reference"), seed."""


@dataclass
class Host:
    """A Blender: Debian's program, or a Python with the bpy wheel."""

    name: str
    command: list[str]

    def listing(self) -> dict:
        done = subprocess.run(
            [*self.command, "--list"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120
        )
        for text in done.stdout.splitlines():
            if text.startswith("CASES "):
                return json.loads(text[6:])
        raise SystemExit(f"{self.name} does not list its cases:\n{done.stdout[-3000:]}")


def find() -> tuple[list[Host], list[str]]:
    """The hosts on this machine, and the names of those that are missing."""
    found, missing = [], []
    if shutil.which("blender"):
        arguments = ["-b", "--factory-startup", "--python-exit-code", "1", "-P", str(HERE / "worker.py"), "--"]
        found.append(Host("3.4", ["blender", *arguments]))
    else:
        missing.append("3.4")
    given = os.environ.get("CARDIOID_BPY_PYTHONS")
    pythons = (
        given.split(":") if given else [str(ROOT / ".venv" / name / "bin" / "python") for name in ("bpy45", "bpy50")]
    )
    for python in filter(None, pythons):
        name = Path(python).parents[1].name.removeprefix("venv-")
        if Path(python).exists():
            found.append(Host(name, [python, str(HERE / "worker.py"), "--"]))
        else:
            missing.append(name)
    return found, missing


@dataclass
class Outcome:
    """The pictures of a host as they come in. Cycles' are kept between runs, by the case's fingerprint."""

    host: Host
    listing: dict
    engines: dict[str, str]
    cpu: dict[tuple[str, str], list[float]] = field(default_factory=dict)
    problems: dict[tuple[str, str], str] = field(default_factory=dict)
    folder: tempfile.TemporaryDirectory = field(default_factory=tempfile.TemporaryDirectory)
    rendered: dict[tuple[str, str], list[Path]] = field(default_factory=dict)

    def path(self, job: Job) -> Path:
        case, role, seed = job
        if self.engines[role] != "CYCLES":
            return Path(self.folder.name) / f"{case}-{seed}.npy"
        version = self.listing["version"].split()[0]
        return CACHE / version / f"{case}-{self.listing['cases'][case]['hash']}-{seed}.npy"

    def load(self, case: str, role: str) -> np.ndarray:
        """(seeds, h, w, 4)."""
        return np.array([np.load(p) for p in self.rendered.get((case, role), [])])

    def render(self, jobs: list[Job]) -> None:
        """Renders what is missing, an engine's jobs in one process a core, and again without what crashed."""
        CACHE.joinpath(self.listing["version"].split()[0]).mkdir(parents=True, exist_ok=True)
        missing = [j for j in jobs if not self.path(j).exists()]
        lanes = os.cpu_count() or 1
        batches = []
        for role in self.engines:
            own = [j for j in missing if j[1] == role]
            batches += [(role, own[i::lanes]) for i in range(lanes) if own[i::lanes]]
        with ThreadPoolExecutor(lanes) as pool:
            list(pool.map(lambda batch: self.run_batch(*batch), batches))
        for job in jobs:
            if self.path(job).exists():
                self.rendered.setdefault(job[:2], []).append(self.path(job))

    def run_batch(self, role: str, jobs: list[Job]) -> None:
        while jobs:
            jobs = self.remaining(role, jobs, self.run_process(role, jobs))

    def run_process(self, role: str, jobs: list[Job]) -> list[dict]:
        """One Blender over the jobs; returns the lines of its progress file."""
        with tempfile.TemporaryDirectory() as folder:
            progress, task = Path(folder) / "progress", Path(folder) / "task.json"
            progress.touch()
            listed = [{"case": c, "seed": s, "out": str(self.path((c, r, s)))} for c, r, s in jobs]
            task.write_text(
                json.dumps({"engine": self.engines[role], "threads": 1, "progress": str(progress), "jobs": listed})
            )
            environment = {f"BLENDER_USER_{part}": folder for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")}
            log = Path(folder) / "log"
            with log.open("w") as out:
                process = subprocess.Popen(
                    [*self.host.command, str(task)],
                    env={**os.environ, **environment},
                    stdout=out,
                    stderr=subprocess.STDOUT,
                    stdin=subprocess.DEVNULL,
                    start_new_session=True,
                )
                watch(process, progress)
            lines = [json.loads(text) for text in progress.read_text().splitlines() if text.endswith("}")]
            if process.returncode != 0:
                tail = log.read_text(errors="replace").strip().splitlines()[-3:]
                lines.append({"exit": process.returncode, "tail": " | ".join(tail)})
            return lines

    def remaining(self, role: str, jobs: list[Job], lines: list[dict]) -> list[Job]:
        """Notes what happened; what is left to do after a crash leaves out the case that crashed."""
        finished, begun, bad, engine = set(), None, set(), self.engines[role]
        for entry in lines:
            if "start" in entry:
                begun = entry["start"]
            elif "done" in entry:
                finished.add((entry["done"], entry["seed"]))
                self.cpu.setdefault((entry["done"], role), []).append(entry["cpu"])
                begun = None
            elif "error" in entry:
                self.problems[entry["error"], role] = f"{engine}: {entry['text']}"
                bad.add(entry["error"])
                begun = None
            elif "exit" in entry:
                where = begun or jobs[0][0]
                how = "no picture in time" if entry["exit"] == -signal.SIGKILL else f"exit code {entry['exit']}"
                self.problems[where, role] = f"{engine}: {how}: {entry['tail'][-300:]}"
                bad.add(where)
        return [j for j in jobs if (j[0], j[2]) not in finished and j[0] not in bad]


def watch(process: subprocess.Popen, progress: Path) -> None:
    """Waits for a process; kills it with its children when its progress file stands still for too long."""
    size, since = -1, time.monotonic()
    while True:
        try:
            process.wait(timeout=1.0)
            return
        except subprocess.TimeoutExpired:
            now = progress.stat().st_size
            if now != size:
                size, since = now, time.monotonic()
            elif time.monotonic() - since > SILENCE:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                return
