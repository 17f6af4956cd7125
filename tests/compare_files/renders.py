# SPDX-License-Identifier: GPL-3.0-or-later
"""The processes that render a file, and Cycles' pictures kept between runs."""

from __future__ import annotations

import gzip
import hashlib
import json
import os
import re
import signal
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import hosts
import numpy as np

HERE = Path(__file__).resolve().parent
CACHE = hosts.ROOT / "build" / "file-cache"
SHARED = (HERE / "prepare.py", hosts.HERE / "kit.py", hosts.ROOT / "scenes" / "common.py")


@dataclass
class Rendered:
    """What one engine made of one file."""

    pictures: list[Path] = field(default_factory=list)
    facts: dict = field(default_factory=dict)
    messages: list[str] = field(default_factory=list)
    problem: str = ""
    seconds: float = 0.0
    """Of one picture, by the clock."""

    def load(self) -> np.ndarray:
        return np.array([np.load(p) for p in self.pictures])


def saved_by(blend: Path) -> tuple[int, int]:
    """The Blender that saved the file; (0, 0) where the header cannot be read without unpacking zstd."""
    head = blend.read_bytes()[:64]
    if head[:2] == b"\x1f\x8b":
        with gzip.open(blend) as packed:
            head = packed.read(64)
    found = re.match(rb"BLENDER.*?v0*(\d+)", head)
    return divmod(int(found.group(1)), 100) if found else (0, 0)


def command(host: hosts.Host) -> list[str]:
    worker = str(HERE / "worker.py")
    if host.command[0] == "blender":
        return ["blender", "-b", "--factory-startup", "-Y", "-noaudio", "-P", worker, "--"]
    return [host.command[0], worker, "--"]


def fingerprint(blend: Path, task: dict) -> str:
    parts = [blend.read_bytes(), *(p.read_bytes() for p in SHARED)]
    parts.append(json.dumps([task[k] for k in ("width", "samples", "blur")]).encode())
    return hashlib.sha256(b"".join(hashlib.sha256(p).digest() for p in parts)).hexdigest()[:16]


def render(host: hosts.Host, engine: str, task: dict, seeds: range, limit: float) -> Rendered:
    """Renders what is missing; the first seed is always there, so that the file's facts are known."""
    blend = Path(task["blend"])
    folder = CACHE / host.name if engine == "CYCLES" else CACHE / "ours"
    folder.mkdir(parents=True, exist_ok=True)
    stem = folder / f"{blend.stem}-{fingerprint(blend, task)}"
    jobs = [(seed, stem.with_name(f"{stem.name}-{seed}.npy")) for seed in seeds]
    if engine != "CYCLES":
        for _, out in jobs:
            out.unlink(missing_ok=True)
    missing = [[seed, str(out)] for seed, out in jobs if not out.exists()]
    found = Rendered()
    if missing:
        run(host, task | {"engine": engine, "jobs": missing}, limit, found)
    found.pictures = [out for _, out in jobs if out.exists()]
    if not found.problem and len(found.pictures) < len(jobs):
        found.problem = f"{engine}: {len(found.pictures)} of {len(jobs)} pictures"
    return found


def run(host: hosts.Host, task: dict, limit: float, found: Rendered) -> None:
    with tempfile.TemporaryDirectory() as folder:
        progress, job, log = Path(folder) / "progress", Path(folder) / "task.json", Path(folder) / "log"
        progress.touch()
        job.write_text(json.dumps(task | {"progress": str(progress)}))
        environment = {f"BLENDER_USER_{part}": folder for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")}
        with log.open("w") as out:
            process = subprocess.Popen(
                [*command(host), str(job)], env={**os.environ, **environment}, stdout=out, stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL, start_new_session=True,
            )
            try:
                process.wait(limit)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                found.problem = f"{task['engine']}: more than {limit:.0f} s"
        spent = [hear(found, json.loads(text)) for text in progress.read_text().splitlines() if text.endswith("}")]
        spent = [s for s in spent if s]
        found.seconds = sum(spent) / len(spent) if spent else 0.0
        if process.returncode != 0 and not found.problem:
            tail = " | ".join(log.read_text(errors="replace").strip().splitlines()[-3:])
            found.problem = f"{task['engine']}: exit code {process.returncode}: {tail[-300:]}"


def hear(found: Rendered, line: dict) -> float:
    """Notes a line of the progress file; returns a picture's seconds."""
    if "census" in line:
        found.facts = line
    elif "message" in line and line["message"] not in found.messages:
        found.messages.append(line["message"])
    elif "error" in line:
        found.problem = found.problem or line["error"]
    return line.get("seconds", 0.0)
