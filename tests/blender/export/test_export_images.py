# SPDX-License-Identifier: GPL-3.0-or-later
"""Images: files, packed files, pixels, sequences, tiles; each handed over once."""

from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from cardioid.export import image_files
from cardioid.export.image import pixels_of

from .kit import add, export, material, quad

pytestmark = pytest.mark.usefixtures("scene")


def texture(image, kind="ShaderNodeTexImage"):
    new, tree = material(f"Material {image.name if image else 'none'}")
    mesh = quad()
    mesh.materials.append(new)
    add(mesh)
    node = tree.nodes.new(kind)
    node.image = image
    diffuse, end = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(node.outputs[0], diffuse.inputs["Color"])
    tree.links.new(diffuse.outputs[0], end.inputs[0])
    return node


def file_image(folder, name="picture.png"):
    path = Path(folder) / name
    image = bpy.data.images.new("made", 4, 2)
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)
    return bpy.data.images.load(str(path))


def only_image(exported=None):
    images = (exported or export()).scene.images
    assert len(images) == 1
    return images[0]


def test_file(tmp_path):
    texture(file_image(tmp_path))
    found = only_image()
    assert (found["source"], found["path"]) == ("file", str(tmp_path / "picture.png"))
    assert (found["colorspace"], found["alpha_mode"]) == ("sRGB", "straight")


def test_missing_file_is_the_engines_to_name(tmp_path):
    image = file_image(tmp_path)
    image.filepath = str(tmp_path / "gone.png")
    texture(image)
    assert only_image()["path"].endswith("gone.png")


def test_relative_path(tmp_path):
    image = file_image(tmp_path)
    texture(image)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    image.filepath = "//picture.png"
    assert only_image()["path"] == str(tmp_path / "picture.png")


def test_path_that_was_written_on_windows(tmp_path):
    image = file_image(tmp_path)
    texture(image)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    image.filepath = "//.\\picture.png"
    assert Path(only_image()["path"]) == tmp_path / "picture.png"


def test_picture_of_a_linked_library_is_relative_to_the_library(tmp_path):
    (tmp_path / "lib").mkdir()
    image = file_image(tmp_path / "lib")
    texture(image)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "lib" / "lib.blend"))
    image.filepath = "//picture.png"
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    with bpy.data.libraries.load(str(tmp_path / "lib" / "lib.blend"), link=True) as (source, target):
        target.objects = [n for n in source.objects if n.startswith("Quad")]
    for obj in target.objects:
        bpy.context.scene.collection.objects.link(obj)
    bpy.context.scene.camera = add(bpy.data.cameras.new("Camera"))
    assert Path(only_image()["path"]) == tmp_path / "lib" / "picture.png"


def test_colour_space_and_alpha(tmp_path):
    image = file_image(tmp_path)
    image.colorspace_settings.name, image.alpha_mode = "Non-Color", "CHANNEL_PACKED"
    texture(image, "ShaderNodeTexEnvironment")
    assert (only_image()["colorspace"], only_image()["alpha_mode"]) == ("Non-Color", "channel_packed")


def test_packed(tmp_path):
    image = file_image(tmp_path)
    image.pack()
    texture(image)
    found = only_image()
    assert found["source"] == "packed" and found["packed"] == (tmp_path / "picture.png").read_bytes()


@pytest.mark.parametrize("is_float", [False, True])
def test_generated_pixels(is_float):
    image = bpy.data.images.new("gen", 3, 2, float_buffer=is_float)
    pixels = np.linspace(0, 1, 24, dtype=np.float32)
    image.pixels.foreach_set(pixels)
    texture(image)
    found = only_image()
    assert found["source"] == "pixels" and found["pixels"].shape == (2, 3, 4)
    assert np.allclose(found["pixels"].ravel(), pixels, atol=1e-6 if is_float else 0.003)
    assert found["colorspace"] == ("Non-Color" if is_float else "sRGB")


def test_painted_but_unsaved_pixels_count(tmp_path):
    image = file_image(tmp_path)
    image.pixels.foreach_set(np.full(32, 0.5, np.float32))
    assert image.is_dirty
    texture(image)
    assert only_image()["source"] == "pixels"


