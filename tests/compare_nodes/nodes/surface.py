# SPDX-License-Identifier: GPL-3.0-or-later
"""What a node can know of the surface, the object, the ray and the camera; normals and bumps."""

from __future__ import annotations

from itertools import product

import bpy
from registry import case, row
from tile import AROUND, COL, P1, U1, V1, VEC, U, V, assign, combined, op, scaled, vector_op

EXACT_PLACE = 1.0
"""Floor of values that follow the place of the sample (0.005 pixels are 0.0002 metres)."""

for stage in ("flat", "facets", "back", "coarse", "placed"):
    for output in ("Position", "Normal", "Tangent", "True Normal", "Incoming", "Backfacing"):
        row(f"geometry/{output}/{stage}", "NewGeometry", None, output, stage=stage, floor=EXACT_PLACE)
    row(f"geometry/Random Per Island/{stage}", "NewGeometry", None, "Random Per Island", stage=stage)
for stage in ("coarse", "placed"):
    row(f"geometry/Pointiness/{stage}", "NewGeometry", None, "Pointiness", stage=stage, floor=0.3)
row("geometry/Parametric/coarse", "NewGeometry", None, "Parametric", stage="coarse", floor=1.0)

for output in ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection"):
    for stage in ("flat", "facets", "placed"):
        row(f"texture coordinate/{output}/{stage}", "TexCoord", None, output, stage=stage, floor=EXACT_PLACE)


def of_camera(node) -> None:
    if "Far Object" not in bpy.data.objects:
        item = bpy.data.objects.new("Far Object", None)
        item.location, item.rotation_euler, item.scale = (3.0, -2.0, 1.0), (0.4, 0.2, -0.6), (1.5, 1.0, 0.8)
        bpy.context.scene.collection.objects.link(item)
        bpy.context.view_layer.update()
    node.object = bpy.data.objects["Far Object"]


row("texture coordinate/Object/of another", "TexCoord", None, "Object", setup=of_camera, stage="placed",
    floor=EXACT_PLACE)  # fmt: skip
row("texture coordinate/from instancer", "TexCoord", None, "Generated", from_instancer=True, floor=EXACT_PLACE)
row("texture coordinate/UV from instancer", "TexCoord", None, "UV", from_instancer=True, floor=EXACT_PLACE)

for name in ("Wide", "Smooth", "", "Missing"):
    row(f"uv map/{name or 'unnamed'}", "UVMap", uv_map=name, floor=EXACT_PLACE if name == "Smooth" else 0.01)
row("uv map/from instancer", "UVMap", uv_map="Wide", from_instancer=True)

for output in ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random"):
    row(f"object info/{output}", "ObjectInfo", None, output, stage="placed")
for output in ("Index", "Random", "Age", "Lifetime", "Location", "Size", "Velocity", "Angular Velocity"):
    row(f"particle info/{output}", "ParticleInfo", None, output)
    row(f"particle info/{output}/of particles", "ParticleInfo", None, output, stage="particles")
for stage in ("instances", "particles"):
    for output in ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random"):
        row(f"object info/{output}/{stage}", "ObjectInfo", None, output, stage=stage)
    for output in ("Generated", "UV", "Object"):
        row(f"texture coordinate/{output}/from instancer/{stage}", "TexCoord", None, output, stage=stage,
            from_instancer=True, floor=EXACT_PLACE)  # fmt: skip
        row(f"texture coordinate/{output}/{stage}", "TexCoord", None, output, stage=stage, floor=EXACT_PLACE)
    for kind in ("OBJECT", "INSTANCER"):
        row(f"attribute/{kind.lower()}/my_number/{stage}", "Attribute", None, "Fac", attribute_type=kind,
            attribute_name="my_number", stage=stage)  # fmt: skip
    row(f"geometry/Random Per Island/{stage}", "NewGeometry", None, "Random Per Island", stage=stage)
    row(f"uv map/from instancer/{stage}", "UVMap", stage=stage, from_instancer=True, floor=EXACT_PLACE)
for output in ("Is Strand", "Intercept", "Length", "Thickness", "Tangent Normal", "Random"):
    row(f"hair info/{output}", "HairInfo", None, output, stage="facets")
for output in ("Position", "Radius", "Random"):
    row(f"point info/{output}", "PointInfo", None, output, stage="placed", floor=EXACT_PLACE)
for output in ("Color", "Density", "Flame", "Temperature"):
    row(f"volume info/{output}", "VolumeInfo", None, output)
for output in ("View Vector", "View Z Depth", "View Distance"):
    for stage in ("flat", "placed"):
        row(f"camera data/{output}/{stage}", "CameraData", None, output, stage=stage, floor=EXACT_PLACE)

