# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison with other renderers, on programs that only pretend to render."""

from __future__ import annotations

import argparse
import sys

import numpy as np
import pytest

from bench import exr, peer_scenes, peers, peers_figures, products, result, store

FAKE = """
import json, os, sys
words = dict(zip(sys.argv[1::2], sys.argv[2::2]))
if words["--mode"] == "broken":
    print("no device")
    raise SystemExit(2)
sys.path.insert(0, os.environ["BENCH_ROOT"])
import numpy as np
from pathlib import Path
from bench import exr
exr.save(Path(words["--out"]), np.full((4, 4, 3), 0.5))
with open(words["--out"] + ".log", "a") as file:
    file.write("started")
print("RESULT " + json.dumps({"cpu": 1.0, "wall": 1.0, "samples": float(words.get("--samples", 12)), "version": "9"}))
"""


class Fake(products.Rival):
    script = "fake.py"


@pytest.fixture
def setup(tmp_path, monkeypatch):
    for name in ("fake.py", *Fake.uses):
        (tmp_path / name).write_text(FAKE)
    monkeypatch.setattr(products, "RIVALS", tmp_path)
    monkeypatch.setenv("BENCH_ROOT", str(products.ROOT))
    return products.Setup(store.Store(tmp_path / "r.jsonl"), tmp_path, None, 2)


@pytest.fixture
def scene(tmp_path):
    mask = np.ones((4, 4), bool)
    everywhere = {"all": mask, "caustic": mask}
    return peer_scenes.PeerScene(
        "s", tmp_path / "s.blend", np.ones((4, 4, 3)), everywhere, dict.fromkeys(everywhere, 0.1)
    )


def fake(mode="cpu", **more):
    return Fake("fake", "Fake", "as it is", sys.executable, mode, **more)


def test_a_program_is_run_once_and_its_result_kept(setup, scene):
    first = fake().render(setup, scene, 1, 30.0)
    assert (first["samples"], first["version"]) == (12, "9")
    assert fake().render(setup, scene, 1, 30.0) == first
    logs = {path.name: path.read_text() for path in setup.cache.glob("rivals/*.log")}
    assert len(logs) == 2 and set(logs.values()) == {"started"}


def test_start_up_is_taken_off_the_whole_process(setup, scene, monkeypatch):
    costs = iter([2.5, 14.0])
    real = products.measure.run

    def counted(command, **how):
        cost = real(command, **how)
        cost.cpu = next(costs)
        return cost

    monkeypatch.setattr(products.measure, "run", counted)
    done = fake().render(setup, scene, 1, 12.0)
    assert (done["cpu"], done["cpu_process"]) == (11.5, 14.0)


def test_a_changed_program_is_measured_anew(setup, scene):
    fake().render(setup, scene, 1, 30.0)
    (setup.cache / "fake.py").write_text(FAKE.replace('"9"', '"10"'))
    products.programs.of_file.cache_clear()
    assert fake().render(setup, scene, 1, 30.0)["version"] == "10"


def test_a_program_that_fails_is_left_out_with_its_last_words(setup, scene):
    chosen, missing = {"fake": fake("broken"), "other": fake()}, []
    assert peers.measure_one(setup, chosen, "fake", scene, 1, 12.0, missing) is None
    assert list(chosen) == ["other"] and missing == ["Fake: ended with exit code 2: no device"]
    assert peers.measure_one(setup, chosen, "other", scene, 1, 12.0, missing)["energy"] == pytest.approx(0.5)


def test_a_broken_environment_is_a_line(tmp_path):
    assert "is not there (scripts/setup peers)" in products.unimportable(str(tmp_path / "python"), "mitsuba")
    broken = tmp_path / "bin"
    broken.write_text("#!/nowhere\n")
    broken.chmod(0o755)
    assert "does not start" in products.unimportable(str(broken), "mitsuba")
    assert "no_such_renderer does not import" in products.unimportable(sys.executable, "no_such_renderer")
    assert products.unimportable(sys.executable, "json") == ""
    known, missing = products.available(), []
    known["mitsuba"].host = str(tmp_path / "python")
    assert peers.usable(["mitsuba"], known, missing) == {} and len(missing) == 1


def test_cycles_samples_fill_the_time(monkeypatch, scene):
    made = products.Cycles("c", "C", "", "blender", "denoised", filtered=True)
    spent = {("--samples", "1"): 4.0, ("--samples", "33"): 20.0}
    monkeypatch.setattr(made, "measured", lambda a, b, mode, amount, seed: {"cpu_process": spent[tuple(amount)]})
    # half a second a sample; the denoiser's three seconds come off the mark
    assert made.amount(None, scene, {"cpu_process": 1.0}, 13.0) == ["--samples", "20"]


