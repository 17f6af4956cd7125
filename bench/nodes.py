# SPDX-License-Identifier: GPL-3.0-or-later
"""Time of a shading point beside Cycles' over material graphs, and the time to compile 1000 materials."""

from __future__ import annotations

import json
import os
import statistics
import tempfile
from pathlib import Path

from . import charts, engines, measure, outcome, result, store
from . import options as common
from .progress import Progress

PLAIN = "plain diffuse"
OWN = (
    PLAIN,
    "noise, ramp, bump, Principled",
    "voronoi, mixed shaders",
    "wave and bricks, glossy",
    "clear glass, noise",
)
"""Graphs that the worker builds itself."""
MATERIALS = {
    "matlib_wood.blend": (
        "WO_basic_arbre",
        "WO_bark_cortex_G",
        "WO_Polished Walnut",
        "WO_Procedural_Smooth_G",
        "WO_flor_wood_G",
        "WO_wood_oak_planks_G",
        "WO_Wood_05",
        "WO_glossy_Uber_G",
    ),
    "clevr_mymetal.blend": ("Material",),
    "bevy_bakedgi_scene2.blend": ("Material.001",),
    "f9r_v2.blend": ("skin", "heatshield", "cast"),
    "pancake_mirror.blend": ("ROOM",),
}
"""Files of the folder of real files, and the materials that are measured."""
COLUMNS = {
    "material": ["material", ""],
    "cardioid_ns": ["Cardioid, ns a point", ".0f"],
    "cycles_ns": ["Cycles, ns a point", ".0f"],
    "ratio": ["ours over Cycles'", ".2f"],
    "low": ["at best", ".2f"],
    "high": ["at worst", ".2f"],
    "cpu": ["CPU s, both", ".1f"],
    "energy": ["energy over Cycles'", ".4f"],
}
COMPILED = {
    "count": ["materials", "d"],
    "seconds": ["compiled in, s", ".3f"],
    "each_ms": ["ms each", ".2f"],
    "export": ["exported in, s", ".2f"],
}
NOTE = (
    "Nanoseconds of CPU time (user and system) of a shading point beyond those of a plain diffuse plane: the slope "
    "between a short and a long render, medians of turns. Energy: the mean of our picture over Cycles'; the sky "
    "is constant, so it compares the materials' albedo. No error is measured (the tests' compare_nodes does that)."
)


def add_arguments(commands) -> None:
    parser = commands.add_parser("nodes", help="time of a shading point beside Cycles'; 1000 materials compiled")
    blends = os.environ.get("CARDIOID_BLENDS", str(engines.ROOT.parent / "shared" / "blends"))
    parser.add_argument("--blends", type=Path, default=blends, help="a folder of real files (%(default)s)")
    parser.add_argument("--samples", type=int, default=0, help="of the longer render, at 256×256 (16; 64 with --full)")
    parser.add_argument("--runs", type=int, default=0, help="turns of each engine and material (2; 5 with --full)")
    parser.add_argument("--compile", type=int, default=1000, help="materials to compile; 0: none (%(default)s)")


def settle(options) -> None:
    options.samples = options.samples or (64 if options.full else 16)
    options.runs = options.runs or (5 if options.full else 2)


