# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures with Cycles how lamps light a white plane, for test_cycles.cpp.

blender -b --factory-startup --python measure_cycles.py -- measured_34.json      (or python with the bpy wheel)
python3 measure_cycles.py --header measured_34.json measured_45.json > cycles_measured.h
"""

import json
import math
import os
import sys
import tempfile

POINTS = [(0, 0), (0.7, 0.3), (1.5, -0.8), (-2.5, 1.0)]
LOCATION, ROTATION = (0.3, -0.2, 2.0), (0.3, -0.2, 0.5)


def point(name, radius, **more):
    return dict(name=name, kind="point", energy=100, radius=radius, **more)


def spot(name, radius, angle, blend, **more):
    return dict(name=name, kind="spot", energy=100, radius=radius, angle=angle, blend=blend, **more)


def sun(name, angle, **more):
    return dict(name=name, kind="sun", energy=3, angle=angle, **more)


def area(name, shape, x, y, spread=math.pi, energy=50, **more):
    return dict(name=name, kind="area", energy=energy, shape=shape, size_x=x, size_y=y, spread=spread, **more)


LAMPS = [
    point("point_0", 0),
    point("point_05", 0.5),
    spot("spot_0", 0, 1.6, 0.15),
    spot("spot_03", 0.3, 1.2, 0.5),
    spot("spot_blend1", 0, 2.2, 1.0),
    spot("spot_blend0", 0.05, 2.2, 0.0),
    spot("spot_scaled", 0, 1.2, 0.8, scale=(1.5, 0.7, 1.2)),
    sun("sun_05", 0.00918),
    sun("sun_57", 1.0),
    sun("sun_126", 2.2),
    area("square", "square", 1, 1),
    area("rectangle", "rectangle", 2, 0.5, scale=(0.8, 1.5, 1)),
    area("disk", "disk", 1.2, 1.2),
    area("ellipse", "ellipse", 1.2, 0.6),
    area("square_spread_90", "square", 1, 1, math.pi / 2),
    area("square_spread_40", "square", 1.5, 1.5, math.radians(40)),
    area("disk_spread_60", "disk", 2, 2, math.radians(60)),
    area("square_big", "square", 6, 6),
    area("square_negative", "square", 1, 1, energy=-50),
]


def lamps(is_new):
    if not is_new:
        return LAMPS
    free = ("point_0", "point_05", "spot_0", "spot_03", "sun_05", "sun_57", "square", "disk", "ellipse")
    more = [dict(lamp, name=lamp["name"] + "_free", normalize=False) for lamp in LAMPS if lamp["name"] in free]
    hard = [
        dict(lamp, name=lamp["name"] + "_hard", soft=False)
        for lamp in LAMPS + more
        if lamp["name"][:8] in ("point_05", "spot_03", "spot_03_")
    ]
    return LAMPS + more + hard


def make_scene(bpy):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces = 4096, 0
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type = "BOX"
    try:
        cycles.sampling_pattern = "SOBOL"
    except TypeError:
        cycles.sampling_pattern = "TABULATED_SOBOL"
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    mesh = bpy.data.meshes.new("plane")
    mesh.from_pydata([(-50, -50, 0), (50, -50, 0), (50, 50, 0), (-50, 50, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    diffuse, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs[0].default_value = (1, 1, 1, 1)
    tree.links.new(diffuse.outputs[0], output.inputs[0])
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("plane", mesh))
    camera = bpy.data.cameras.new("camera")
    camera.type, camera.ortho_scale = "ORTHO", 0.01
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(scene.camera)
    return scene


def make_lamp(bpy, scene, lamp):
    data = bpy.data.lights.new("lamp", lamp["kind"].upper())
    data.energy = lamp["energy"]
    if "radius" in lamp:
        data.shadow_soft_size = lamp["radius"]
    if "soft" in lamp:
        data.use_soft_falloff = lamp["soft"]
    if lamp["kind"] == "spot":
        data.spot_size, data.spot_blend = lamp["angle"], lamp["blend"]
    if lamp["kind"] == "sun":
        data.angle = lamp["angle"]
    if lamp["kind"] == "area":
        data.shape, data.size, data.size_y, data.spread = (
            lamp["shape"].upper(),
            lamp["size_x"],
            lamp["size_y"],
            lamp["spread"],
        )
    if "normalize" in lamp:
        data.normalize = lamp["normalize"]
    placed = bpy.data.objects.new("lamp", data)
    placed.location, placed.rotation_euler, placed.scale = LOCATION, ROTATION, lamp.get("scale", (1, 1, 1))
    scene.collection.objects.link(placed)
    return placed


def irradiance(bpy, scene, x, y):
    scene.camera.location = (x, y, 20)
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "point.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        image.colorspace_settings.name = "Non-Color"
        red = list(image.pixels)[0::4]
        bpy.data.images.remove(image)
    return math.pi * sum(red) / len(red)


def measure(path):
    import bpy

    if bpy.app.binary_path == "":
        import addon_utils

        addon_utils.enable("cycles")
    scene = make_scene(bpy)
    rows = []
    for lamp in lamps(bpy.app.version >= (4, 0)):
        placed = make_lamp(bpy, scene, lamp)
        bpy.context.view_layer.update()
        matrix = [placed.matrix_world[r][c] for r in range(3) for c in range(4)]
        soft = getattr(placed.data, "use_soft_falloff", False) and lamp["kind"] in ("point", "spot")
        values = [irradiance(bpy, scene, x, y) for x, y in POINTS]
        rows.append(
            dict(
                lamp,
                version=bpy.app.version_string,
                legacy=bpy.app.version < (4, 0),
                soft=soft,
                matrix=matrix,
                values=values,
            )
        )
        bpy.data.objects.remove(placed)
        print(lamp["name"], values, flush=True)
    with open(path, "w") as file:
        json.dump(rows, file)


def literal(value):
    text = repr(float(f"{value:.7g}"))
    return text + "f" if "." in text or "e" in text else text + ".0f"


def header(paths):
    print("// SPDX-License-Identifier: GPL-3.0-or-later")
    print("// Irradiance of lamps on a plane as Cycles renders it; written by measure_cycles.py.")
    print(
        "#pragma once\n\n// A table, one lamp in four lines.\n// clang-format off\n"
        "\nnamespace cardioid::light_tests {\n"
    )
    print("struct Measured {\n    const char *name, *version, *kind, *shape;\n    bool legacy, soft, normalize;")
    print(
        "    float energy, radius, angle, blend, size_x, size_y, spread;\n    float matrix[12];\n    float irradiance[4];\n};\n"  # noqa: E501
    )
    print(
        "inline constexpr float k_measured_points[4][2] = {"
        + ", ".join(f"{{{literal(x)}, {literal(y)}}}" for x, y in POINTS)
        + "};\n"
    )
    print("inline constexpr Measured k_measured[] = {")
    for path in paths:
        with open(path) as file:
            rows = json.load(file)
        for row in rows:
            flags = ", ".join(
                "true" if flag else "false" for flag in (row["legacy"], row["soft"], row.get("normalize", True))
            )
            fields = ("energy", "radius", "angle", "blend", "size_x", "size_y", "spread")
            numbers = ", ".join(literal(row.get(key, 0)) for key in fields)
            print(
                '    {{"{}", "{}", "{}", "{}", {},'.format(row["name"], row["version"], row["kind"], row.get("shape", ""), flags)  # noqa: E501
            )
            print("     {},\n     {{{}}},".format(numbers, ", ".join(literal(v) for v in row["matrix"])))
            print("     {{{}}}}},".format(", ".join(literal(v) for v in row["values"])))
    print("};\n\n}  // namespace cardioid::light_tests")


if __name__ == "__main__":
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    if arguments[0] == "--header":
        header(arguments[1:])
    else:
        measure(arguments[0])
        # The 4.5 wheel can hang at exit.
        sys.stdout.flush()
        os._exit(0)
