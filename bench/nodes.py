# SPDX-License-Identifier: GPL-3.0-or-later
"""Time of a shading point beside Cycles' over real material graphs, and the time to compile 1000 materials."""

from __future__ import annotations

import json
import os
import statistics
import tempfile
from pathlib import Path

from . import engines, measure, store

PLAIN = "plain diffuse"
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
COLUMNS = {"material": "", "cardioid_ns": ".0f", "cycles_ns": ".0f", "ratio": ".2f", "low": ".2f", "high": ".2f"}


def add_arguments(commands) -> None:
    parser = commands.add_parser("nodes", help="time of a shading point beside Cycles'; 1000 materials compiled")
    blends = os.environ.get("CARDIOID_BLENDS", str(engines.ROOT.parent / "shared" / "blends"))
    parser.add_argument("--blends", type=Path, default=blends, help="the folder of real files (%(default)s)")
    parser.add_argument("--samples", type=int, default=32, help="of the longer render, at 256×256 (%(default)s)")
    parser.add_argument("--runs", type=int, default=3, help="turns of each engine and material (%(default)s)")
    parser.add_argument("--compile", type=int, default=1000, help="materials to compile; 0: none (%(default)s)")


def turn(path: Path, options) -> list[dict]:
    """What the worker says."""
    with tempfile.TemporaryDirectory() as folder:
        task = Path(folder) / "task.json"
        files = [(options.blends / name, names) for name, names in MATERIALS.items()]
        listed = [[str(file.resolve()), name] for file, names in files if file.exists() for name in names]
        addon = os.environ.get("CARDIOID_ADDON", str(engines.ROOT / "addon"))
        task.write_text(
            json.dumps(
                {
                    "addon": addon,
                    "threads": options.threads,
                    "samples": options.samples,
                    "runs": options.runs,
                    "compile": options.compile,
                    "materials": listed,
                }
            )
        )
        command = ["blender", "-b", "--factory-startup", "-Y", "-noaudio", "--python-exit-code", "1", "-P", str(path)]
        env = {f"BLENDER_USER_{part}": folder for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")}
        cost = measure.run([*command, "--", str(task)], env=env, timeout=7200.0)
    found = [json.loads(text[6:]) for _, text in cost.lines if text.startswith("NODES ")]
    if cost.code != 0:
        raise RuntimeError("the worker failed:\n" + "\n".join(text for _, text in cost.lines[-10:]))
    return found


def rows(found: list[dict]) -> list[dict]:
    """Nanoseconds of a point beyond the plain material's, the medians of the turns; `low` and `high`: the ratios of the
    fastest and slowest turns."""
    by_name = {r["material"]: r["seconds"] for r in found if "material" in r}
    plain = {engine: statistics.median(v) for engine, v in by_name[PLAIN].items()}
    out = []
    for name, seconds in by_name.items():
        base = {engine: 0.0 if name == PLAIN else plain[engine] for engine in plain}
        ours, theirs = ([v - base[engine] for v in seconds[engine]] for engine in ("CARDIOID", "CYCLES"))
        middle = [statistics.median(v) for v in (ours, theirs)]
        row = {"material": name, "cardioid_ns": 1e9 * middle[0], "cycles_ns": 1e9 * middle[1]}
        if middle[1] > 0.0 and min(theirs) > 0.0:
            row |= {"ratio": middle[0] / middle[1], "low": min(ours) / max(theirs), "high": max(ours) / min(theirs)}
        out.append(row)
    return out


def run(options, _found) -> int:
    found = turn(Path(__file__).with_name("nodes_worker.py"), options)
    table = rows(found)
    store.publish(table, COLUMNS, options.cache / "nodes")
    ratios = [r["ratio"] for r in table if r["material"] != PLAIN and "ratio" in r]
    print("Nanoseconds of CPU time (user and system) of a shading point, beyond those of a plain diffuse plane.")
    if ratios:
        middle = statistics.median(ratios)
        print(f"ratio to Cycles: median {middle:.2f}, largest {max(ratios):.2f} ({len(ratios)} materials)")
    for entry in found:
        if "compiled" in entry:
            many = entry["compiled"]
            print(f"{many['count']} materials compiled in {many['seconds']:.3f} s, exported in {many['export']:.2f} s")
    return 0 if table else 1
