# SPDX-License-Identifier: GPL-3.0-or-later
"""Bytes per triangle and per pixel beside Cycles', per photon and per cluster beside the thesis's Table 6.2."""

from __future__ import annotations

from pathlib import Path

from . import charts, filter_methods, filter_runs, filter_scenes, filter_tables, kept, outcome, result, store, thesis
from . import options as common
from .engines import CommandLine, Engine, Job
from .grids import build_grid
from .progress import Progress

SIDES, FULL_SIDES = (500, 1000), (708, 1735)
"""Of the grids: half a million and two million triangles; in full one and six."""
WIDTHS, FULL_WIDTHS = (768, 1920), (1024, 3072)
ENGINES = {
    "who": ["engine", ""],
    "per_triangle": ["bytes a triangle", ".1f"],
    "blender_per_triangle": ["Blender's own", ".1f"],
    "per_pixel": ["bytes a pixel", ".1f"],
    "peak_mb": ["peak at the larger mesh, MB", ".0f"],
    "cpu": ["CPU s of that run", ".1f"],
    "energy": ["energy over Cycles'", ".4f"],
}
PARTS = {"part": ["part", ""], "bytes": ["bytes", ".1f"], "of": ["of", ""], "how": ["from", ""]}
SIZES = {
    "scene": ["scene", ""],
    "who": ["who", ""],
    "clusters": ["clusters", ".3e"],
    "singles": ["of one sample", ".3e"],
    "megabytes": ["MB, clusters with buffers", ".1f"],
    "per_cluster": ["bytes a cluster", ".1f"],
    "outliers": ["outliers", ".3%"],
    "cpu": ["CPU s of the render", ".1f"],
}
NOTE = (
    "Slopes of the process's peak resident memory between two meshes and between two picture sizes; the engine's "
    "triangles come on top of Blender's own, which are a run's that only loads the file. One sample, path tracing."
)
THESIS_SCENES = ("glossy_spheres", "bust_in_water")
THESIS_SIDE, SAMPLES = 768, 16
BUFFERS = 28.0
"""Bytes of a pixel that the thesis counts beside the clusters: texture detail and normal (three floats each), depth."""
PHOTONS = (16384, 262144)


def add_arguments(commands) -> None:
    commands.add_parser("memory", help="bytes per triangle, pixel, photon and cluster; the thesis's Table 6.2")


def slopes(records, options, engine: Engine, grids: list[tuple[Path, int]], progress: Progress) -> dict | None:
    """One engine's row, without `energy`; None: out of time."""
    widths = FULL_WIDTHS if options.full else WIDTHS
    (small, few), (large, many) = grids

    def peak(blend: Path, width: int, only_load: bool = False) -> dict | None:
        progress.step(f"{engine.title}, {blend.stem}, {'only loaded' if only_load else f'{width} pixels wide'}")
        out = "" if only_load else "yes"
        return kept.run(
            records, engine, Job(str(blend), out, 1, 1, options.threads, width=width, only_load=only_load), "memory"
        )

    found = [peak(large, 64), peak(small, 64), peak(large, 64, True), peak(small, 64, True)]
    found += [peak(small, width) for width in widths[::-1]]
    if None in found:
        return None
    sizes = [one["peak_bytes"] for one in found]
    load = (sizes[2] - sizes[3]) / (many - few)
    row = {"engine": engine.key, "who": engine.title, "blender_per_triangle": load}
    row["per_triangle"] = (sizes[0] - sizes[1]) / (many - few) - load
    row["per_pixel"] = (sizes[4] - sizes[5]) / (found[4]["pixels"] - found[5]["pixels"])
    return row | {"peak_mb": sizes[0] / 1e6, "cpu": found[0]["cpu"], "mean": found[0]["mean"]}


def parts(records, options, engine: CommandLine, grids: list[tuple[Path, int]], progress: Progress) -> list[dict]:
    """What the engine itself counts: of a triangle, of a photon."""
    rows = []
    progress.step("the engine's own count, triangles")
    grid = kept.run(records, engine, Job(str(grids[1][0]), "", 1, 1, options.threads, width=64), "memory")
    if grid:
        sizes, triangles = grid["counters"]["bytes"], grids[1][1]
        for key, what in (("geometry", "mesh: positions, normals, UV"), ("ray_tree", "ray tree (Embree)")):
            rows.append({"part": what, "bytes": sizes[key] / triangles, "of": "a triangle", "how": grids[1][0].stem})
    progress.step("the engine's own count, photons")
    scene = filter_scenes.SCENES["metallic_ring (hybrid)"]
    runs = []
    for count in PHOTONS:
        job = scene.job(SAMPLES, 1, 128, options.threads, (f"photons={count}",))
        runs.append(kept.run(records, engine, job, "memory"))
    if all(runs):
        few, many = (one["counters"] for one in runs)
        stored = [one["photons"]["stored"] / max(one["photons"]["passes"], 1) for one in (few, many)]
        size = (many["bytes"]["photons"] - few["bytes"]["photons"]) / max(stored[1] - stored[0], 1.0)
        rows.append({"part": "photon with its grid", "bytes": size, "of": "a stored photon", "how": scene.file})
    return rows


