# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m bench filter --part quality`: every method on every scene, over the number of samples."""

from __future__ import annotations

import numpy as np

from . import denoise, exr, filter_methods, filter_runs, filter_scenes, metrics, plot, quality, store

COLUMNS = {
    "scene": "",
    "samples": "d",
    "method": "",
    "taken": "d",
    "cpu": ".2f",
    "relmse": ".5f",
    "relmse_trim": ".5f",
    "of_equal_time": ".2f",
}
COLUMNS |= {"flip": ".4f", "energy": ".4f", "of_raw": ".4f", "fireflies": "d", "texture_kept": ".4f"}
COLUMNS |= {"light_edges": ".5f", "reference": ".5f"}
CLASSES = ("D1", "D2", "D3", "C1", "C2")
CLASS_COLUMNS = {"scene": ""} | {key: ".5f" for one in CLASSES for key in (one, f"{one}_trim")}
JUDGED = 16
"""Samples at which the issue sets its bars, and at which renders of equal time and clamped ones are made."""


def rows_of(film: filter_runs.Film, name: str, referee: quality.Referee, surface) -> list[dict]:
    """One scene at one number of samples."""
    pictures = filter_methods.of_film(film, surface)
    if film.job.samples == JUDGED and "clusters" in pictures:
        pictures |= filter_methods.rendered_again(film, pictures["clusters"].cpu)
    rows = []
    for method, picture in pictures.items():
        row = {"scene": name, "samples": film.job.samples, "method": method, "taken": picture.samples}
        row |= {"cpu": picture.cpu, **quality.evaluate(picture.pixels, referee)}
        row["of_raw"] = float(picture.pixels.mean() / pictures["raw"].pixels.mean())
        rows.append(row)
    equal = next((row["relmse"] for row in rows if row["method"] == "equal time"), None)
    for row in rows:
        row["of_equal_time"] = row["relmse"] / equal if equal else None
    return rows


def classes(film: filter_runs.Film, name: str, reference: list) -> dict | None:
    """The raw picture's error by path class: what each adds to a picture that is right in all others."""
    found = film.raw()
    if found is None:
        return None
    truth = np.mean([exr.load(path) for path in reference], 0)
    row = {"scene": name}
    for one in CLASSES:
        wrong = exr.load(found[1], one) - np.mean([exr.load(path, one) for path in reference], 0)
        squares = metrics.relative_squares(truth + wrong, truth)
        row |= {one: float(squares.mean()), f"{one}_trim": metrics.trimmed(squares)}
    return row


def judge(rows: list[dict]) -> list[str]:
    """The issue's bars at 16 samples, scene by scene; whatever is missed is said."""
    out = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        found = {row["method"]: row for row in rows if row["scene"] == scene and row["samples"] == JUDGED}
        ours = found.get("clusters")
        if not ours or "equal time" not in found:
            continue
        cross = min(found[name]["relmse"] for name in found if name.startswith("cross-bilateral"))
        free = found["clusters, no rejection"]["of_raw"]
        bars = [
            ("error over equal time's", ours["of_equal_time"], ours["of_equal_time"] <= 0.25, "at most 0.25"),
            ("error over cross-bilateral's", ours["relmse"] / cross, ours["relmse"] < cross, "under 1"),
            ("energy without rejection over raw", free, abs(free - 1) <= 0.01, "within 1 %"),
        ]
        if ours.get("texture_kept") is not None:
            kept = ours["texture_kept"]
            bars.append(("texture kept", kept, kept >= 0.98, "at least 0.98"))
        out += [f"{scene}: {what} {value:.4f} ({bar}): {'met' if met else 'MISSED'}" for what, value, met, bar in bars]
        out += against_oidn(scene, ours, found)
    return out


def against_oidn(scene: str, ours: dict, found: dict[str, dict]) -> list[str]:
    other = found.get("OIDN")
    if other is None:
        return []
    trimmed = ours["relmse_trim"] / other["relmse_trim"]
    parts = [f"error {ours['relmse'] / other['relmse']:.2f} of OIDN's (trimmed {trimmed:.2f})"]
    if ours.get("light_edges") is not None:
        parts.append(f"at edges of light {ours['light_edges'] / other['light_edges']:.2f}")
    if ours.get("texture_kept") is not None:
        parts.append(f"texture kept {ours['texture_kept']:.3f}, OIDN {other['texture_kept']:.3f}")
    return [f"{scene}: " + ", ".join(parts)]


def run(options, records: store.Store, engine, referee_engine) -> int:
    rows, by_class = [], []
    for name in options.scene or filter_scenes.SCENES:
        scene = filter_scenes.SCENES[name]
        referee = filter_scenes.referee(records, options.cache, referee_engine, scene, options.width, options.threads)
        if referee is None:
            print(f"{name}: out of time")
            continue
        surface = filter_scenes.surface(options.cache, scene, options.width)
        for samples in options.counts:
            job = scene.job(samples, 1, options.width, options.threads)
            film = filter_runs.Film(records, options.cache, engine, job)
            rows += rows_of(film, name, referee, surface)
            if samples == JUDGED:
                by_class.append(classes(film, name, referee.paths))
            film.forget()
            print(f"   {name}, {samples} samples: done", flush=True)
    stem = options.cache / "filter-quality"
    store.publish(rows, COLUMNS, stem)
    if plot.over_samples(rows, stem.with_suffix(".png")):
        print(f"{stem.with_suffix('.png')}")
    store.publish([row for row in by_class if row], CLASS_COLUMNS, options.cache / "filter-classes")
    for note in [*judge(rows), denoise.problem()]:
        if note:
            print(note)
    return 0 if rows else 1
