# SPDX-License-Identifier: GPL-3.0-or-later
"""The colour configuration: handed over as it is where the engine can use it, else a simpler copy."""

import os
import re

import bpy
import pytest
from cardioid.export import colors

from .kit import export
from .test_export_images import file_image, texture

pytestmark = pytest.mark.usefixtures("scene")


def own_config():
    return os.path.join(bpy.utils.system_resource("DATAFILES", path="colormanagement"), "config.ocio")


def given_to_the_engine(config=None):
    return export(settings={"ocio_config": config or own_config()}).scene.settings["ocio_config"]


def test_standard_spaces_need_no_copy(tmp_path):
    texture(file_image(tmp_path))
    assert given_to_the_engine() == own_config()
    assert given_to_the_engine("/nowhere.ocio") == "/nowhere.ocio"


def test_a_newer_configuration_is_simplified_where_it_is_needed(tmp_path):
    image = file_image(tmp_path)
    image.colorspace_settings.name = "Filmic Log"
    texture(image)
    found = given_to_the_engine()
    with open(own_config()) as file:
        newer = colors.version(file.read()) > (2, 1)
    assert (found != own_config()) == newer
    if newer:
        with open(found) as file:
            text = file.read()
        assert colors.version(text) == (2, 1) and colors.role(text, "scene_linear") == "Linear Rec.709"
        assert "Filmic Log" in text and not re.search(r"ACES-OUTPUT.*_2\.0", text) and "displays:" in text


@pytest.mark.skipif(not hasattr(bpy.data, "colorspace"), reason="the working space is a setting since 5.0")
def test_working_space_of_the_file(tmp_path):
    texture(file_image(tmp_path))
    bpy.ops.wm.set_working_color_space(working_space="ACEScg", convert_colors=False)
    with open(given_to_the_engine()) as file:
        assert colors.role(file.read(), "scene_linear") == "ACEScg"


def test_search_paths_become_absolute():
    for text in ('ocio_profile_version: 2\nsearch_path: "luts:filmic"\nroles:\n  data: Raw\n',
                 "ocio_profile_version: 2\nsearch_path:\n  - luts\n  - filmic\nroles:\n  data: Raw\n"):
        found = colors.simplified(text, "/folder", None)
        assert '- "/folder/luts"' in found and '- "/folder/filmic"' in found and "roles:\n  data: Raw" in found
