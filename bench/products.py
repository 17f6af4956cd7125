# SPDX-License-Identifier: GPL-3.0-or-later
"""Renderers that are compared on the thesis's scenes, as plug-ins: each renders a scene for some CPU seconds.

The CPU seconds of all are counted alike, from outside: the whole process less a run of the same program with one sample
and without preparation for caustics (start-up, scene, ray tree). What runs inside the others is in `bench/rivals`.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from . import measure, programs, runs, store
from .engines import Engine, Job
from .peer_scenes import PeerScene

ROOT = Path(__file__).resolve().parents[1]
RIVALS = ROOT / "bench" / "rivals"
PROBE_SAMPLES = 33


@dataclass
class Setup:
    records: store.Store
    cache: Path
    engine: Engine
    threads: int


class Product:
    """Renders a scene. `words`: its settings; `filtered`: its picture went through a noise filter; `ours`: it is what
    the others are compared with."""

    def __init__(self, key: str, title: str, words: str, filtered: bool = False, ours: bool = False):
        self.key, self.title, self.words, self.filtered, self.ours = key, title, words, filtered, ours

    def problem(self) -> str:
        """Why it cannot run here; empty when it can."""
        return ""

    def suits(self, scene: PeerScene) -> bool:
        """Whether its settings differ from another product's on this scene."""
        return True

    def render(self, setup: Setup, scene: PeerScene, seed: int, mark: float) -> dict | None:
        """A record with `cpu`, `cpu_process`, `samples`, `version` and `path`; None: out of time. RuntimeError when it
        failed, in one line."""
        raise NotImplementedError


class Ours(Product):
    """Cardioid's command line program with its default settings but for those given."""

    def __init__(self, key: str, title: str, words: str, settings: tuple[str, ...], filtered: bool = False):
        super().__init__(key, title, words, filtered, ours=True)
        self.settings = settings

    def render(self, setup: Setup, scene: PeerScene, seed: int, mark: float) -> dict | None:
        job = Job(str(scene.blend), "", 1, seed, setup.threads, caustics=True, settings=self.settings)
        plain = replace(job, seed=0, settings=runs.METHODS["PTPPM"])
        start = runs.measured(setup.records, setup.cache, setup.engine, plain, "start")
        pace = start and runs.pace(setup.records, setup.cache, setup.engine, job)
        if pace is None:
            return None
        job = replace(job, samples=pace.samples(mark + start["cpu"]))
        run = runs.measured(setup.records, setup.cache, setup.engine, job)
        if run is None:
            return None
        found = {"samples": job.samples, "version": setup.engine.stamp(), "path": run["path"]}
        return found | {"cpu": run["cpu"] - start["cpu"], "cpu_process": run["cpu"]}


class Rival(Product):
    """A program of `bench/rivals` in a mode, under a Python or Blender. `start`: the mode whose run with one sample
    counts as start-up."""

    def __init__(self, key: str, title: str, words: str, host: str, mode: str, start: str = "path", **more):
        super().__init__(key, title, words, **more)
        self.host, self.mode, self.start = host, mode, start

    script = ""
    uses: tuple[str, ...] = ("runner.py", "scenes.py", "shapes.py")

    def command(self, scene: PeerScene, words: list[str]) -> list[str]:
        return [self.host, str(RIVALS / self.script), "--scene", scene.name, *words]

    def environment(self) -> dict[str, str]:
        return {}

    def stamp(self) -> str:
        """Changes with the program and with what runs inside it."""
        return "-".join(programs.of_file(RIVALS / name) for name in (self.script, *self.uses))

    def measured(self, setup: Setup, scene: PeerScene, mode: str, amount: list[str], seed: int) -> dict | None:
        """One process's record, made now if it is not there. None: out of time."""
        key = ("rival", f"{self.script} {self.host} {mode}", self.stamp(), scene.name, setup.threads, *amount, seed)
        host = "-".join(Path(self.host).parts[-3::2])
        name = f"{scene.name}-{host}-{Path(self.script).stem}-{mode}{''.join(amount)}-{seed}"
        path = setup.cache / "rivals" / f"{name}.exr"
        found = setup.records.get(*key)
        if found and path.exists():
            return found | {"path": str(path)}
        if setup.records.out_of_time(key):
            return None
        path.parent.mkdir(parents=True, exist_ok=True)
        words = ["--mode", mode, *amount, "--seed", str(seed), "--threads", str(setup.threads), "--out", str(path)]
        cost = measure.run(self.command(scene, words), env={"PYTHONDONTWRITEBYTECODE": "1", **self.environment()})
        return setup.records.add(key, result_of(cost, path)) | {"path": str(path)}

    def once(self, setup: Setup, scene: PeerScene) -> dict | None:
        """Start-up: one sample."""
        return self.measured(setup, scene, self.start, ["--samples", "1"], 1)

    def amount(self, setup: Setup, scene: PeerScene, start: dict, mark: float) -> list[str] | None:
        """How much to render, as options. None: out of time."""
        return ["--cpu", f"{mark:g}"]

    def render(self, setup: Setup, scene: PeerScene, seed: int, mark: float) -> dict | None:
        start = self.once(setup, scene)
        amount = start and self.amount(setup, scene, start, mark)
        run = amount and self.measured(setup, scene, self.mode, amount, seed)
        if not run:
            return None
        found = {name: run[name] for name in ("samples", "version", "path")}
        return found | {"cpu": run["cpu_process"] - start["cpu_process"], "cpu_process": run["cpu_process"]}


