# SPDX-License-Identifier: GPL-3.0-or-later
"""The colour configuration that images are converted by, in a form that the engine's OpenColorIO reads.

Blender 5's own configuration asks for a newer OpenColorIO than many systems have, though only in its displays and
views, which are not needed here; and its working space is a setting of the .blend file that overrules the
configuration's role. In both cases the engine is given a copy with the colour spaces alone.
"""

from __future__ import annotations

import os
import re
from collections.abc import Set

import bpy

_STANDARD = {"sRGB", "Linear", "Linear Rec.709", "Linear BT.709", "Non-Color", "Raw", "scene_linear"}
_READABLE = (2, 1)  # the oldest OpenColorIO that the engine is built with
_DROPPED = ("displays", "looks", "active_displays", "active_views", "inactive_colorspaces", "viewing_rules",
            "file_rules", "shared_views", "virtual_display")
_UNKNOWN = r"^[ \t]+(interop_id|amf_transform_ids|icc_profile_name|interchange):.*\n"  # attributes of newer versions


_NEWER_STYLES = r"style:[^}\n]*ACES-OUTPUT[^}\n]*_2\.0"  # built-in transforms


def working_space() -> str | None:
    """The scene-linear space of this file where Blender has such a setting (5.0); None: as the configuration says."""
    return getattr(getattr(bpy.data, "colorspace", None), "working_space", None)


def usable(config: str, spaces: Set[str], folder: str) -> str:
    """`config`, or a simpler copy in `folder` where the engine could not use it as it is for images in `spaces`."""
    if not config or not os.path.isfile(config):
        return config
    with open(config, encoding="utf-8", errors="replace") as file:
        text = file.read()
    space = working_space()
    other_space = space is not None and role(text, "scene_linear") not in (space, None)
    if not other_space and (spaces <= _STANDARD or version(text) <= _READABLE):
        return config
    target = os.path.join(folder, "cardioid.ocio")
    with open(target, "w", encoding="utf-8") as file:
        file.write(simplified(text, os.path.dirname(config), space if other_space else None))
    return target


def version(text: str) -> tuple[int, int]:
    found = re.search(r"^ocio_profile_version:\s*(\d+)(?:\.(\d+))?", text, re.MULTILINE)
    return (int(found[1]), int(found[2] or 0)) if found else (1, 0)


def role(text: str, name: str) -> str | None:
    found = re.search(rf"^[ \t]+{name}:[ \t]*[\"']?([^\n\"'#]+)", text, re.MULTILINE)
    return found[1].strip() if found else None


def simplified(text: str, folder: str, space: str | None) -> str:
    """Roles and spaces of a configuration in `folder`, at a version that old libraries read; `space` becomes the
    scene-linear role. The view transforms stay, since display spaces are reached through them."""
    blocks = re.split(r"^(?=[A-Za-z_]\w*:)", text, flags=re.MULTILINE)
    kept = [b for b in blocks if b.partition(":")[0] not in (*_DROPPED, "search_path", "ocio_profile_version")]
    entries = re.split(r"^(?=[ \t]*- !<(?:ColorSpace|ViewTransform)>|[A-Za-z_]\w*:)", "".join(kept), flags=re.MULTILINE)
    body = re.sub(_UNKNOWN, "", "".join(e for e in entries if not re.search(_NEWER_STYLES, e)), flags=re.MULTILINE)
    if space:
        body = re.sub(r"^([ \t]+scene_linear:[ \t]*).*$", lambda m: m[1] + space, body, flags=re.MULTILINE)
    major, minor = min(version(text), _READABLE)
    paths = "".join(f'  - "{path}"\n' for path in _search_path(text, folder))
    # A configuration without a display is invalid.
    display = f"displays:\n  none:\n    - !<View> {{name: Raw, colorspace: {role(text, 'data') or 'Non-Color'}}}\n"
    return f"ocio_profile_version: {major}.{minor}\nsearch_path:\n{paths}\n{body.rstrip()}\n\n{display}"


def _search_path(text: str, folder: str) -> list[str]:
    found = re.search(r"^search_path:([^\n]*)\n((?:[ \t]+-[^\n]*\n)*)", text, re.MULTILINE)
    if not found:
        return [folder]
    names = found[1].strip(" \t\"'").split(":") + [line.strip(" \t-\"'") for line in found[2].splitlines()]
    return [os.path.join(folder, name) for name in names if name]