for output in ("Camera", "Window", "Reflection"):
    row(f"texture coordinate/{output}/perspective", "TexCoord", None, output, perspective=True, floor=EXACT_PLACE)
for output in ("View Vector", "View Z Depth", "View Distance"):
    row(f"camera data/{output}/perspective", "CameraData", None, output, perspective=True, floor=EXACT_PLACE)
row("geometry/Incoming/perspective", "NewGeometry", None, "Incoming", perspective=True, floor=EXACT_PLACE)
row("light path/Ray Length/perspective", "LightPath", None, "Ray Length", perspective=True, floor=EXACT_PLACE)
row("fresnel/perspective", "Fresnel", {"IOR": 1.45}, perspective=True)
row("layer weight/perspective", "LayerWeight", {"Blend": 0.4}, "Facing", perspective=True)
row("bump/perspective", "Bump", {"Height": (lambda tile: waves(tile)), "Distance": 0.08}, perspective=True,
    floor=EXACT_PLACE)  # fmt: skip

for stage in ("flat", "through", "glass", "mirror"):
    for output in ("Is Camera Ray", "Is Shadow Ray", "Is Diffuse Ray", "Is Glossy Ray", "Is Singular Ray",
                   "Is Reflection Ray", "Is Transmission Ray", "Is Volume Scatter Ray", "Ray Length", "Ray Depth",
                   "Diffuse Depth", "Glossy Depth", "Transparent Depth", "Transmission Depth",
                   "Portal Depth"):  # fmt: skip
        row(f"light path/{output}/{stage}", "LightPath", None, output, stage=stage, floor=0.5)
for output in ("Normal", "Backfacing", "Incoming"):
    for stage in ("through", "glass", "mirror"):
        row(f"geometry/{output}/{stage}", "NewGeometry", None, output, stage=stage, floor=EXACT_PLACE)
row("camera data/View Distance/mirror", "CameraData", None, "View Distance", stage="mirror", floor=EXACT_PLACE)
row("camera data/View Vector/mirror", "CameraData", None, "View Vector", stage="mirror", floor=EXACT_PLACE)

ATTRIBUTES = ("Number", "Whole", "Flag", "Place", "Paint", "Bytes", "Flat", "Wide", "Missing")
for name, output in product(ATTRIBUTES, ("Color", "Fac")):
    row(f"attribute/{name}/{output}", "Attribute", None, output, attribute_name=name)
for name in ("Place", "Paint", "Bytes"):
    row(f"attribute/{name}/Vector", "Attribute", None, "Vector", attribute_name=name)
    row(f"attribute/{name}/Alpha", "Attribute", None, "Alpha", attribute_name=name)
for name in ("position", "UVMap", "material_index", "geom:generated"):
    row(f"attribute/built-in {name}", "Attribute", None, "Vector", attribute_name=name, floor=EXACT_PLACE)
for name in ("my_number", "my_color", "my_whole", "of_mesh", "location", "pass_index", "color", "missing",
             "matrix_world"):  # fmt: skip
    for output in ("Color", "Fac", "Alpha"):
        row(f"attribute/object/{name}/{output}", "Attribute", None, output, attribute_type="OBJECT",
            attribute_name=name, stage="placed")  # fmt: skip
row("attribute/instancer/my_number", "Attribute", None, "Fac", attribute_type="INSTANCER", attribute_name="my_number")
for name in ("of_scene", "of_world", "of_layer", "render.resolution_percentage", "frame_current", "missing"):
    row(f"attribute/view layer/{name}", "Attribute", None, "Color", attribute_type="VIEW_LAYER", attribute_name=name)
for name in ("Paint", "Bytes", "", "Missing"):
    for output in ("Color", "Alpha"):
        row(f"color attribute/{name or 'unnamed'}/{output}", "VertexColor", None, output, layer_name=name)

for stage in ("facets", "back", "dome"):
    row(f"fresnel/{stage}", "Fresnel", {"IOR": 1.45}, stage=stage)
    row(f"fresnel/linked/{stage}", "Fresnel", {"IOR": scaled(P1, 0.3, 2.5)}, stage=stage)
    for output in ("Fresnel", "Facing"):
        row(f"layer weight/{output}/{stage}", "LayerWeight", {"Blend": 0.3}, output, stage=stage, floor=0.1)
        row(f"layer weight/{output}/linked/{stage}", "LayerWeight", {"Blend": scaled(P1, -0.1, 1.1)}, output,
            stage=stage, floor=0.1)  # fmt: skip
row("fresnel/normal", "Fresnel", {"IOR": 1.33, "Normal": AROUND})
row("fresnel/constant", "Fresnel", {"IOR": 1.6})
row("layer weight/normal", "LayerWeight", {"Blend": 0.6, "Normal": AROUND}, "Facing")
row("layer weight/normal fresnel", "LayerWeight", {"Blend": 0.6, "Normal": AROUND}, "Fresnel")

