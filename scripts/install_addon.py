# SPDX-License-Identifier: GPL-3.0-or-later
"""Run inside the user's Blender: links the add-on into the user's scripts folder and enables it for good.

Only the add-on is added to the preferences; everything else in them is saved as it was loaded.
"""

import os
import sys
from pathlib import Path

import addon_utils
import bpy

MODULE = "cardioid"


def link(source: Path, addons: Path) -> Path:
    """Points <addons>/cardioid at the checkout; a link that is already there is moved, a real folder is left alone."""
    target = addons / MODULE
    if target.is_symlink():
        if target.resolve() == source:
            return target
        target.unlink()
    elif target.exists():
        sys.exit(f"{target} is an installed copy of the add-on: remove it in Blender's preferences first")
    target.symlink_to(source, target_is_directory=True)
    return target


def enable() -> str | None:
    """Enables the add-on and saves that; returns what went wrong."""
    _, loaded = addon_utils.check(MODULE)
    if loaded and MODULE in bpy.context.preferences.addons:
        return None
    errors: list[str] = []
    addon_utils.modules_refresh()
    module = addon_utils.enable(MODULE, default_set=True, persistent=True, handle_error=lambda e: errors.append(str(e)))
    if module is None:
        return errors[0] if errors else "the add-on did not register"
    bpy.ops.wm.save_userpref()
    return None


def main() -> None:
    source = Path(__file__).resolve().parents[1] / "addon" / MODULE
    addons = Path(bpy.utils.user_resource("SCRIPTS", path="addons", create=True))
    target = link(source, addons)
    if str(addons) not in sys.path:
        sys.path.append(str(addons))
    problem = enable()
    if problem:
        sys.exit(f"cannot enable {target}: {problem}")
    print(f"add-on enabled: {target} -> {os.readlink(target)}")


main()
