# SPDX-License-Identifier: GPL-3.0-or-later
"""Image and Environment textures, skies and IES files."""

from __future__ import annotations

import os
from itertools import product

import bpy
import pictures
from registry import case
from tile import AROUND, P1, U1, V1, VEC, U, V, assign, combined, scaled

ABOUT = combined(scaled(U1, -0.81, 1.63), scaled(V1, -0.71, 1.93), P1)
"""Coordinates around the picture, on both sides of it."""
INSIDE = combined(scaled(U1, 0.06, 0.93), scaled(V1, 0.07, 0.94), 0.0)


def textured(name: str, make, at=ABOUT, output: str = "Color", *, stage: str = "flat", tolerance: float = 1e-3,
             setup=None, **properties) -> None:  # fmt: skip
    """A case of the Image Texture; `make(tile)` gives the image."""

    @case(name, "TexImage", stage=stage, tolerance=tolerance)
    def build(tile):
        node = tile.node("TexImage", {"Vector": at} if at else None, image=make(tile), **properties)
        if setup:
            setup(node)
        return node.outputs[output]


for way, extension in product(("Linear", "Closest", "Cubic", "Smart"), ("REPEAT", "EXTEND", "CLIP", "MIRROR")):
    for output in ("Color", "Alpha"):
        textured(f"image/{way}/{extension}/{output}", pictures.opaque if output == "Color" else pictures.png,
                 output=output, interpolation=way, extension=extension)  # fmt: skip
for projection, blend in (("BOX", 0.0), ("BOX", 0.3), ("BOX", 1.0), ("SPHERE", 0.0), ("TUBE", 0.0)):
    for stage in ("facets", "placed", "flat"):
        textured(f"image/{projection} {blend}/{stage}", pictures.opaque, VEC, stage=stage, projection=projection,
                 projection_blend=blend)  # fmt: skip
textured("image/no vector", pictures.opaque, None)
for way in ("Linear", "Closest", "Cubic"):
    textured(f"image/{way}/with alpha", pictures.png, interpolation=way)
for mode, output in product(("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"), ("Color", "Alpha")):
    textured(f"image/alpha/{mode}/{output}", lambda tile, m=mode: pictures.png(tile, "", m), INSIDE, output)
    textured(f"image/alpha exr/{mode}/{output}", lambda tile, m=mode: straight_exr(tile, m), INSIDE, output)


def straight_exr(tile, mode: str):
    path = pictures.write(os.path.join(tile.folder, "colourful.exr"), pictures.colourful(), "OPEN_EXR")
    return pictures.load(path, "", mode)


SPACES = ("sRGB", "Non-Color", "Raw", "Linear", "Linear ACES", "Linear ACEScg", "XYZ", "Filmic Log", "Filmic sRGB",
          "ACES2065-1", "ACEScg", "AgX Base sRGB", "AgX Log", "Display P3", "Linear CIE-XYZ D65", "Linear CIE-XYZ E",
          "Linear DCI-P3 D65", "Linear FilmLight E-Gamut", "Linear Rec.2020", "Linear Rec.709", "Rec.1886",
          "Rec.2020", "ACEScc", "ACEScct", "scene_linear", "Khronos PBR Neutral sRGB", "Rec.2100-PQ")  # fmt: skip
for space in SPACES:
    textured(f"image/space/{space}", lambda tile, s=space: pictures.opaque(tile, s), INSIDE)
    textured(f"image/space with alpha/{space}", lambda tile, s=space: pictures.png(tile, s), INSIDE)
    textured(f"image/space exr/{space}", lambda tile, s=space: pictures.exr(tile, s), INSIDE)

