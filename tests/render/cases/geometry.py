# SPDX-License-Identifier: GPL-3.0-or-later
"""Instances, normals, several materials, curves and text."""

import math

import bpy
import common
import kit
from kit import case


@case(wheels=True)
def instances(scene):
    """Collections of collections, turned, scaled and mirrored."""
    kit.light_stage()
    inner, outer = bpy.data.collections.new("inner"), bpy.data.collections.new("outer")
    for obj in (
        common.box("brick", (0.12, 0.06, 0.2), kit.diffuse((0.7, 0.3, 0.1), name="brick"), location=(0, 0, 0.2)),
        common.sphere("knob", (0.0, 0.0, 0.47), 0.08, kit.diffuse((0.1, 0.5, 0.6), name="knob"), 24, 12),
    ):
        scene.collection.objects.unlink(obj)
        inner.objects.link(obj)
    for i in range(5):
        empty = bpy.data.objects.new("row", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", inner
        empty.location, empty.rotation_euler = (-0.9 + 0.45 * i, 0, 0), (0, 0, 0.4 * i)
        outer.objects.link(empty)
    for i, scale in enumerate(((1, 1, 1), (1.2, 0.8, 1.5), (-1, 1, 0.7))):
        empty = common.add(None, "block", (0, -0.8 + 0.8 * i, 0))
        empty.instance_type, empty.instance_collection, empty.scale = "COLLECTION", outer, scale


@case()
def smooth_normals(scene):
    """A coarse ball, smooth; beside it the same ball flat."""
    kit.light_stage()
    common.sphere("smooth", (-0.6, 0, 0.55), 0.55, kit.diffuse((0.7, 0.6, 0.5), name="smooth"), 12, 6)
    flat = common.sphere("flat", (0.6, 0, 0.55), 0.55, kit.diffuse((0.7, 0.6, 0.5), name="flat"), 12, 6)
    flat.data.polygons.foreach_set("use_smooth", [False] * len(flat.data.polygons))


@case(wheels=True)
def material_slots(scene):
    """One mesh with three materials, one of them linked to the object."""
    kit.light_stage()
    obj = common.sphere("ball", (0, 0, 0.8), 0.8, kit.diffuse((0.8, 0.1, 0.1), name="a"), 24, 12)
    obj.data.materials.append(kit.diffuse((0.1, 0.7, 0.1), name="b"))
    obj.data.materials.append(None)
    obj.material_slots[2].link = "OBJECT"
    obj.material_slots[2].material = kit.diffuse((0.1, 0.1, 0.8), name="c")
    obj.data.polygons.foreach_set("material_index", [i % 3 for i in range(len(obj.data.polygons))])


@case()
def modifiers_curve_text(scene):
    """A bevelled curve, a text, a subdivided mesh with a bevel."""
    kit.light_stage()
    curve = bpy.data.curves.new("arc", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 0.08
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(1)
    for point, at in zip(spline.bezier_points, ((-1.0, 0.3, 0.1), (1.0, 0.3, 0.1))):
        point.co, point.handle_left, point.handle_right = at, (at[0], at[1], at[2] - 1.2), (at[0], at[1], at[2] + 1.2)
    curve.materials.append(kit.diffuse((0.7, 0.5, 0.1), name="arc"))
    common.add(curve, "arc")
    text = bpy.data.curves.new("word", "FONT")
    text.body, text.extrude, text.size = "Cd", 0.08, 0.8
    text.materials.append(kit.diffuse((0.2, 0.3, 0.7), name="word"))
    common.add(text, "word", (-0.55, -0.4, 0.05), (math.pi / 2, 0, 0))
    common.box("box", (0.3, 0.3, 0.1), kit.diffuse((0.5, 0.5, 0.5), name="box"), location=(0, 0.3, 0.4)).modifiers.new(
        "s", "SUBSURF"
    )


@case()
def holes_and_thin_cards(scene):
    """Thin cards close together and a card seen from behind: ray offsets and two-sided shading."""
    kit.light_stage()
    for i in range(6):
        at = (-0.75 + 0.3 * i, 0.0, 0.6)
        common.quad(
            f"card {i}",
            at,
            (0.02, -0.3 + 0.1 * i, 0),
            (0, 0, 0.55),
            kit.diffuse((0.7, 0.1 + 0.1 * i, 0.2), name=f"card {i}"),
        )