def test_one_image_in_two_materials_is_handed_over_once(tmp_path):
    image = file_image(tmp_path)
    texture(image)
    texture(image)
    exported = export()
    only_image(exported)
    assert len(exported.scene.materials) == 2


def test_no_image_is_minus_one():
    texture(None)
    node = next(n for n in export().scene.materials[0]["graph"]["nodes"] if n["type"] == "ShaderNodeTexImage")
    assert node["params"]["image"] == -1


@pytest.mark.parametrize(("frame", "cyclic", "number"), [(1, False, 5), (3, False, 7), (20, False, 8), (-3, False, 5),
                                                         (5, True, 5), (0, True, 8)])
def test_sequence(scene, tmp_path, frame, cyclic, number):
    image = file_image(tmp_path, "shot.0005.png")
    image.source = "SEQUENCE"
    user = texture(image).image_user
    user.frame_duration, user.frame_start, user.frame_offset, user.use_cyclic = 4, 1, 4, cyclic
    user.use_auto_refresh = True
    scene.frame_set(frame)
    assert only_image()["path"].endswith(f"shot.{number:04d}.png")


def tiled(folder, *numbers, listed=(1001, 1002, 1012), name="skin.<UDIM>.png"):
    """A tiled image that lists the tiles `listed`; there are files for `numbers` alone. Returns the image node."""
    for number in numbers:
        bpy.data.images.remove(file_image(folder, image_files.tile_path(name, number)))
    image = bpy.data.images.new("skin", 4, 4, tiled=True)
    image.filepath = str(folder / name)
    for number in listed[1:]:
        image.tiles.new(number)
    return texture(image)


def tiles_of(exported):
    nodes = exported.scene.materials[0]["graph"]["nodes"]
    params = next(n for n in nodes if n["type"] == "ShaderNodeTexImage")["params"]
    return params["image"], dict(zip(map(int, params["tiles"][::2]), map(int, params["tiles"][1::2])))


@pytest.mark.parametrize("name", ["skin.<UDIM>.png", "skin.<UVTILE>.png"])
def test_tiles(tmp_path, name):
    tiled(tmp_path, 1001, 1002, 1012, name=name)
    exported = export()
    first, tiles = tiles_of(exported)
    assert sorted(tiles) == [1001, 1002, 1012] and first == tiles[1001] and not exported.warnings
    for number, index in tiles.items():
        assert exported.scene.images[index]["path"] == image_files.tile_path(str(tmp_path / name), number)


def test_missing_tiles_are_named_and_left_out(tmp_path):
    tiled(tmp_path, 1001, 1012)
    exported = export()
    assert sorted(tiles_of(exported)[1]) == [1001, 1012]
    assert any("skin" in w and "1002" in w for w in exported.warnings)


def test_no_tile_at_all(tmp_path):
    tiled(tmp_path)
    exported = export()
    assert tiles_of(exported) == (-1, {}) and len(exported.warnings) == 3


def test_packed_tiles(tmp_path):
    node = tiled(tmp_path, 1001, 1002, listed=(1001, 1002))
    node.image.pack()
    (tmp_path / "skin.1001.png").unlink()
    exported = export()
    assert [i["source"] for i in exported.scene.images] == ["packed"] * 2
    assert exported.scene.images[tiles_of(exported)[1][1002]]["packed"] == (tmp_path / "skin.1002.png").read_bytes()


def test_movie_by_frame(scene, tmp_path):
    image = file_image(tmp_path)
    image.source, image.filepath = "MOVIE", str(tmp_path / "film.mp4")
    user = texture(image).image_user
    user.frame_duration, user.frame_start, user.use_auto_refresh = 10, 1, True
    scene.frame_set(1)
    assert only_image()["path"] == str(tmp_path / "film.mp4#frame=0")


def test_an_image_without_pixels_is_named():
    with pytest.raises(ValueError, match="no pixels"):
        pixels_of(SimpleNamespace(size=(0, 4), channels=4))
