# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes docs/settings-reference.md from the code.

usage: settings_reference.py [--check]    --check: exit code 1 if the committed page is another one
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import read_settings as read

PAGE = read.ROOT / "docs" / "settings-reference.md"
HEADER = """# Settings reference

<!-- Written by docs/tools/settings_reference.py (./scripts/docs settings). Change the code, not this page. -->

Every setting as the code has it. What each is good for and what it costs is in [Settings](settings.md).

## In Blender

Render Properties, with Cardioid as the render engine; in Python `scene.cardioid.<name>`. A setting with an entry under
*follows* has the value of that Cycles setting (`scene.cycles.<entry>`) until you change it; the arrow beside it lets it
follow again. The default is what it has in a file without Cycles' settings.
"""
BLENDER_OPTIONS = """## Blender's command line

After `--`, for one run; the file is not changed. A wrong value is one sentence and no render.

    blender -b scene.blend -E CARDIOID -f 1 -- --cardioid-samples 256

"""
ENGINE_KEYS = """## Keys of the engine

`--set name=value` of `cardioid-render`, the `settings` of a scene file and of the Python module. Defaults are the
engine's; what the add-on exports has the scene's values. A number out of its range is brought into it, with a warning.

"""
NOT_SHOWN = "Image Editor, or Python"
ENGINE_ONLY = {  # keys without a comment in scene_desc.h and without a setting of the add-on
    "integrator": "which path classes camera paths estimate, and which photons do; the add-on sets `hybrid` for PTPPM",
    "fast_gi": "Cycles' Fast GI; the add-on sets it by the scene's",
    "transparent_film": "the world is not seen by the camera; the add-on sets it by the scene's",
}


def cell(text: object) -> str:
    return str(text).replace("|", "\\|")


def number(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def span(setting) -> str:
    """The range that the property takes, with what its slider offers where that is less."""
    if setting.kind == "enum":
        return ", ".join(f"`{name}`" for name in setting.items)
    if setting.kind == "bool":
        return "on, off"
    options = setting.options
    if "max" not in options:
        return f"{number(options['min'])} or more"
    text = f"{number(options['min'])} to {number(options['max'])}"
    if "soft_min" in options or "soft_max" in options:
        low, high = options.get("soft_min", options["min"]), options.get("soft_max", options["max"])
        text += f" (slider: {number(low)} to {number(high)})"
    return text


def default(setting) -> str:
    if setting.kind == "bool":
        return "on" if setting.default else "off"
    return f"`{setting.default}`" if setting.kind == "enum" else number(setting.default)


def table(head: list[str], rows: list[list[object]]) -> str:
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join([*lines, *("| " + " | ".join(cell(c) for c in row) + " |" for row in rows)]) + "\n"


def integrators_part(settings_table) -> str:
    rows = []
    for name, (label, text, _, _) in settings_table.k_integrators.items():
        mark = " (default)" if name == "PTPPM" else ""
        rows.append([f"**Integrator** `integrator` = `{name}`{mark}", f"**{label}.** {text}"])
    return table(["Sampling", "what it is"], rows)


def choices_part(settings_table) -> str:
    rows = []
    for one in (one for one in settings_table.k_settings if one.kind == "enum"):
        rows += [
            [f"{one.label} `{one.name}`", f"**{label}** `{name}`", text] for name, (label, text, _) in one.items.items()
        ]
    return "### Choices\n\n" + table(["setting", "choice", "what it is"], rows)


def setting_row(one) -> list[str]:
    follows = f"`{one.cycles}`" if one.cycles else ""
    note = one.description + ("" if one.key else " †")
    return [f"**{one.label}** `{one.name}`", default(one), span(one), follows, note]


def blender_part() -> str:
    settings_table = read.addon_module("settings_table")
    panels, groups = read.panels(), {}
    for one in settings_table.k_settings:
        groups.setdefault(panels.get(one.name, NOT_SHOWN), []).append(setting_row(one))
    head = ["setting", "default", "range", "follows", "what it does"]
    parts = [integrators_part(settings_table)]
    parts += [f"### {panel}\n\n{table(head, rows)}" for panel, rows in groups.items()]
    parts.append("† used by the add-on alone: the engine has no such setting.\n")
    return "\n".join([*parts, choices_part(settings_table)])


def blender_options_part() -> str:
    arguments = read.addon_module("cli_args").k_arguments
    rows = [[f"`{option}" + (f" {metavar}`" if metavar else "`"), text] for option, _, _, metavar, text in arguments]
    return BLENDER_OPTIONS + table(["option", "what it does"], rows)


def engine_span(limits: tuple[str, str] | None) -> str:
    if limits is None:
        return ""
    return f"{limits[0]} or more" if limits[1] == "1e18" else f"{limits[0]} to {limits[1]}"


def engine_part() -> str:
    owners = {one.key: one for one in read.addon_module("settings_table").k_settings if one.key}
    enums, words = read.enum_of(), read.choices()
    rows = []
    for one in read.engine_settings():
        if one.key in enums:
            values = ", ".join(f"`{word}`" for word in words[enums[one.key]])
        else:
            values = engine_span(one.limits)
        owner = owners.get(one.key)
        note = one.note or (owner.description if owner else ENGINE_ONLY[one.key])
        rows.append(
            [
                f"`{one.key}`",
                f"`{one.default}`" if one.default else "",
                values,
                f"`{owner.name}`" if owner else "",
                note,
            ]
        )
    return ENGINE_KEYS + table(["key", "default", "values", "in Blender", "what it is"], rows)


def programs_part() -> str:
    parts = ["## Command line programs\n"]
    for program, title in (("main", "cardioid-render SCENE"), ("filter_main", "cardioid-filter FILM")):
        rows = [[f"`{name}`", note or "number of the noise pattern"] for name, note in read.cli_options(program)]
        parts.append(f"### `{title}`\n\n" + table(["option", "what it does"], rows))
    return "\n".join(parts)


def page() -> str:
    """The whole page; the same text for the same code."""
    return "\n".join([HEADER, blender_part(), blender_options_part(), engine_part(), programs_part()])


def main(arguments: list[str]) -> int:
    text = page()
    if arguments == ["--check"]:
        if not PAGE.exists() or PAGE.read_text() != text:
            print(f"{PAGE.name} is not what the code says now: run ./scripts/docs settings")
            return 1
        return 0
    PAGE.write_text(text)
    print(PAGE)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