def result_of(cost: measure.Cost, path: Path) -> dict:
    """A process's record from what it printed. RuntimeError, one line, without a picture."""
    found = [json.loads(text[7:]) for _, text in cost.lines if text.startswith("RESULT ")]
    if not found or not path.exists():
        if store.disk_is_full(path.parent):
            raise store.DiskFull.of("No space left on device", path)
        said = [text.strip() for _, text in cost.lines if text.strip() and not text.startswith("Blender quit")][-2:]
        raise RuntimeError(f"ended with exit code {cost.code}: {' | '.join(said) or 'nothing was printed'}")
    return found[-1] | {"cpu_process": cost.cpu, "wall_process": cost.wall, "load": cost.load}


class Cycles(Rival):
    """Renders by samples: their number comes from two short runs of the same mode."""

    script = "render_cycles.py"

    def problem(self) -> str:
        if not shutil.which(self.host):
            return f"{self.host} is not there (scripts/setup peers)"
        return "" if programs.version(self.host) else f"{self.host} does not start"

    def suits(self, scene: PeerScene) -> bool:
        return self.mode != "shadow" or scene.has_glass()

    def stamp(self) -> str:
        return f"{super().stamp()}-{programs.digest(self.host)}"

    def command(self, scene: PeerScene, words: list[str]) -> list[str]:
        words = ["--", "--blend", str(scene.blend), *words]
        script = str(RIVALS / self.script)
        if Path(self.host).name.startswith("python"):
            return [self.host, script, *words]
        return [self.host, "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "-P", script, *words]

    def amount(self, setup: Setup, scene: PeerScene, start: dict, mark: float) -> list[str] | None:
        one, many = (
            self.measured(setup, scene, self.mode, ["--samples", str(samples)], 1) for samples in (1, PROBE_SAMPLES)
        )
        if one is None or many is None:
            return None
        each = max((many["cpu_process"] - one["cpu_process"]) / (PROBE_SAMPLES - 1), 1e-4)
        once = one["cpu_process"] - start["cpu_process"]
        return ["--samples", str(max(1, round((mark - once) / each)))]


class Package(Rival):
    """A renderer that is a Python package."""

    package = ""

    def problem(self) -> str:
        return unimportable(self.host, self.package)


class LuxCore(Package):
    script, package = "render_luxcore.py", "pyluxcore"


class Mitsuba(Package):
    script, package = "render_mitsuba.py", "mitsuba"
    uses = (*Rival.uses, "mitsuba_scene.py", "split.py")


@cache
def unimportable(python: str, package: str) -> str:
    """Why a package cannot be used; empty when it can."""
    if not Path(python).exists():
        return f"{python} is not there (scripts/setup peers)"
    try:
        done = subprocess.run([python, "-c", f"import numpy, {package}"], capture_output=True, text=True, check=False)
    except OSError as error:
        return f"{python} does not start: {error.strerror}"
    said = done.stderr.strip().splitlines()
    return "" if done.returncode == 0 else f"{package} does not import: {said[-1] if said else done.returncode}"


EQUAL = "24 bounces of every kind, nothing clamped"
CYCLES = {
    "default": (
        "defaults",
        "as in a new file: 12 bounces, 4 of them diffuse or glossy, indirect light clamped at 10, Filter Glossy 1, "
        "caustics on",
    ),
    "path": ("full depth", f"caustics on, {EQUAL}, Filter Glossy 0"),
    "shadow": (
        "shadow caustics",
        "as its manual has it for caustics of glass: manifold next-event estimation, with lamp, casters and receivers "
        f"set; {EQUAL}",
    ),
    "guided": ("path guiding", f"path guiding with its default training; caustics on, {EQUAL}"),
    "denoised": ("OpenImageDenoise", f"full depth, then OpenImageDenoise with albedo and normals; {EQUAL}"),
}
"""Mode → what it is called, and its settings in words."""


def cycles(tag: str, host: str, name: str) -> list[Product]:
    """Cycles of one Blender in its modes."""
    out: list[Product] = []
    for mode, (called, words) in CYCLES.items():
        key = f"cycles{tag}" + (f"_{mode}" if mode != "path" else "")
        words = f"{words}; a fixed number of samples, no adaptive sampling"
        out.append(Cycles(key, f"Cycles {name}, {called}", words, host, mode, filtered=mode == "denoised"))
    return out


def packages(python: str) -> list[Product]:
    cached = (
        "path tracing with PhotonGI's caustic cache as its manual and add-on have it: 100 000 photons, depth 12, "
        "renewed every 8 samples, radius × 0.96 each time to 3 mm; in its favour at most 1 million traced (not 20), "
        f"first radius 2 cm (not 7.5); {EQUAL}"
    )
    bidir = "bidirectional; paths to 16, light paths to 12 bounces, Russian roulette off (it brightens by a tenth)"
    sampled = (
        f"path tracer, independent samples, {EQUAL}; its stratified samplers are of no use here: passes with other "
        "seeds share most of their error"
    )
    particles = (
        "particle tracer, which its manual has for scenes whose light the camera sees directly, so for caustics; what "
        f"is seen in mirrors and through glass is missing; {EQUAL}"
    )
    split = "the method of our references on Mitsuba's kernels, no part of Mitsuba: what the thesis's split can reach"
    return [
        LuxCore("luxcore_default", "LuxCore, defaults", "path tracer with nothing set", python, "default"),
        LuxCore("luxcore", "LuxCore, caustic cache", cached, python, "cache"),
        LuxCore("luxcore_bidir", "LuxCore, bidirectional", bidir, python, "bidir"),
        Mitsuba("mitsuba_default", "Mitsuba, defaults", "path tracer with nothing set", python, "default"),
        Mitsuba("mitsuba", "Mitsuba, path tracer", sampled, python, "path"),
        Mitsuba("mitsuba_particles", "Mitsuba, particle tracer", particles, python, "particles"),
        Mitsuba("mitsuba_split", "the split on Mitsuba", split, python, "split"),
    ]


def available() -> dict[str, Product]:
    """All products by key. CARDIOID_PEERS_PYTHON: a Python with mitsuba and pyluxcore; CARDIOID_BPY_PYTHONS: those with
    bpy wheels, colon-separated, in folders named bpy45, bpy50 or alike."""
    python = os.environ.get("CARDIOID_PEERS_PYTHON", str(ROOT / ".venv" / "peers" / "bin" / "python"))
    default = f"the add-on's defaults: hybrid integrator (PTPPM), {EQUAL}"
    found: list[Product] = [
        Ours("cardioid", "Cardioid", default, runs.METHODS["PTPPM"]),
        Ours(
            "cardioid_filtered",
            "Cardioid, filtered",
            f"{default}, then the cluster filter with its defaults",
            (*runs.METHODS["PTPPM"], "use_filter=true"),
            filtered=True,
        ),
        *cycles("34", "blender", "3.4"),
    ]
    given = os.environ.get("CARDIOID_BPY_PYTHONS")
    wheels = given.split(":") if given else [str(ROOT / ".venv" / f"bpy{tag}" / "bin" / "python") for tag in (45, 50)]
    for wheel in filter(None, wheels):
        tag = "".join(filter(str.isdigit, Path(wheel).parents[1].name)) or "wheel"
        found += cycles(tag, wheel, ".".join(tag))
    found += packages(python)
    return {product.key: product for product in found}
