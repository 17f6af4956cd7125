# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels share."""

from __future__ import annotations

from collections.abc import Iterable

import bpy
from bpy_extras.node_utils import find_node_input

k_engine = "CARDIOID"
k_not_copied = {"__dict__", "__weakref__", "bl_rna", "is_registered"}


class CardioidPanel:
    """Base of Cardioid's panels in the Properties editor; shown while Cardioid is the render engine."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"

    @classmethod
    def poll(cls, context):
        return context.engine == k_engine


def split(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    """The layout with labels at the left, as in all of Blender's settings."""
    layout.use_property_split = True
    layout.use_property_decorate = False
    return layout


def setting(layout: bpy.types.UILayout, settings, name: str, text: str | None = None) -> None:
    """A render setting; once it no longer follows Cycles, with a button that makes it follow again."""
    row = layout.row(align=True)
    words = {} if text is None else {"text": text}
    row.prop(settings, name, **words)
    follow_button(row, settings, name)


def follow_button(row: bpy.types.UILayout, settings, name: str) -> None:
    if settings.is_own(name):
        row.operator("cardioid.follow_cycles", text="", icon="LOOP_BACK", emboss=False).setting = name


def existing(layout: bpy.types.UILayout, owner, name: str, **keywords) -> None:
    """A property that not every version of Blender has."""
    if owner is not None and hasattr(owner, name):
        layout.prop(owner, name, **keywords)


def wrapped(layout: bpy.types.UILayout, text: str, icon: str = "NONE", width: int = 48) -> None:
    """A sentence over as many lines as it needs."""
    line, first = "", True
    column = layout.column(align=True)
    for word in [*text.split(), None]:
        if word is None or len(line) + len(word) + 1 > width:
            column.label(text=line, icon=icon if first else ("BLANK1" if icon != "NONE" else "NONE"))
            line, first = word or "", False
        else:
            line = f"{line} {word}".strip()


def node_input(layout: bpy.types.UILayout, owner, input_name: str) -> bool:
    """The node tree behind one input of the output node, as a tree of sockets. False: `owner` has no nodes yet."""
    if not getattr(owner, "use_nodes", True) or owner.node_tree is None:
        layout.operator("cardioid.use_nodes", icon="NODETREE")
        return False
    # Files made for Cycles may have an output node of Cycles' own
    output = owner.node_tree.get_output_node("CYCLES")
    socket = find_node_input(output, input_name) if output else None
    if socket is not None:
        layout.template_node_view(owner.node_tree, output, socket)
    else:
        layout.label(text="Incompatible output node" if output else "No output node")
    return True


def register_all(classes: Iterable[type]) -> None:
    for one in classes:
        bpy.utils.register_class(one)


def unregister_all(classes: Iterable[type]) -> None:
    for one in reversed(tuple(classes)):
        bpy.utils.unregister_class(one)


def renamed_copy(panel: type, prefix: str, **changes) -> type:
    """A panel with the same contents under another name, below the parent with that prefix. Blender wants a class of
    its own for each; inheriting from a registered panel does not work."""
    members = {name: value for name, value in panel.__dict__.items() if name not in k_not_copied}
    members.update(changes)
    if "bl_parent_id" in members:
        members["bl_parent_id"] = prefix + members["bl_parent_id"]
    return type(prefix + panel.__name__, panel.__bases__, members)


def node_editor_copy(panel: type) -> type:
    """The same panel for the node editor's sidebar, as Cycles has it."""
    return renamed_copy(panel, "NODE_", bl_space_type="NODE_EDITOR", bl_region_type="UI", bl_category="Options")
