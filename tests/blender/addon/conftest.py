# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on in a Blender with a fresh file for each test, on the fake engine unless a test asks for the real one."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path

import pytest

bpy = pytest.importorskip("bpy")

sys.path.insert(0, str(Path(__file__).parent))
import fake_engine  # noqa: E402
import pictures  # noqa: E402

k_root = Path(__file__).resolve().parents[3]
k_core = "cardioid._core"
k_compiled = list((k_root / "addon" / "cardioid").glob("_core*.so"))

needs_engine = pytest.mark.skipif(not k_compiled, reason="the engine is not built")


def use_core(module) -> None:
    """Makes `module` (None: nothing) the engine of the add-on."""
    import cardioid

    sys.modules[k_core] = module
    if module is None:
        cardioid.__dict__.pop("_core", None)
    cardioid.core.forget()


@pytest.fixture(scope="session", autouse=True)
def addon_importable():
    if str(k_root / "addon") not in sys.path:
        sys.path.insert(0, str(k_root / "addon"))


@pytest.fixture
def fresh_file():
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    cycles = importlib.import_module("addon_utils").check("cycles")[1]
    if not cycles:
        importlib.import_module("addon_utils").enable("cycles")


@pytest.fixture
def fake():
    """The fake engine in place of cardioid._core, in its initial state."""
    import cardioid  # noqa: F401

    before = sys.modules.get(k_core)
    fake_engine.reset()
    use_core(fake_engine)
    yield fake_engine
    fake_engine.reset()
    if before is None:
        del sys.modules[k_core]
    else:
        sys.modules[k_core] = before


@pytest.fixture
def addon(fresh_file, fake):
    """The add-on, registered, with Cardioid chosen in the factory file at a small size."""
    import cardioid

    cardioid.register()
    scene = bpy.context.scene
    scene.render.engine = "CARDIOID"
    scene.render.resolution_x, scene.render.resolution_y = 40, 24
    scene.render.resolution_percentage = 100
    scene.cardioid.samples = 4
    yield cardioid
    bpy.context.scene.render.engine = "CYCLES"
    cardioid.unregister()


@pytest.fixture
def render(tmp_path):
    """render(**scene settings) -> pass name to (h, w, c) array, read from the EXR that Blender wrote."""

    def run(name="out", multilayer=True):
        return pictures.render(tmp_path / name, multilayer)

    return run
