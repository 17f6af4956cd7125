# SPDX-License-Identifier: GPL-3.0-or-later
"""Arguments after `--` on Blender's command line."""

from __future__ import annotations

import json
import sys

import bpy
import pytest


def parse(*words):
    from cardioid import cli_args

    return cli_args.parse(["blender", "-b", "file.blend", "-f", "1", *words])


def test_nothing_without_dashes(addon):
    assert parse("--cardioid-samples", "5") == parse()
    assert parse().overrides == {} and parse().stats == "" and parse().problems == ()
    assert parse().print_stats is False


def test_all_arguments(addon):
    found = parse("--", "--other", "x", "--cardioid-samples", "16", "--cardioid-integrator", "pt",
                  "--cardioid-time-limit", "2.5", "--cardioid-threads", "2", "--cardioid-seed=7",
                  "--cardioid-stats", "/tmp/s.json", "--cycles-device", "CPU")
    assert found.overrides == {"samples": 16, "integrator": "PT", "time_limit": 2.5, "threads": 2, "seed": 7}
    assert found.stats == "/tmp/s.json" and found.problems == ()


def test_caustics(addon):
    found = parse("--", "--cardioid-integrator", "ptppm", "--cardioid-indirect-caustics", "path_tracing",
                  "--cardioid-photons", "1000000000", "--cardioid-photon-radius", "1.5", "--cardioid-caustic-roughness",
                  "0.2", "--cardioid-radius-shrink", "1", "--cardioid-radius-schedule", "per_pixel",
                  "--cardioid-guided-emission", "off", "--cardioid-blend-caustic-hits", "OFF",
                  "--cardioid-physical-refraction", "on", "--cardioid-print-stats")
    assert found.problems == () and found.print_stats is True
    assert found.overrides == {
        "integrator": "PTPPM", "indirect_caustics": "PATH_TRACING", "photons": 1000000000, "photon_radius": 1.5,
        "caustic_roughness": 0.2, "radius_shrink": 1.0, "radius_schedule": "PER_PIXEL", "guided_emission": False,
        "blend_caustic_hits": False, "physical_refraction": True}


def test_every_caustics_setting_has_an_argument(addon):
    from cardioid.cli_args import k_arguments
    from cardioid.settings_table import k_settings

    caustics = [setting.name for setting in k_settings if "photon" in setting.name or "caustic" in setting.name]
    followed = {"reflective_caustics", "refractive_caustics"}
    assert len(caustics) > 5 and set(caustics) - followed <= {argument[1] for argument in k_arguments}


@pytest.mark.parametrize("words, expected", [
    (("--cardioid-photons", "-1"), "--cardioid-photons: '-1' is not a whole number of at least 0"),
    (("--cardioid-photons", "1e6"), "--cardioid-photons: '1e6' is not a whole number of at least 0"),
    (("--cardioid-photons", "3000000000"), "--cardioid-photons: '3000000000' is not a whole number"),
    (("--cardioid-photon-radius", "0"), "--cardioid-photon-radius: '0' is not a number from 0.01 to 1000"),
    (("--cardioid-caustic-roughness", "nan"), "--cardioid-caustic-roughness: 'nan' is not a number from 0 to 1"),
    (("--cardioid-caustic-roughness", "2"), "--cardioid-caustic-roughness: '2' is not a number from 0 to 1"),
    (("--cardioid-indirect-caustics", "no"), "'no' is not one of photons, path_tracing, off"),
    (("--cardioid-guided-emission", "1"), "--cardioid-guided-emission: '1' is not one of on, off"),
    (("--cardioid-samples", "0"), "--cardioid-samples: '0' is not a whole number of at least 1"),
    (("--cardioid-samples", "many"), "--cardioid-samples: 'many' is not a whole number of at least 1"),
    (("--cardioid-samples",), "--cardioid-samples: expected one argument"),
    (("--cardioid-integrator", "BDPT"),
     "--cardioid-integrator: 'BDPT' is not an integrator of this engine; it has PTPPM, PT, SPPM"),
    (("--cardioid-time-limit", "-1"), "--cardioid-time-limit"),
    (("--cardioid-time-limit", "nan"), "--cardioid-time-limit: 'nan' is not a time in seconds"),
    (("--cardioid-threads", "1e3"), "--cardioid-threads: '1e3'"),
    (("--cardioid-smaples", "4"), "--cardioid-smaples: there is no such option"),
])
def test_wrong_values_are_told(addon, words, expected):
    problems = parse("--", *words, "--cardioid-seed", "3").problems
    assert len(problems) == 1 and expected in problems[0]
    assert parse("--", *words, "--cardioid-seed", "3").overrides == {"seed": 3}


def test_overrides_reach_the_engine(addon, render, fake, monkeypatch, tmp_path):
    stats = tmp_path / "stats.json"
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-samples", "2", "--cardioid-seed", "11",
                                      "--cardioid-stats", str(stats)])
    render()
    assert fake.scenes[-1].settings["samples"] == 2 and fake.scenes[-1].settings["seed"] == 11
    written = json.loads(stats.read_text())
    last = written["renders"][-1]
    assert last["samples"] == 2 and last["complete"] is True and last["layer"] == "ViewLayer" and last["frame"] == 1
    assert last["engine"]["samples"] == 2 and last["render_seconds"] >= 0
    assert written["cardioid"]["engine"] == "0.0.fake"
    assert [path.name for path in tmp_path.glob("stats*")] == ["stats.json"]


def test_printed_statistics(addon, monkeypatch, capfd):
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-print-stats"])
    bpy.ops.render.render()
    lines = capfd.readouterr().out.splitlines()
    start = lines.index("Cardioid: frame 1, layer ViewLayer")
    rows = dict(line.strip().split("  ", 1) for line in lines[start + 1:] if line.startswith("  "))
    assert {label: words.strip() for label, words in rows.items()} | {
        "Integrator": "Path Tracing + Photons", "Samples": "4", "Photon passes": "2", "Photons emitted": "1 000 000",
        "Photons stored": "150 000", "Stored of emitted": "15.00 %", "Photons gathered": "12 345 678",
        "Photon tracing": "1.25 s", "Photon index": "0.50 s", "Camera paths and gathering": "7.75 s",
        "Memory of photons": "3M"} == {label: words.strip() for label, words in rows.items()}


def test_path_tracing_prints_no_photons(addon, monkeypatch, capfd):
    bpy.context.scene.cardioid.integrator = "PT"
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-print-stats"])
    bpy.ops.render.render()
    table = capfd.readouterr().out
    assert "Path Tracing\n" in table and "hoton" not in table


def test_wrong_value_stops_the_render_with_one_sentence(addon, fake, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-samples", "0"])
    with pytest.raises(RuntimeError, match="'0' is not a whole number"):
        bpy.ops.render.render()
    assert not fake.sessions


def test_statistics_that_cannot_be_written(addon, fake, monkeypatch, tmp_path):
    monkeypatch.setattr(sys, "argv", ["blender", "--", "--cardioid-stats", str(tmp_path / "absent" / "s.json")])
    from cardioid import messages

    told = []
    monkeypatch.setattr(messages, "warn", lambda engine, texts: told.extend(texts))
    assert bpy.ops.render.render() == {"FINISHED"}
    assert [text for text in told if "cannot be written" in text]