def table_6_2(records, options, engine: CommandLine, progress: Progress) -> list[dict]:
    """Ours and the thesis's rows."""
    rows = []
    for name in THESIS_SCENES:
        progress.step(f"{name}, {THESIS_SIDE}², {SAMPLES} samples: clusters")
        job = filter_scenes.SCENES[name].job(SAMPLES, 1, THESIS_SIDE, options.threads)
        film = filter_runs.Film(records, options.cache, engine, job)
        done = film.filtered(filter_methods.CLUSTERS)
        film.forget()
        if done:
            rows.append(sizes_row(name, done[0]) | {"cpu": film.raw()[0]["cpu"]})
        theirs = thesis.TABLE_6_2[name]
        own = (theirs["megabytes"] * 1e6 - BUFFERS * THESIS_SIDE**2) / theirs["clusters"]
        rows.append({"scene": name, "who": "thesis", **theirs, "per_cluster": own})
    return rows


def sizes_row(name: str, found: dict) -> dict:
    """A row of Table 6.2 from what the filter counted, in the thesis's sense: clusters with texture, depth, normal."""
    row = {"scene": name, "who": "ours", "clusters": found["clusters"], "singles": found["singles"]}
    row["megabytes"] = (found["cluster_bytes"] + BUFFERS * THESIS_SIDE**2) / 1e6
    row["film_mb"] = found["film_bytes"] / 1e6
    return row | {"per_cluster": found["cluster_bytes"] / found["clusters"], "outliers": found["outlier_share"]}


def verdicts(rows: list[dict], sizes: list[dict], ours: str) -> list[result.Verdict]:
    out = []
    for row in (one for one in sizes if one["who"] == "ours"):
        other = next(one for one in sizes if one["scene"] == row["scene"] and one["who"] == "thesis")
        said = f"{row['megabytes']:.0f} MB against {other['megabytes']:.0f} MB; our whole film {row['film_mb']:.0f} MB"
        claim = f"{row['scene']}: clusters with their buffers take no more memory than the thesis's"
        out.append(result.Verdict(claim, "thesis Table 6.2", row["megabytes"] <= other["megabytes"], said))
    own, other = (next((r for r in rows if (r["engine"] == ours) is same), None) for same in (True, False))
    if own and other:
        for key, what in (("per_triangle", "triangle"), ("per_pixel", "pixel")):
            said = f"{own[key]:.0f} bytes against {other[key]:.0f}"
            out.append(result.Verdict(f"no more memory a {what} than Cycles", "bench", own[key] <= other[key], said))
    return out


def measure(options, records: store.Store, pair: list[Engine], engine: CommandLine) -> tuple[list[dict], ...]:
    sides = FULL_SIDES if options.full else SIDES
    paths = [options.cache / "scenes" / f"grid-{side}.blend" for side in sides]
    grids = [(path, build_grid(path, side)) for path, side in zip(paths, sides)]
    progress = Progress(6 * len(pair) + 4, records)
    rows = [row for one in pair if (row := slopes(records, options, one, grids, progress))]
    for row in rows if len(rows) == len(pair) else []:
        row["energy"] = row["mean"] / rows[1]["mean"]
    large = []
    if options.full:
        progress.step("a film at 1920 × 1080")
        large = filter_tables.large_film(records, options, engine, filter_scenes.SCENES[THESIS_SCENES[0]])
    return rows, parts(records, options, engine, grids, progress), table_6_2(records, options, engine, progress), large


def run(options, found) -> int:
    pair = common.usable(found, options.ours, options.rival)
    (engine,) = common.usable(found, "cardioid-cli")
    records = common.records_of(options, "memory")
    rows, counted, sizes, large = measure(options, records, pair, engine)
    out = result.Result("memory", "Memory", "./scripts/bench memory --full", not options.full)
    out.tables = [
        result.Table("engines", "Bytes a triangle and a pixel", ENGINES, rows, NOTE),
        result.Table("parts", "What Cardioid itself counts", PARTS, counted),
        result.Table("clusters", f"Clusters at {THESIS_SIDE}², {SAMPLES} samples (thesis Table 6.2)", SIZES, sizes),
    ]
    if large:
        columns = {"scene": ["scene", ""], "megabytes_1080p": ["MB, whole film", ".0f"]}
        out.tables.append(result.Table("large", "A film with clusters at 1920 × 1080, 16 samples", columns, large))
    out.settings = {one.title: "path tracing, one sample; the tree, the mesh and the picture in memory" for one in pair}
    out.verdicts = verdicts(rows, sizes, pair[0].key)
    if sizes and charts.memory(rows, sizes, outcome.place(out, options)):
        out.plots = ["memory.png"]
    return outcome.finish(out, options, records)