FILES = (("PNG", "png", "RGB", "16"), ("PNG", "png", "BW", "8"), ("PNG", "png", "BW", "16"),
         ("PNG", "png", "RGBA", "16"),
         ("JPEG", "jpg", "RGB", "8"), ("JPEG", "jpg", "BW", "8"), ("TIFF", "tif", "RGBA", "16"),
         ("TIFF", "tif", "RGB", "8"), ("TARGA", "tga", "RGBA", "8"), ("BMP", "bmp", "RGB", "8"),
         ("OPEN_EXR", "exr", "RGBA", "16"), ("OPEN_EXR", "exr", "RGB", "32"), ("OPEN_EXR", "exr", "BW", "16"),
         ("HDR", "hdr", "RGB", "32"), ("WEBP", "webp", "RGBA", "8"),
         ("DPX", "dpx", "RGB", "16"))  # fmt: skip


def of_kind(tile, kind: str, end: str, mode: str, depth: str):
    path = os.path.join(tile.folder, f"{kind}-{mode}-{depth}.{end}")
    depth = "" if depth == "8" else depth
    return pictures.load(pictures.write(path, pictures.colourful(), kind, mode=mode, depth=depth))


for kind, end, mode, depth in FILES:
    for output in ("Color", "Alpha"):
        textured(f"image/file/{kind} {mode} {depth}/{output}",
                 lambda tile, f=(kind, end, mode, depth): of_kind(tile, *f), INSIDE, output)  # fmt: skip


def generated(tile, kind: str, is_float: bool):
    data = bpy.data.images.new("generated", 16, 16, float_buffer=is_float)
    assign(data, "generated_type", kind)
    data.generated_color = (0.8, 0.3, 0.1, 0.6)
    return data


def painted(tile, is_float: bool, packed: bool):
    pixels = pictures.bright(8, 8) if is_float else pictures.colourful(8, 8)
    data = bpy.data.images.new("painted", 8, 8, alpha=True, float_buffer=is_float)
    data.pixels.foreach_set(pixels.astype("f4").ravel())
    data.update()
    if packed:
        data.pack()
    return data


for kind, is_float in product(("BLANK", "UV_GRID", "COLOR_GRID"), (False, True)):
    textured(f"image/generated/{kind}{' float' if is_float else ''}",
             lambda tile, k=kind, f=is_float: generated(tile, k, f), INSIDE)  # fmt: skip
for is_float, packed in product((False, True), (False, True)):
    for output in ("Color", "Alpha"):
        textured(f"image/painted/{'float' if is_float else 'byte'}{' packed' if packed else ''}/{output}",
                 lambda tile, f=is_float, p=packed: painted(tile, f, p), INSIDE, output)  # fmt: skip

FIELDS = combined(scaled(U1, -0.21, 2.31), scaled(V1, -0.19, 2.17), 0.0)
for way in ("Linear", "Closest"):
    textured(f"image/udim/{way}", pictures.udim, FIELDS, interpolation=way)
textured("image/udim/Alpha", pictures.udim, FIELDS, "Alpha")
textured("image/none", lambda tile: None, INSIDE)
textured("image/none alpha", lambda tile: None, INSIDE, "Alpha")


def gone(tile):
    path = pictures.write(os.path.join(tile.folder, "gone.png"), pictures.colourful())
    data = pictures.load(path)
    data.filepath = os.path.join(tile.folder, "not there.png")
    return data


textured("image/missing file", gone, INSIDE)
textured("image/missing file/alpha", gone, INSIDE, "Alpha")


def sequence(tile):
    for number in (1, 2, 3):
        path = os.path.join(tile.folder, f"frame_{number:04}.png")
        pictures.write(path, pictures.colourful(6, 6, 10 + number), mode="RGB")
    data = pictures.load(os.path.join(tile.folder, "frame_0001.png"))
    data.source = "SEQUENCE"
    return data


def offset(node) -> None:
    user = node.image_user
    user.frame_duration, user.frame_start, user.frame_offset = 3, 1, 1
    user.use_auto_refresh = True


textured("image/sequence", sequence, INSIDE, setup=offset)


def turned(node) -> None:
    node.texture_mapping.translation, node.texture_mapping.rotation = (0.2, -0.1, 0.0), (0.0, 0.0, 0.7)


textured("image/texture mapping", pictures.opaque, ABOUT, setup=turned)


def environment(name: str, make=pictures.exr, at=AROUND, **properties) -> None:
    @case(name, "TexEnvironment")
    def build(tile):
        return tile.node("TexEnvironment", {"Vector": at}, image=make(tile), **properties).outputs[0]


