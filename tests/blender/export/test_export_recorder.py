# SPDX-License-Identifier: GPL-3.0-or-later
"""The recorder must not know more than the engine: its keys are fields of engine_cpp/scene/scene_desc.h."""

import re
from pathlib import Path

import fake_core
import numpy as np
import pytest

_HEADER = Path(__file__).resolve().parents[3] / "engine_cpp" / "scene" / "scene_desc.h"
_TABLES = {"InstanceDesc": fake_core.INSTANCE, "MaterialDesc": fake_core.MATERIAL, "LightDesc": fake_core.LIGHT,
           "WorldDesc": fake_core.WORLD, "CameraDesc": fake_core.CAMERA, "ImageDesc": fake_core.IMAGE,
           "Settings": fake_core.SETTINGS}


@pytest.mark.parametrize("struct", _TABLES)
def test_keys_are_fields(struct):
    body = re.search(rf"struct {struct} {{(.*?)\n}};", _HEADER.read_text(), re.DOTALL).group(1)
    body = re.sub(r"//.*", "", body)
    fields = set(re.findall(r"(\w+)\s*(?:=[^,;]*|\{[^}]*\})?\s*[,;]", body))
    assert set(_TABLES[struct]) <= fields


@pytest.mark.parametrize("bad", [
    {"positions": np.zeros((3, 3))}, {"triangles": np.array([[0, 1, 3]], np.int32)}, {"slots": np.zeros(2, np.int32)},
    {"corner_normals": np.zeros((1, 3), np.float32)}, {"attributes": [("UV", "edge", np.zeros((1, 3, 2), np.float32))]},
    {"attributes": [("UV", "corner", np.zeros((3, 2), np.float32))]}, {"active_uv": "UV"}])
def test_wrong_arrays_are_refused(bad):
    good = {"positions": np.zeros((3, 3), np.float32), "triangles": np.array([[0, 1, 2]], np.int32)}
    fake_core.Scene().add_mesh("Mesh", **good)
    with pytest.raises(fake_core.Error):
        fake_core.Scene().add_mesh("Mesh", **{**good, **bad})


@pytest.mark.parametrize("bad", [{"colour": (1, 1, 1)}, {"energy": float("nan")}, {"kind": "hemi"}, {"color": (1, 1)}])
def test_wrong_dictionaries_are_refused(bad):
    good = {"name": "Lamp", "kind": "point", "transform": (1.0,) * 12, "energy": 1.0}
    fake_core.Scene().add_light(good)
    with pytest.raises(fake_core.Error):
        fake_core.Scene().add_light({**good, **bad})
