# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/settings-reference.md is what the code says now, and nothing of the code is missing in it."""

from __future__ import annotations

import read_settings
import settings_reference


def test_the_committed_page_is_current():
    assert settings_reference.PAGE.read_text() == settings_reference.page(), "run ./scripts/docs settings"


def test_every_key_that_the_engine_reads_is_there():
    assert {one.key for one in read_settings.engine_settings()} == read_settings.known_keys()


def test_every_setting_of_the_add_on_names_a_key_that_the_engine_reads():
    table = read_settings.addon_module("settings_table")
    assert {one.key for one in table.k_settings if one.key} - read_settings.known_keys() == set()


def test_every_setting_is_in_a_panel():
    table = read_settings.addon_module("settings_table")
    assert [one.name for one in table.k_settings if one.name not in read_settings.panels()] == []


def test_choices_of_the_engine_are_those_of_the_add_on():
    """Names of choices are the engine's words in capitals, so that exports name what the engine knows."""
    table, enums, words = read_settings.addon_module("settings_table"), read_settings.enum_of(), read_settings.choices()
    for one in table.k_settings:
        if one.kind == "enum":
            assert {name.lower() for name in one.items} == set(words[enums[one.key]]), one.name


def test_options_of_both_programs_are_found():
    render = dict(read_settings.cli_options("main"))
    again = dict(read_settings.cli_options("filter_main"))
    assert {"-o,--output", "--set", "--samples", "--pixel", "-q,--quiet", "--seed"} <= set(render)
    assert {"-o,--output", "--set", "--stats", "-q,--quiet"} <= set(again)
    assert "repeatable" in render["--set"]
