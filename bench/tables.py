# SPDX-License-Identifier: GPL-3.0-or-later
"""The thesis's tables 5.1, 5.2, 6.1 and 6.2 with its figures beside ours: photons, stages, filter, memory."""

from __future__ import annotations

from . import filter_runs, filter_scenes, filter_tables, outcome, peer_scenes, photons, plot, result, runs, thesis
from . import options as common
from .result import Table, Verdict

PHOTONS = {
    "scene": ["scene", ""],
    "method": ["method", ""],
    "cpu": ["CPU s", ".1f"],
    "relmse": ["relMSE", ".5f"],
    "energy": ["energy", ".4f"],
    "stored": ["deposited", ".3g"],
    "emitted": ["emitted", ".3g"],
    "stored_of_emitted": ["deposited / emitted", ".1%"],
    "of_sppm": ["of SPPM's deposits", ".1%"],
    "gathered": ["gathered", ".3g"],
    "megabytes": ["photon map, MB", ".1f"],
}
STAGES = {
    "scene": ["scene", ""],
    "method": ["method", ""],
    "cpu": ["CPU s", ".1f"],
    "relmse": ["relMSE", ".5f"],
    "energy": ["energy", ".4f"],
    "samples": ["paths a pixel", "d"],
    "passes": ["photon passes", "d"],
    "camera": ["path tracing", ".1%"],
    "trace": ["photon tracing", ".1%"],
    "gather": ["gathering", ".1%"],
    "index": ["indexing", ".1%"],
    "learn": ["learning", ".1%"],
    "build": ["building", ".1%"],
    "picture": ["picture", ".1%"],
}
TIMES = {
    "scene": ["scene", ""],
    "who": ["who", ""],
    "samples": ["samples", "d"],
    "equal_samples": ["samples of PT in the time of all", "d"],
    "render_cpu": ["path tracing, CPU s", ".1f"],
    "render": ["path tracing, s", ".1f"],
    "rejection": ["noise removal, s", ".2f"],
    "filter": ["filtering, s", ".2f"],
    "filter_cpu": ["both, CPU s", ".2f"],
    "share": ["share of all", ".1%"],
}
SIZES = {
    "scene": ["scene", ""],
    "who": ["who", ""],
    "clusters": ["clusters", ".3g"],
    "singles": ["of one sample", ".3g"],
    "megabytes": ["film, MB", ".1f"],
    "outliers": ["outliers", ".3%"],
}
OTHER = (
    "The thesis's rows: another machine, other scenes of the same kind, other times; shares compare, seconds do not."
)
PHOTONS_NOTE = (
    f"{OTHER} A photon may be deposited at several vertices, so shares can be above 100 %. Guided emission, the "
    "default, learns which photons pixels gather; the thesis has none. `of SPPM's deposits`: deposits of an emitted "
    "photon over those of SPPM, both unguided."
)
TIMES_NOTE = f"{OTHER} 768 × 768. Errors of the same filter: ./scripts/bench filter."
SIZES_NOTE = f"{OTHER} Of a film at 768 × 768 and 16 samples, clusters and sums of pixels; thesis: with its buffers."
PATHS = "Table 5.1, caustic paths of path tracing: the engine does not count its contributions by class"
GATHER = "Table 5.2, gathering and picture: ours gathers while camera paths are traced, and is not timed apart"
MOST, SHARE = 0.15, 0.25
"""Thesis 5.7.4: maps hold 7 to 15 % of SPPM's photons; 6.4: the filter takes 20 to 25 % of the time."""


def add_arguments(commands) -> None:
    parser = commands.add_parser("tables", help="the thesis's tables 5.1, 5.2, 6.1 and 6.2, its figures beside ours")
    peer_scenes.add_argument(parser)
    parser.add_argument("--seconds", type=float, default=0.0, help="CPU seconds of a run (4, or 60 with --full)")
    parser.add_argument(
        "--part", choices=("all", "photons", "filter"), default="all", help="5.1 and 5.2, or 6.1 and 6.2"
    )


def with_sppm(rows: list[dict]) -> list[dict]:
    """Adds what a photon of the hybrid deposits over one of SPPM, neither guided."""
    by = {(row["scene"], row["method"]): row for row in rows}
    for (scene, method), row in by.items():
        all_light = by.get((scene, "SPPM unguided"), {}).get("stored_of_emitted")
        if method == "PTPPM unguided" and all_light:
            row["of_sppm"] = row["stored_of_emitted"] / all_light
    return rows


def photon_rows(rows: list[dict]) -> list[dict]:
    """Those of Table 5.1: methods with photons."""
    return [row for row in rows if row.get("emitted")]


def stage_rows(rows: list[dict]) -> list[dict]:
    """Those of Table 5.2: the three methods as users have them, and the thesis's."""
    return [row for row in rows if not row["method"].endswith("unguided")]


def per_scene(rows: list[dict], method: str, key: str, form: str) -> str:
    return ", ".join(f"{row['scene']} {row[key]:{form}}" for row in rows if row["method"] == method and row.get(key))


