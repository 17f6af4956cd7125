# SPDX-License-Identifier: GPL-3.0-or-later
"""The engines, as plug-ins: each turns a job into a command and reads what it left behind.

A new engine is one subclass and one line in `available()`.
"""

from __future__ import annotations

import json
import os
import shutil
from dataclasses import asdict, dataclass
from pathlib import Path

from . import programs

ROOT = Path(__file__).resolve().parents[1]
HERE = Path(__file__).resolve().parent
BUILT = ROOT / "build" / "release"


@dataclass(frozen=True)
class Job:
    """One render. `width` 0 keeps the file's resolution; an empty `out` writes no picture."""

    blend: str
    out: str
    samples: int
    seed: int
    threads: int = 2
    bounces: int = 24
    caustics: bool = False
    width: int = 0
    only_load: bool = False
    settings: tuple[str, ...] = ()
    """name=value of the engine's own settings; the command line program alone takes them."""


class Engine:
    """Renders jobs. `key` names it in results."""

    key = ""
    title = ""

    def command(self, job: Job, folder: Path) -> tuple[list[str], dict[str, str]]:
        """The command line and extra environment; `folder` is empty and lives as long as the run."""
        raise NotImplementedError

    def extra(self, job: Job, folder: Path) -> dict:
        """What the engine itself reported, for the results."""
        return {}

    def problem(self) -> str:
        """Why it cannot run here; empty when it can."""
        return ""

    def stamp(self) -> str:
        """A digest of the engine's program: results of another one are not reused."""
        return ""


class InBlender(Engine):
    """An engine inside Debian's Blender or a bpy wheel."""

    def __init__(self, key: str, title: str, engine: str, python: str = "", addon: str = ""):
        self.key, self.title, self.engine, self.python, self.addon = key, title, engine, python, addon

    def problem(self) -> str:
        if self.python:
            return "" if Path(self.python).exists() else f"{self.python} is not there"
        if not shutil.which("blender"):
            return "blender is not on PATH"
        if self.engine == "CARDIOID" and not list(Path(self.addon, "cardioid").glob("_core*.so")):
            return f"no compiled engine in {self.addon}/cardioid"
        return ""

    def command(self, job: Job, folder: Path) -> tuple[list[str], dict[str, str]]:
        task = folder / "job.json"
        task.write_text(json.dumps(asdict(job) | {"engine": self.engine, "addon": self.addon}))
        script = str(HERE / "render_blend.py")
        if self.python:
            command = [self.python, script, "--", str(task)]
        else:
            command = [
                "blender",
                "-b",
                "--factory-startup",
                "-noaudio",
                "--python-exit-code",
                "1",
                "-P",
                script,
                "--",
                str(task),
            ]
        if self.engine == "CARDIOID":
            command += ["--cardioid-stats", str(folder / "stats.json")]
        return command, {
            f"BLENDER_USER_{part}": str(folder) for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")
        }

    def stamp(self) -> str:
        addon = self.addon if self.engine == "CARDIOID" else ""
        return programs.digest(self.python or "blender", addon)

    def extra(self, job: Job, folder: Path) -> dict:
        stats = folder / "stats.json"
        return {"stats": json.loads(stats.read_text())} if stats.exists() else {}


class CommandLine(Engine):
    """`cardioid-render` on the scene file that the add-on exported; that export is made once and not counted."""

    key, title = "cardioid-cli", "Cardioid, command line"

    def __init__(self, program: str, addon: str, cache: Path):
        self.program, self.addon, self.cache = program, addon, cache

    def problem(self) -> str:
        if not Path(self.program).exists():
            return f"{self.program} is not there"
        return InBlender("", "", "CARDIOID", "", self.addon).problem()

    def stamp(self) -> str:
        return programs.of_file(Path(self.program))

    def scene_file(self, job: Job) -> Path:
        """The exported scene of a job's file and settings, made on first use."""
        blend = Path(job.blend)
        stamp = f"{blend.stat().st_mtime_ns:x}-{job.width}-{job.bounces}-{int(job.caustics)}"
        path = self.cache / "exports" / f"{blend.stem}-{stamp}.cardioid"
        if not path.exists():
            from . import measure

            path.parent.mkdir(parents=True, exist_ok=True)
            task, part = path.with_suffix(".json"), path.with_suffix(".part")
            task.write_text(json.dumps(asdict(job) | {"engine": "CARDIOID", "addon": self.addon, "export": str(part)}))
            script = str(HERE / "render_blend.py")
            cost = measure.run(
                ["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", script, "--", str(task)]
            )
            if cost.code or not part.exists():
                raise RuntimeError("the export failed:\n" + "\n".join(text for _, text in cost.lines[-15:]))
            part.replace(path)
        return path

    def command(self, job: Job, folder: Path) -> tuple[list[str], dict[str, str]]:
        command = [self.program, str(self.scene_file(job)), "-o", job.out or str(folder / "out.exr"), "-q"]
        command += ["--samples", str(job.samples), "--seed", str(job.seed), "--threads", str(job.threads)]
        for setting in job.settings:
            command += ["--set", setting]
        return [*command, "--stats", str(folder / "stats.json")], {}

    def extra(self, job: Job, folder: Path) -> dict:
        stats = folder / "stats.json"
        return {"stats": {"renders": [{"engine": json.loads(stats.read_text())}]}} if stats.exists() else {}


def available(cache: Path) -> dict[str, Engine]:
    """All engines by key. CARDIOID_ADDON: the folder that holds `cardioid`; CARDIOID_RENDER: the command line
    program; CARDIOID_BPY_PYTHONS: Pythons with a bpy wheel, colon-separated."""
    addon = os.environ.get("CARDIOID_ADDON", str(ROOT / "addon"))
    program = os.environ.get("CARDIOID_RENDER", str(BUILT / "engine_cpp" / "apps" / "cli" / "cardioid-render"))
    found: list[Engine] = [
        InBlender("cycles", "Cycles, Blender 3.4", "CYCLES"),
        InBlender("cardioid", "Cardioid, Blender 3.4", "CARDIOID", addon=addon),
        CommandLine(program, addon, cache),
    ]
    given = os.environ.get("CARDIOID_BPY_PYTHONS")
    pythons = given.split(":") if given else [str(ROOT / ".venv" / n / "bin" / "python") for n in ("bpy45", "bpy50")]
    for python in filter(None, pythons):
        name = Path(python).parents[1].name.removeprefix("venv-").removeprefix("bpy")
        found.append(InBlender(f"cycles{name}", f"Cycles, bpy {name}", "CYCLES", python))
        found.append(InBlender(f"cardioid{name}", f"Cardioid, bpy {name}", "CARDIOID", python, addon))
    return {engine.key: engine for engine in found}