for projection, way in product(("EQUIRECTANGULAR", "MIRROR_BALL"), ("Linear", "Closest", "Cubic", "Smart")):
    environment(f"environment/{projection}/{way}", projection=projection, interpolation=way)
environment("environment/long vectors", at=VEC)
environment("environment/byte", pictures.opaque)
environment("environment/byte with alpha", pictures.png)
environment("environment/none", lambda tile: None)

SUN = (0.3, -0.5, 0.6)


def sky(name: str, kind: str, at=AROUND, stage: str = "flat", **properties) -> None:
    @case(name, "TexSky", stage=stage)
    def build(tile):
        node = tile.node("TexSky", {"Vector": at} if at else None, sky_type=kind)
        for key, value in properties.items():
            assign(node, key, value)
        return node.outputs[0]


for turbidity in (2.2, 6.0):
    sky(f"sky/PREETHAM {turbidity}", "PREETHAM", turbidity=turbidity, sun_direction=SUN)
    for albedo in (0.0, 0.3, 1.0):
        sky(f"sky/HOSEK_WILKIE {turbidity} {albedo}", "HOSEK_WILKIE", turbidity=turbidity, ground_albedo=albedo,
            sun_direction=SUN)  # fmt: skip
for kind in ("PREETHAM", "HOSEK_WILKIE"):
    sky(f"sky/{kind}/low sun", kind, sun_direction=(0.9, 0.3, 0.05))
    sky(f"sky/{kind}/no vector", kind, None, "placed", sun_direction=SUN)
for kind in ("NISHITA", "SINGLE_SCATTERING", "MULTIPLE_SCATTERING"):  # these have no input: generated coordinates
    for disc in (False, True):
        sky(f"sky/{kind}/{'disc' if disc else 'no disc'}", kind, None, "placed", sun_disc=disc, sun_elevation=0.4,
            sun_rotation=0.7, sun_size=0.3)  # fmt: skip
    dense = {"altitude": 3000.0, "air_density": 2.0, "ozone_density": 4.0, "sun_disc": False, "sun_elevation": 0.1}
    dust = "dust_density" if kind == "NISHITA" else "aerosol_density"
    sky(f"sky/{kind}/dense", kind, None, "placed", **dense, **{dust: 5.0})
    sky(f"sky/{kind}/below", kind, None, "placed", sun_elevation=-0.1, sun_disc=True)


@case("ies/file", "TexIES")
def ies_file(tile):
    node = tile.node("TexIES", {"Vector": AROUND, "Strength": 2.0}, mode="EXTERNAL")
    node.filepath = pictures.ies(tile)
    return node.outputs[0]


@case("ies/text", "TexIES")
def ies_text(tile):
    text = bpy.data.texts.new("lamp")
    text.from_string(pictures.IES)
    return tile.node("TexIES", {"Vector": VEC, "Strength": V}, mode="INTERNAL", ies=text).outputs[0]


@case("ies/missing", "TexIES")
def ies_missing(tile):
    node = tile.node("TexIES", {"Vector": AROUND, "Strength": U}, mode="EXTERNAL")
    node.filepath = os.path.join(tile.folder, "not there.ies")
    return node.outputs[0]


for interpolation in ("Linear", "Closest", "Cubic"):

    @case(f"point density/{interpolation}", "TexPointDensity", tolerance=2e-3)
    def point_density(tile, way=interpolation):
        if "Points" not in bpy.data.objects:
            data = bpy.data.meshes.new("Points")
            data.from_pydata([(0.2, 0.1, 0.3), (0.7, 0.5, -0.2), (-0.5, 0.9, 0.4)], [], [])
            bpy.context.scene.collection.objects.link(bpy.data.objects.new("Points", data))
        node = tile.node("TexPointDensity", {"Vector": VEC}, point_source="OBJECT", interpolation=way, resolution=20)
        node.object, node.radius = bpy.data.objects["Points"], 0.5
        return node.outputs["Density"]