def chapter_5(rows: list[dict]) -> list[Verdict]:
    """Claims of 5.7.4 that the tables back."""
    plain = [row for row in rows if row["method"] == "PTPPM unguided"]
    ours = [row for row in rows if row["method"] == "PTPPM"]
    out = []
    for key, claim in (
        ("stored_of_emitted", "caustic photons deposited are at most 15 % of those emitted (unguided)"),
        ("of_sppm", "the photon map holds at most 15 % of what SPPM's would (unguided)"),
    ):
        known = [row[key] for row in plain if row.get(key) is not None]
        holds = max(known) <= MOST if known else None
        theirs = ", ".join(f"{scene} {one['share']:.1%}" for scene, one in thesis.TABLE_5_1.items())
        figures = f"{per_scene(plain, 'PTPPM unguided', key, '.1%')}; thesis: {theirs}"
        out.append(Verdict(claim, "thesis Table 5.1", holds, figures))
    guided = per_scene(ours, "PTPPM", "stored_of_emitted", ".0%")
    more = [row["stored_of_emitted"] > thesis.TABLE_5_1[row["scene"]]["share"] for row in ours]
    claim = "guided emission deposits a larger share of what it emits than the thesis's PTPPM"
    out.append(Verdict(claim, "Table 5.1, beyond the thesis (5.8)", all(more) if more else None, guided))
    holds = all(row["camera"] > 0.5 for row in ours) if ours else None
    claim = "path tracing dominates the run time of PTPPM on all scenes"
    out.append(Verdict(claim, "thesis 5.7.4, Table 5.2", holds, per_scene(ours, "PTPPM", "camera", ".0%")))
    return out


def with_shares(rows: list[dict]) -> list[dict]:
    """Adds noise removal's and filtering's share of all time: CPU seconds in ours, seconds in the thesis's."""
    for row in rows:
        after, before = row.get("filter_cpu"), row.get("render_cpu")
        if after is None or before is None:
            after, before = row["rejection"] + row["filter"], row["render"]
        row["share"] = after / (after + before)
    return rows


def chapter_6(times: list[dict], sizes: list[dict]) -> list[Verdict]:
    """Claims of 6.4 that the tables back, against the thesis's own figures of the same scene."""
    out = []
    for row in (row for row in times if row["who"] == "ours"):
        theirs = next((r for r in times if r["scene"] == row["scene"] and r["who"] == "thesis"), None)
        said = f"{row['share']:.1%}" + (f"; thesis {theirs['share']:.1%}" if theirs else "")
        claim = f"{row['scene']}: noise removal and filter take at most a quarter of the time"
        out.append(Verdict(claim, "thesis 6.4, Table 6.1", row["share"] <= SHARE, said))
    for row in (row for row in sizes if row["who"] == "ours" and row["scene"] in thesis.TABLE_6_2):
        bar = thesis.TABLE_6_2[row["scene"]]["megabytes"]
        claim = f"{row['scene']}: the film with its clusters takes no more memory than the thesis's"
        figures = f"{row['megabytes']:.0f} MB; thesis {bar:.0f} MB"
        out.append(Verdict(claim, "thesis Table 6.2", row["megabytes"] <= bar, figures))
    return out


def filter_rows(records, options, engine) -> tuple[list[dict], list[dict]]:
    """Rows of tables 6.1 and 6.2, ours and the thesis's."""
    times, sizes = [], []
    for name in thesis.TABLE_6_1:
        print(f"{name}: 768 × 768, {filter_tables.SAMPLES} samples, filtered", flush=True)
        scene = filter_scenes.SCENES[name]
        film = filter_runs.Film(records, options.cache, engine, scene.job(filter_tables.SAMPLES, 1, 0, options.threads))
        found = filter_tables.tables(film, name)
        film.forget()
        if found:
            times.append(found[0])
            sizes.append(found[1])
        times.append({"scene": name, "who": "thesis", **thesis.TABLE_6_1[name]})
        sizes.append({"scene": name, "who": "thesis", **thesis.TABLE_6_2[name]})
    return with_shares(times), sizes


def run(options, found) -> int:
    engine = runs.engine_of(found)
    records = common.records_of(options, "tables")
    options.seconds = options.seconds or (60.0 if options.full else 4.0)
    title = "The thesis's tables 5.1, 5.2, 6.1, 6.2"
    out = result.Result("tables", title, "./scripts/bench tables --full", not options.full)
    out.versions = {"cardioid-render": engine.stamp()}
    if options.part in ("all", "photons"):
        add_photons(out, options, with_sppm(photons.stages(records, options, engine)))
    if options.part in ("all", "filter"):
        add_filter(out, *filter_rows(records, options, engine))
    return outcome.finish(out, options, records)


def add_photons(out: result.Result, options, rows: list[dict]) -> None:
    title = "Table 5.1: caustic photons, deposited and emitted"
    out.tables.append(Table("table-5-1", title, PHOTONS, photon_rows(rows), PHOTONS_NOTE))
    title = "Table 5.2: camera paths, photon passes, and the stages' shares of the time"
    out.tables.append(Table("table-5-2", title, STAGES, stage_rows(rows), f"{OTHER} {photons.STAGES_NOTE}"))
    out.verdicts += chapter_5(rows)
    out.missing += [PATHS, GATHER]
    out.settings |= {
        name: f"{', '.join(how)}; 24 bounces; {options.seconds:g} CPU s" for name, how in photons.METHODS.items()
    }
    path = outcome.place(out, options).with_name("table-5-2.png")
    if plot.stages(stage_rows(rows), path):
        out.plots.append(path.name)


def add_filter(out: result.Result, times: list[dict], sizes: list[dict]) -> None:
    out.tables.append(Table("table-6-1", "Table 6.1: time of noise removal and filter", TIMES, times, TIMES_NOTE))
    out.tables.append(Table("table-6-2", "Table 6.2: clusters and memory", SIZES, sizes, SIZES_NOTE))
    out.verdicts += chapter_6(times, sizes)
    out.settings["filter"] = (
        "path tracing, 16 samples, 16 bounces; filter by clusters at its defaults, median of five runs"
    )
