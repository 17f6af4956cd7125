# SPDX-License-Identifier: GPL-3.0-or-later
"""Titles of the figures in the tables of results."""

from __future__ import annotations

TITLES = {
    "cpu": "CPU s",
    "cpu_process": "whole process, CPU s",
    "title": "renderer",
    "mark": "mark, CPU s",
    "relmse": "relMSE",
    "relmse_trim": "relMSE, trimmed",
    "relmse_caustic": "relMSE of caustics",
    "relmse_C1": "relMSE of C1",
    "relmse_C1_trim": "relMSE of C1, trimmed",
    "rmse": "RMSE",
    "rmse_caustic": "RMSE of caustics",
    "energy_caustic": "energy of caustics",
    "noise": "noise (RMSE by scatter)",
    "reference": "reference's own share",
    "gathered_per_emitted": "gathered / emitted",
    "emitted_per_s": "emitted a CPU s",
    "stored_per_s": "stored a CPU s",
    "gathered_per_s": "gathered a CPU s",
    "stored_of_emitted": "stored / emitted",
    "cost": "relMSE · CPU s over the default's",
    "cost_caustic": "the same in caustics",
}
"""Other keys are titles already, but for their underscores."""


def columns(formats: dict[str, str]) -> dict[str, list[str]]:
    """Columns of a `result.Table` from formats by key."""
    return {key: [TITLES.get(key, key.replace("_", " ")), form] for key, form in formats.items()}