def turn(options, **task) -> list[dict]:
    """What the worker says of one task: `material` (file and name, or the name of one of its own) or `compile`."""
    worker = Path(__file__).with_name("nodes_worker.py")
    addon = os.environ.get("CARDIOID_ADDON", str(engines.ROOT / "addon"))
    task |= {"addon": addon, "threads": options.threads, "samples": options.samples, "runs": options.runs}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "task.json"
        path.write_text(json.dumps(task))
        command = ["blender", "-b", "--factory-startup", "-Y", "-noaudio", "--python-exit-code", "1", "-P", str(worker)]
        env = {f"BLENDER_USER_{part}": folder for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")}
        cost = measure.run([*command, "--", str(path)], env=env)
    found = [json.loads(text[6:]) for _, text in cost.lines if text.startswith("NODES ")]
    if cost.code != 0 or not found:
        raise store.failure("the worker failed", cost.lines, options.cache)
    return [one | {"cpu": cost.cpu} for one in found]


def tasks(options) -> list[dict]:
    """What is measured: our own graphs, then the materials of the real files that are there, then compiling."""
    files = [(options.blends / name, names) for name, names in MATERIALS.items()]
    real = [[str(file.resolve()), name] for file, names in files if file.exists() for name in names]
    out = [{"material": ["", name]} for name in OWN] + [{"material": one} for one in real]
    return out + ([{"compile": options.compile}] if options.compile else [])


def measured(records: store.Store, options, digest: str) -> list[dict]:
    """The records of all tasks, made where they are not there."""
    wanted, out = tasks(options), []
    progress = Progress(len(wanted), records)
    for task in wanted:
        what = task["material"] if "material" in task else ["compile", task["compile"]]
        key = ("nodes", digest, *what, options.threads, options.samples, options.runs)
        progress.step(" ".join(str(part) for part in (Path(str(what[0])).stem, what[1]) if part))
        found = records.get(*key)
        if found is None and not records.out_of_time(key):
            found = records.add(key, turn(options, **task)[0])
        out += [found] if found else []
    return out


def rows(found: list[dict]) -> list[dict]:
    """Nanoseconds of a point beyond the plain material's, the medians of the turns; `low` and `high`: the ratios of the
    fastest and slowest turns."""
    by_name = {r["material"]: r for r in found if "material" in r}
    if PLAIN not in by_name:
        return []
    plain = {engine: statistics.median(v) for engine, v in by_name[PLAIN]["seconds"].items()}
    out = []
    for name, record in by_name.items():
        base = {engine: 0.0 if name == PLAIN else plain[engine] for engine in plain}
        ours, theirs = ([v - base[engine] for v in record["seconds"][engine]] for engine in ("CARDIOID", "CYCLES"))
        middle = [statistics.median(v) for v in (ours, theirs)]
        row = {"material": name, "cardioid_ns": 1e9 * middle[0], "cycles_ns": 1e9 * middle[1], "cpu": record.get("cpu")}
        if "means" in record:
            row["energy"] = record["means"]["CARDIOID"] / max(record["means"]["CYCLES"], 1e-12)
        if middle[1] > 0.0 and min(theirs) > 0.0:
            row |= {"ratio": middle[0] / middle[1], "low": min(ours) / max(theirs), "high": max(ours) / min(theirs)}
        out.append(row)
    return out


def verdicts(table: list[dict], compiled: list[dict]) -> list[result.Verdict]:
    out = []
    ratios = [row["ratio"] for row in table if row["material"] != PLAIN and "ratio" in row]
    if ratios:
        middle = statistics.median(ratios)
        said = f"median {middle:.2f}, largest {max(ratios):.2f} of {len(ratios)} materials"
        out.append(
            result.Verdict("shading takes no longer than in Cycles, in the median", "bench", middle <= 1.0, said)
        )
    for row in compiled:
        said = f"{row['seconds']:.2f} s for {row['count']}"
        out.append(result.Verdict("a thousand materials compile in a second", "bench", row["each_ms"] <= 1.0, said))
    return out


def run(options, found) -> int:
    common.usable(found, "cardioid", "cycles")
    settle(options)
    records = common.records_of(options, "nodes")
    said = measured(records, options, found["cardioid"].stamp())
    table = rows(said)
    compiled = [
        one["compiled"] | {"each_ms": 1e3 * one["compiled"]["seconds"] / one["compiled"]["count"]}
        for one in said
        if "compiled" in one
    ]
    out = result.Result("nodes", "Shading a point", "./scripts/bench nodes --full", not options.full)
    out.tables = [
        result.Table("nodes", "Nanoseconds of a shading point", COLUMNS, table, NOTE),
        result.Table("compile", "Compiling materials", COMPILED, compiled),
    ]
    out.verdicts = verdicts(table, compiled)
    out.settings = {"both": f"one plane, 256², constant sky, no bounce, {options.samples} samples beyond four"}
    gone = [name for name in MATERIALS if not (options.blends / name).exists()]
    out.missing = [f"real files that are not in {options.blends}: {', '.join(gone)}"] if gone else []
    if table and charts.nodes([row for row in table if row["material"] != PLAIN], outcome.place(out, options)):
        out.plots = ["nodes.png"]
    return outcome.finish(out, options, records)
