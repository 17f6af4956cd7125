# SPDX-License-Identifier: GPL-3.0-or-later
"""Renderers that are compared on the peers' scenes, as plug-ins: each renders a scene up to CPU-second marks.

The foreign ones are started through the scripts beside the scenes (`run_cycles.py`, `run_lux.py`, `run_mitsuba.py`,
`reference.py`), which count the CPU seconds of the rendering alone; ours counts its whole process.
"""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import dataclass, replace
from pathlib import Path

from . import measure, runs
from .engines import Engine, Job
from .peer_scenes import PeerScene
from .store import Store

ROOT = Path(__file__).resolve().parents[1]


@dataclass
class Setup:
    records: Store
    cache: Path
    peers: Path
    engine: Engine
    threads: int
    bounces: int = 24


class Product:
    """Renders a scene; `rival` says whether ours must beat it."""

    rival = True

    def __init__(self, key: str):
        self.key = key

    def problem(self) -> str:
        """Why it cannot run here; empty when it can."""
        return ""

    def render(self, setup: Setup, scene: PeerScene, seed: int, mark: float) -> dict | None:
        """A record with `cpu`, `samples` and `path`; None: out of time. RuntimeError when it failed."""
        raise NotImplementedError


class Ours(Product):
    """Cardioid's command line program with default settings and one method."""

    rival = False

    def __init__(self, key: str, settings: tuple[str, ...]):
        super().__init__(key)
        self.settings = settings

    def render(self, setup: Setup, scene: PeerScene, seed: int, mark: float) -> dict | None:
        job = Job(str(scene.blend), "", 1, seed, setup.threads, setup.bounces, caustics=True, settings=self.settings)
        pace = runs.pace(setup.records, setup.cache, setup.engine, job)
        if pace is None:
            return None
        job = replace(job, samples=pace.samples(mark))
        run = runs.measured(setup.records, setup.cache, setup.engine, job)
        return run and {"cpu": run["cpu"], "samples": job.samples, "path": run["path"]}


class Script(Product):
    """One of the peers' scripts under a program, with options of its own."""

    def __init__(self, key: str, program: str, script: str, options: tuple[str, ...] = (), suffix: str = ".exr"):
        super().__init__(key)
        self.program, self.script, self.options, self.suffix = program, script, options, suffix

    def problem(self) -> str:
        return "" if shutil.which(self.program) else f"{self.program} is not there"

    def command(self, setup: Setup, scene: PeerScene, seed: int, mark: float, stem: Path) -> list[str]:
        """The command line; it leaves `<stem>_<mark><suffix>`."""
        rest = ["--scene", scene.name, "--marks", f"{mark:g}", "--out", str(stem), "--seed", str(seed)]
        return [self.program, str(setup.peers / self.script), *self.options, *rest, *limits(setup)]

    def picture(self, scene: PeerScene, mark: float, stem: Path) -> Path:
        return Path(f"{stem}_{mark:g}{self.suffix}")

    def render(self, setup: Setup, scene: PeerScene, seed: int, mark: float) -> dict | None:
        key = ("peer", self.key, scene.name, setup.threads, setup.bounces, seed, mark)
        stem = setup.cache / "peers" / f"{scene.name}-{self.key}-{seed}"
        path = self.picture(scene, mark, stem)
        done = setup.records.get(*key)
        if done is None or not path.exists():
            if setup.records.out_of_time():
                return None
            path.parent.mkdir(parents=True, exist_ok=True)
            command = self.command(setup, scene, seed, mark, stem)
            # The peers' folder may be read-only, and is not ours to write into.
            cost = measure.run(command, cwd=setup.peers, env={"PYTHONDONTWRITEBYTECODE": "1"})
            done = setup.records.add(key, self.result(cost, path))
        return {"cpu": done["cpu"], "samples": done.get("spp", 0), "path": str(path)}

    def result(self, cost: measure.Cost, path: Path) -> dict:
        found = [json.loads(text[7:]) for _, text in cost.lines if text.startswith("RESULT ")]
        if not found or not path.exists():
            said = [text for _, text in cost.lines if text.strip()][-3:]
            raise RuntimeError(f"{self.key} failed with exit code {cost.code}: {' | '.join(said)}")
        return found[-1] | {"cpu_process": cost.cpu, "load": cost.load}


class Cycles(Script):
    """Its samples are calibrated by the script, so that a mark is met within about 15 %."""

    def command(self, setup, scene, seed, mark, stem) -> list[str]:
        script, path = str(setup.peers / self.script), self.picture(scene, mark, stem)
        rest = [*self.options, "--out", str(path), "--cpu", f"{mark:g}", "--seed", str(seed), *limits(setup)]
        if Path(self.program).name.startswith("python"):
            return [self.program, script, "--blend", str(scene.blend), *rest]
        return [self.program, "-b", str(scene.blend), "-P", script, "--", *rest]


class Split(Script):
    """The thesis's split on Mitsuba's kernels, as the references were made: a goal, no product."""

    rival = False

    def command(self, setup, scene, seed, mark, stem) -> list[str]:
        folder = self.picture(scene, mark, stem).parent
        folder.mkdir(parents=True, exist_ok=True)
        rest = ["--scene", scene.name, "--cpu", f"{mark:g}", "--out", str(folder), "--seed", str(100 + seed)]
        return [self.program, str(setup.peers / self.script), *self.options, *rest, *limits(setup)]

    def picture(self, scene, mark, stem) -> Path:
        return Path(f"{stem}_{mark:g}") / f"{scene.name}_ref.exr"

    def result(self, cost: measure.Cost, path: Path) -> dict:
        if cost.code or not path.exists():
            return super().result(cost, path)
        return {"cpu": cost.cpu, "cpu_process": cost.cpu, "load": cost.load}


def limits(setup: Setup) -> list[str]:
    return ["--threads", str(setup.threads), "--bounces", str(setup.bounces)]


def available() -> dict[str, Product]:
    """All products by key. CARDIOID_PEERS_PYTHON: a Python with mitsuba and pyluxcore; CARDIOID_BPY_PYTHONS: with bpy
    wheels, colon-separated, of which the last is taken."""
    python = os.environ.get("CARDIOID_PEERS_PYTHON", str(ROOT / ".venv" / "peers" / "bin" / "python"))
    wheel = os.environ.get("CARDIOID_BPY_PYTHONS", str(ROOT / ".venv" / "bpy50" / "bin" / "python")).split(":")[-1]
    found: list[Product] = [
        Ours("cardioid", runs.METHODS["PTPPM"]),
        Cycles("cycles34", "blender", "run_cycles.py"),
        Cycles("cycles5", wheel, "run_cycles.py"),
        Script("lux_pgi", python, "run_lux.py", ("--mode", "pgi"), ".npy"),
        Script("mi_path", python, "run_mitsuba.py", ("--mode", "path")),
        Split("mi_split", python, "reference.py"),
    ]
    return {product.key: product for product in found}
