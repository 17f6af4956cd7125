# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/check_rooms.py finds each kind of planted violation, and nothing in a clean tree."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import check_rooms  # noqa: E402

LICENSE = f"// {check_rooms.LICENSE_LINE}\n"


def findings(tmp_path: Path, relative: str, text: str) -> list[str]:
    path = tmp_path / relative
    path.parent.mkdir(parents=True)
    path.write_text(text)
    return check_rooms.check(tmp_path)


@pytest.mark.parametrize(
    ("relative", "line", "part"),
    [
        ("engine_cpp/math/a.h", '#include "scene/scene_desc.h"', "math/ may not include scene/"),
        ("engine_cpp/bsdf/a.h", '#include "light/kernels.h"', "bsdf/ may not include light/"),
        ("engine_cpp/film/a.cpp", '#include "trace/hit.h"', "film/ may not include trace/"),
        ("engine_cpp/path/a.cpp", '#include "film/film.h"', "path/ may not include film/"),
        ("engine_cpp/light/a.cpp", '#include "nodes/program.h"', "light/ may not include nodes/"),
        ("engine_cpp/render/a.cpp", '  #  include "apps/cli/args.h"', "render/ may not include apps/"),
        ("engine_cpp/path/a.cpp", "#include <embree3/rtcore.h>", "Embree"),
        ("engine_cpp/scene/a.cpp", "#include <OpenImageIO/imageio.h>", "OpenImageIO"),
        ("engine_cpp/render/a.cpp", "#include <OpenColorIO/OpenColorIO.h>", "OpenColorIO"),
        ("engine_cpp/path/a.cpp", "#include <tbb/parallel_for.h>", "TBB"),
        ("engine_cpp/path/a.cpp", "#include <oneapi/tbb/task_arena.h>", "TBB"),
        ("engine_cpp/render/a.cpp", "#include <pybind11/pybind11.h>", "pybind11"),
        ("engine_cpp/apps/cli/a.cpp", "#include <Python.h>", "Python"),
        ("engine_cpp/bsdf/a.h", "#include <immintrin.h>", "intrinsics"),
        ("engine_cpp/trace/a.h", "auto x = _mm256_add_ps(a, b);", "intrinsics belong to simd/"),
        ("engine_cpp/trace/a.h", "__m512 x;", "intrinsics belong to simd/"),
        ("engine_cpp/math/a.h", '#include "../simd/lanes.h"', "relative path"),
        ("engine_cpp/kitchen/a.h", "", "not a room"),
        ("tools/a.py", "import bpy", "bpy outside"),
    ],
)
def test_planted_violation_is_found(tmp_path: Path, relative: str, line: str, part: str) -> None:
    found = findings(tmp_path, relative, f"{LICENSE}{line}\n")
    assert len(found) == 1, found
    assert part in found[0]
    assert found[0].startswith(relative)


def test_a_file_without_license_is_found(tmp_path: Path) -> None:
    found = findings(tmp_path, "engine_cpp/math/a.h", "#pragma once\n")
    assert len(found) == 1 and "SPDX" in found[0]


@pytest.mark.parametrize(("lines", "count"), [(400, 0), (401, 1)])
def test_long_files_are_found(tmp_path: Path, lines: int, count: int) -> None:
    found = findings(tmp_path, "engine_cpp/math/a.h", LICENSE + "int x;\n" * (lines - 1))
    assert len(found) == count
    assert all("more than 400" in f for f in found)


@pytest.mark.parametrize(
    ("relative", "line"),
    [
        ("engine_cpp/scene/a.h", '#include "math/types.h"'),
        ("engine_cpp/trace/a.cpp", "#include <embree3/rtcore.h>"),
        ("engine_cpp/image/a.cpp", "#include <OpenColorIO/OpenColorIO.h>"),
        ("engine_cpp/render/a.cpp", '#include "path/batch.h"\n#include <tbb/task_arena.h>'),
        ("engine_cpp/apps/python/a.cpp", '#include <pybind11/pybind11.h>\n#include "render/session.h"'),
        ("engine_cpp/simd/a.h", "#include <immintrin.h>\n__m512 x;"),
        ("engine_cpp/math/a.h", "// prose may name _mm256_add_ps() and\n/* #include <tbb/tbb.h>\n */"),
        ("addon/cardioid/a.py", "import bpy"),
    ],
)
def test_allowed_code_passes(tmp_path: Path, relative: str, line: str) -> None:
    assert findings(tmp_path, relative, f"{LICENSE}{line}\n") == []


def test_built_files_are_not_looked_at(tmp_path: Path) -> None:
    assert findings(tmp_path, "build/release/CMakeLists.txt", "no license") == []


def test_the_arrows_have_no_cycle() -> None:
    """A room that may include another is never included by it."""
    for room, targets in check_rooms.ALLOWED.items():
        for target in targets:
            assert room not in check_rooms.ALLOWED[target], f"{room} <-> {target}"


def test_every_room_of_the_documentation_is_in_the_table() -> None:
    text = (ROOT / "docs" / "architecture.md").read_text()
    for room in check_rooms.ALLOWED:
        assert f"\n  {room}/" in text, f"docs/architecture.md does not name {room}/"
