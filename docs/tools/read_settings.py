# SPDX-License-Identifier: GPL-3.0-or-later
"""What the code says of settings: the add-on's table and its command line, the engine's structs, their limits and the
options of the command line programs. Sources are read as text or imported without Blender; nothing is built or run."""

from __future__ import annotations

import importlib
import re
import sys
import types
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ADDON = ROOT / "addon" / "cardioid"
ENGINE = ROOT / "engine_cpp"
PANEL_FILES = ("render.py", "noise_filter.py", "caustics.py")

_MEMBER = re.compile(r"^    [\w:<>, ]+?[ >](\w+(?:\{[^}]*\})?(?: = [^,;]+)?(?:, \w+ = [^,;]+)*);\s*(?:///<\s*(.*))?$")
_LIMIT = re.compile(r'repair\(problems, who, "(\w+)", [\w.]+, ([^,)]+), ([^,)]+)[,)]')
_CONSTANT = re.compile(r"constexpr \w+ (k_\w+) = ([^;]+);")
_OPTION = re.compile(r'add_(option|flag)\("([^"]+)",\s*o\.\w+(?:,\s*"([^"]*)")?\)?')


@dataclass(frozen=True)
class EngineSetting:
    """A member of the engine's Settings or FilterSettings. limits: (least, most) as the engine brings them in; None
    where it has none."""

    key: str
    default: str
    note: str
    limits: tuple[str, str] | None


def addon_module(name: str) -> types.ModuleType:
    """A module of the add-on that needs no Blender; the engine behind it is a stand-in that offers every integrator."""
    package = sys.modules.setdefault("cardioid", types.ModuleType("cardioid"))
    package.__path__ = [str(ADDON)]
    table = importlib.import_module("cardioid.settings_table")
    core = types.ModuleType("cardioid.core")
    core.integrators = lambda: list(table.k_integrators)
    package.core = sys.modules.setdefault("cardioid.core", core)
    return importlib.import_module(f"cardioid.{name}")


def panels() -> dict[str, str]:
    """Setting to where it is in Render Properties, such as `Sampling ▸ Advanced`."""
    titles: dict[str, tuple[str, str]] = {}
    drawn: list[tuple[str, str]] = []
    for file in PANEL_FILES:
        chunks = re.split(r"^class (\w+)\(CardioidPanel", (ADDON / "ui" / file).read_text(), flags=re.MULTILINE)
        for name, body in zip(chunks[1::2], chunks[2::2]):
            label = re.search(r'bl_label = "([^"]+)"', body)
            parent = re.search(r'bl_parent_id = "(\w+)"', body)
            titles[name] = (label.group(1), parent.group(1) if parent else "")
            drawn += [(word, name) for word in re.findall(r'"(\w+)"', body)]
    found: dict[str, str] = {}
    for word, name in drawn:
        label, parent = titles[name]
        found.setdefault(word, f"{titles[parent][0]} ▸ {label}" if parent in titles else label)
    return found


def _constants(text: str) -> dict[str, str]:
    return dict(_CONSTANT.findall(text))


def _limits() -> dict[str, tuple[str, str]]:
    text = (ENGINE / "scene/validate_settings.cpp").read_text()
    names = _constants(text) | _constants((ENGINE / "scene/filter_settings.h").read_text())
    return {
        key: (_value(names.get(least, least)), _value(names.get(most, most)))
        for key, least, most in _LIMIT.findall(text)
    }


def _value(text: str) -> str:
    """A C++ value as a reader writes it: no suffixes, no qualifiers; powers of two as numbers."""
    text = text.strip()
    shift = re.fullmatch(r"1 << (\d+)", text)
    if shift:
        return str(1 << int(shift.group(1)))
    text = re.sub(r"^\w+::", "", text)
    return re.sub(r"(?<=[\d.])f$", "", text)


def _members(path: Path, struct: str) -> list[tuple[str, str, str]]:
    """(name, default, note) of each member of a struct whose members have a line of their own."""
    text = path.read_text()
    body = re.search(rf"^struct {struct} {{$(.*?)^}};$", text, re.MULTILINE | re.DOTALL).group(1)
    members, above = [], []
    for line in body.splitlines():
        match = _MEMBER.match(line)
        if match is None:
            comment = re.match(r"^    /// (.*)$", line)
            above = [*above, comment.group(1)] if comment else []
            continue
        note = match.group(2) or " ".join(above)
        above = []
        for one in re.split(r", (?=\w+ = )", match.group(1)):
            name, equal, braced = re.match(r"(\w+)(?: = (.*)|\{(.*)\})?$", one).groups()
            members.append((name, _value(equal or braced or ""), note))
    return members


def engine_settings() -> list[EngineSetting]:
    """Every key of the scene file's settings, in the order of the engine's files; filter settings last."""
    limits = _limits()
    rows = [row for row in _members(ENGINE / "scene/scene_desc.h", "Settings") if row[0] != "filter"]
    rows += _members(ENGINE / "scene/filter_settings.h", "FilterSettings")
    return [EngineSetting(key, default, note, limits.get(key)) for key, default, note in rows]


def known_keys() -> set[str]:
    """The keys that the engine reads from a scene file (fields.h): what the page must have."""
    text = (ENGINE / "scene/fields.h").read_text()
    bodies = re.findall(r"Of<(?:Filter)?Settings> auto& d\) {(.*?)^}", text, re.DOTALL | re.MULTILINE)
    return {key for body in bodies for key in re.findall(r'v\("(\w+)"', body)}


def choices() -> dict[str, list[str]]:
    """Name of an engine enumeration to the words that a scene file uses."""
    text = (ENGINE / "scene/fields.h").read_text()
    found = re.findall(r"struct EnumNames<(\w+)> {\s*static constexpr std::string_view names\[\] = {([^}]*)}", text)
    return {name: re.findall(r'"(\w+)"', words) for name, words in found}


def enum_of() -> dict[str, str]:
    """Settings key to its enumeration's name."""
    text = (ENGINE / "scene/scene_desc.h").read_text() + (ENGINE / "scene/filter_settings.h").read_text()
    return {key: kind for kind in choices() for key in re.findall(rf"^    {kind} (\w+) =", text, re.MULTILINE)}


def cli_options(program: str) -> list[tuple[str, str]]:
    """(option, what it does) of a command line program: `main` (cardioid-render) or `filter_main` (cardioid-filter)."""
    text = (ENGINE / f"apps/cli/{program}.cpp").read_text()
    return [(name, note) for _, name, note in _OPTION.findall(text)]