def test_shadow_caustics_are_for_scenes_with_glass():
    ring, cornell = (peer_scenes.PeerScene(name, None, None, {}, {}) for name in ("ring", "cornell"))
    shadow = products.available()["cycles34_shadow"]
    assert shadow.suits(cornell) and not shadow.suits(ring)


def options_of(**more):
    return argparse.Namespace(**{"products": "", "full": False} | more)


def test_the_reduced_size_takes_the_newest_blender():
    found = products.available()
    names = peers.wanted(options_of(), found)
    assert "cardioid" in names and "mitsuba" in names and "luxcore" in names and "cycles34" in names
    newest = [name for name in names if name.startswith(("cycles45", "cycles50"))]
    assert len({name.split("_")[0] for name in newest}) == 1
    assert set(names) <= set(found)
    assert set(names) < set(peers.wanted(options_of(full=True), found)) == set(found) - {"mitsuba_split"}
    with pytest.raises(SystemExit, match="no product named house"):
        peers.wanted(options_of(products="cardioid,house"), found)


def test_every_product_says_its_settings_in_words():
    for product in products.available().values():
        assert len(product.words) > 20 and product.title


def peer_row(product, whole, caustic, **more):
    row = {"scene": "s", "mark": 12.0, "product": product, "title": product, "relmse": whole, "relmse_caustic": caustic}
    row |= {"relmse_trim": whole, "flip": 0.1, "cpu": 12.0, "cpu_process": 14.0, "samples": 8.0, "runs": 1}
    row |= {"energy": 1.0, "energy_caustic": 1.0, "reference": 0.01, "filtered": False, "ours": False}
    return row | more


def test_a_rival_that_wins_is_told_with_its_energy_and_time():
    rows = [peer_row("cardioid", 0.01, 0.03, ours=True), peer_row("lux", 0.02, 0.02, energy_caustic=0.98)]
    rows += [peer_row("slow", 0.5, 0.5), peer_row("denoised", 0.001, 0.001, filtered=True)]
    whole, caustic = peers.judge(rows)
    assert whole.holds and "cardioid 0.01000 (energy 1.000, 12.0 CPU s)" in whole.figures
    assert caustic.holds is False and "the best rival: lux 0.02000 (energy 0.980, 12.0 CPU s)" in caustic.figures
    rows += [peer_row("cardioid_filtered", 0.002, 0.0005, ours=True, filtered=True)]
    assert [verdict.holds for verdict in peers.judge(rows)] == [True, False, False, True]
    assert peers.judge(rows[:1]) == []


def test_our_own_missing_light_is_a_verdict():
    rows = [peer_row("cardioid", 0.01, 0.03, ours=True, energy=0.985)]
    (verdict,) = peers.energies(rows)
    assert verdict.holds is False and "-1.50%" in verdict.figures


def test_every_product_is_first_once():
    names = ["a", "b", "c"]
    assert [peers.interleaved(names, seed)[0] for seed in (1, 2, 3)] == names
    assert all(sorted(peers.interleaved(names, seed)) == names for seed in range(1, 9))


def test_rows_are_medians_best_first():
    known = products.available()
    values = [{"cpu": cpu, "relmse": error, "path": "a"} for cpu, error in ((12.0, 0.3), (11.0, 0.1), (14.0, 0.2))]
    rows = peers.rows_of({("s", 12.0, "cardioid"): values, ("s", 12.0, "mitsuba"): values[1:2]}, known)
    assert [row["product"] for row in rows] == ["mitsuba", "cardioid"]
    assert (rows[1]["relmse"], rows[1]["cpu"], rows[1]["runs"]) == (0.2, 12.0, 3)


def test_plot_and_pictures_are_named_in_the_result(tmp_path, scene):
    pytest.importorskip("matplotlib")
    pytest.importorskip("PIL")
    exr.save(tmp_path / "a.exr", np.full((4, 4, 3), 0.5))
    one = {"path": str(tmp_path / "a.exr"), "samples": 8.0, "cpu": 12.0, "relmse": 0.1, "energy": 0.5}
    rows = [peer_row("cardioid", 0.01, 0.03, ours=True), peer_row("mitsuba", 0.02, 0.02)]
    made = result.Result("peers", "Peers", "", True)
    peers_figures.add(made, tmp_path, [scene], {("s", 12.0, "cardioid"): [one]}, rows, products.available())
    assert made.plots == ["peers-12.png"] and not made.missing
    assert [picture.reference for picture in made.pictures] == [True, False]
    assert all((tmp_path / name).exists() for name in (*made.plots, *(p.file for p in made.pictures)))