for size in (0.01, 0.05):
    row(f"wireframe/{size}", "Wireframe", {"Size": size}, stage="coarse")
row("wireframe/pixels", "Wireframe", {"Size": 2.0}, stage="coarse", use_pixel_size=True)

for axis, stage in product("XYZ", ("placed", "facets")):
    row(f"tangent/radial {axis}/{stage}", "Tangent", stage=stage, direction_type="RADIAL", axis=axis, floor=EXACT_PLACE)
for name, stage in product(("Smooth", "", "UVMap", "Missing"), ("coarse", "dome", "placed", "facets")):
    row(f"tangent/uv {name or 'unnamed'}/{stage}", "Tangent", stage=stage, direction_type="UV_MAP", uv_map=name,
        floor=EXACT_PLACE)  # fmt: skip

BLUE = combined(scaled(U1, 0.1, 0.9), scaled(V1, 0.15, 0.85), scaled(P1, 0.6, 1.0))
for space, stage in product(("TANGENT", "OBJECT", "WORLD", "BLENDER_OBJECT", "BLENDER_WORLD"), ("dome", "placed")):
    row(f"normal map/{space}/{stage}", "NormalMap", {"Strength": 1.0, "Color": BLUE}, stage=stage, space=space,
        floor=EXACT_PLACE, **({"uv_map": "Smooth"} if space == "TANGENT" else {}))  # fmt: skip
for strength in (0.0, 0.4, 2.0):
    row(f"normal map/strength {strength}", "NormalMap", {"Strength": strength, "Color": BLUE}, stage="dome",
        uv_map="Smooth", floor=EXACT_PLACE)  # fmt: skip
row("normal map/object strength", "NormalMap", {"Strength": 0.4, "Color": BLUE}, stage="placed", space="OBJECT",
    floor=EXACT_PLACE)  # fmt: skip
row("normal map/unnamed", "NormalMap", {"Color": BLUE}, stage="dome", floor=EXACT_PLACE)
row("normal map/facets", "NormalMap", {"Color": BLUE}, stage="facets", uv_map="Smooth", floor=EXACT_PLACE)
row("normal map/back", "NormalMap", {"Color": BLUE}, stage="back", uv_map="Smooth", floor=EXACT_PLACE)
row("normal map/constant", "NormalMap", {"Color": (0.6, 0.3, 0.9)}, stage="coarse", uv_map="Smooth", floor=EXACT_PLACE)


def waves(tile):
    """A smooth height that changes everywhere."""
    at = tile.known("waves uv", lambda: tile.node("UVMap", uv_map="Smooth").outputs[0])
    split = tile.node("SeparateXYZ", {0: at})
    across = tile.math("SINE", tile.math("MULTIPLY", split.outputs[0], 9.0))
    return tile.math("MULTIPLY", across, tile.math("COSINE", tile.math("MULTIPLY", split.outputs[1], 7.0)))


def hills(tile):
    """The same kind of height by position."""
    place = tile.node("SeparateXYZ", {0: tile.node("TexCoord").outputs["Object"]})
    across = tile.math("SINE", tile.math("MULTIPLY", place.outputs[0], 9.0))
    return tile.math("MULTIPLY", across, tile.math("COSINE", tile.math("MULTIPLY", place.outputs[1], 7.0)))


BUMPY = {"Height": waves, "Distance": 0.08}
for stage in ("flat", "dome", "placed", "back"):
    row(f"bump/{stage}", "Bump", {**BUMPY, "Strength": 0.8}, stage=stage, floor=EXACT_PLACE)
row("bump/invert", "Bump", {**BUMPY, "Strength": 1.0}, stage="dome", invert=True, floor=EXACT_PLACE)
row("bump/linked", "Bump", {"Height": waves, "Strength": scaled(P1, 0.0, 1.0), "Distance": scaled(U1, -0.1, 0.1)},
    stage="dome", floor=EXACT_PLACE)  # fmt: skip
row("bump/normal", "Bump", {**BUMPY, "Normal": vector_op("NORMALIZE", (0.3, 0.2, 0.9))}, stage="dome",
    floor=EXACT_PLACE)  # fmt: skip
row("bump/filter width", "Bump", {**BUMPY, "Filter Width": 1.0}, stage="dome", floor=EXACT_PLACE)
for stage in ("back", "dome"):
    row(f"bump/of position/{stage}", "Bump", {"Height": hills, "Distance": 0.08}, stage=stage, floor=EXACT_PLACE)
row("bump/no height", "Bump", {"Strength": 1.0}, stage="dome", floor=EXACT_PLACE)


