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


def test_all_arguments(addon):
    found = parse("--", "--other", "x", "--cardioid-samples", "16", "--cardioid-integrator", "pt",
                  "--cardioid-time-limit", "2.5", "--cardioid-threads", "2", "--cardioid-seed=7",
                  "--cardioid-stats", "/tmp/s.json", "--cycles-device", "CPU")
    assert found.overrides == {"samples": 16, "integrator": "PT", "time_limit": 2.5, "threads": 2, "seed": 7}
    assert found.stats == "/tmp/s.json" and found.problems == ()


@pytest.mark.parametrize("words, expected", [
    (("--cardioid-samples", "0"), "--cardioid-samples: '0' is not a whole number of at least 1"),
    (("--cardioid-samples", "many"), "--cardioid-samples: 'many' is not a whole number of at least 1"),
    (("--cardioid-samples",), "--cardioid-samples: expected one argument"),
    (("--cardioid-integrator", "BDPT"), "--cardioid-integrator: 'BDPT' is not an integrator of this engine; it has PT"),
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