@case("bump/two in a row", "Bump", stage="dome", floor=EXACT_PLACE)
def two_bumps(tile):
    first = tile.node("Bump", {**BUMPY, "Strength": 0.5}).outputs[0]
    height = tile.math("MULTIPLY", tile.known("other", lambda: waves(tile)), 0.5)
    return tile.node("Bump", {"Height": height, "Distance": 0.05, "Normal": first}).outputs[0]


@case("bump/of noise", "Bump", stage="dome", floor=EXACT_PLACE)
def noise_bump(tile):
    at = tile.node("TexCoord").outputs["Object"]
    height = tile.node("TexNoise", {"Vector": at, "Scale": 4.0, "Detail": 0.0}).outputs[0]
    return tile.node("Bump", {"Height": height, "Distance": 0.3, "Strength": 0.7}).outputs[0]


def displaced(name: str, kind: str, inputs: dict, stage: str, method: str, shown: str, **properties) -> None:
    """A case of the material's displacement; shows an output of Geometry."""

    @case(name, kind, stage=stage, floor=EXACT_PLACE)
    def build(tile):
        node = tile.node(kind, inputs, **properties)
        tile.displace(node.outputs[0], method)
        return tile.node("NewGeometry").outputs[shown]


for space, stage in product(("OBJECT", "WORLD"), ("dome", "placed")):
    displaced(f"displacement/{space}/{stage}", "Displacement", {"Height": waves, "Midlevel": 0.2, "Scale": 0.08}, stage,
              "BUMP", "Normal", space=space)  # fmt: skip
displaced("displacement/own normal", "Displacement",
          {"Height": waves, "Scale": 0.05, "Normal": vector_op("NORMALIZE", (0.2, 0.1, 1.0))}, "dome", "BUMP", "Normal")
for space, stage in product(("TANGENT", "OBJECT", "WORLD"), ("dome", "placed")):
    away = combined(op("MULTIPLY", waves, 0.3), 0.0, waves)
    displaced(f"vector displacement/{space}/{stage}", "VectorDisplacement", {"Vector": away, "Scale": 0.05}, stage,
              "BUMP", "Normal", space=space)  # fmt: skip
for method, shown in product(("DISPLACEMENT", "BOTH"), ("Position", "Normal", "True Normal")):
    displaced(f"displacement/{method}/{shown}", "Displacement", {"Height": waves, "Midlevel": 0.0, "Scale": 0.05},
              "sheet", method, shown)  # fmt: skip
displaced("vector displacement/DISPLACEMENT", "VectorDisplacement",
          {"Vector": combined(0.0, 0.0, waves), "Scale": 0.05}, "sheet", "DISPLACEMENT", "Position", space="OBJECT")


def custom(output: str, inside: bool, local: bool, distance: float) -> None:
    row(f"ambient occlusion/{output} {'in' if inside else 'out'}side{', local' if local else ''} {distance:g}",
        "AmbientOcclusion", {"Color": COL, "Distance": distance}, output, stage="roof", noisy=True, inside=inside,
        only_local=local)  # fmt: skip


for output, inside, local in product(("Color", "AO"), (False, True), (False, True)):
    custom(output, inside, local, 0.3)
custom("AO", False, True, 0.0)
row("ambient occlusion/normal", "AmbientOcclusion",
    {"Distance": 0.5, "Normal": vector_op("NORMALIZE", (0.5, 0.0, 1.0))}, "AO", stage="roof", noisy=True,
    only_local=True)  # fmt: skip
row("ambient occlusion/linked", "AmbientOcclusion", {"Distance": scaled(V1, 0.0, 0.6), "Color": COL}, "Color",
    stage="roof", noisy=True, only_local=True)  # fmt: skip


@case("bevel/upward", "Bevel", stage="roof", noisy=True)
def bevel_upward(tile):
    """The share of the bevelled normal that points up: 1 on the bevelled ridge."""
    node = tile.node("Bevel", {"Radius": 0.15})
    assign(node, "samples", 8)
    return tile.node("VectorMath", {0: node.outputs[0], 1: (0.0, 0.0, 1.0)}, operation="DOT_PRODUCT").outputs["Value"]


@case("bevel/sideways", "Bevel", stage="roof", noisy=True)
def bevel_sideways(tile):
    node = tile.node("Bevel", {"Radius": 0.15})
    return tile.vector("ABSOLUTE", node.outputs[0])


row("light path/and fresnel", "Fresnel", {"IOR": op("ADD", 1.2, U1), "Normal": AROUND}, stage="mirror")
row("geometry/vector sum", "VectorMath", {0: VEC, 1: combined(U, V, 0.5)}, None, operation="ADD", stage="mirror")
