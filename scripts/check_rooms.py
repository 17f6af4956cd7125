#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the rooms of docs/architecture.md: includes follow the arrows, each outside library stays in its room, every
source file names its license and stays short.

usage: scripts/check_rooms.py [repository]    exit code 1 and one line per finding if anything is wrong
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

MAX_LINES = 400
LICENSE_LINE = "SPDX-License-Identifier: GPL-3.0-or-later"

_SCENE = {"math", "scene"}
_TRACE = {"simd", "math", "scene", "image", "bsdf", "nodes", "light"}
_RENDER = _TRACE | {"trace", "path", "photon", "film", "filter"}

# What each room may include besides itself.
ALLOWED: dict[str, set[str]] = {
    "simd": set(),
    "math": set(),
    "scene": {"math"},
    "image": _SCENE,
    "bsdf": {"simd", "math"},
    "nodes": {"simd", "math", "scene", "image", "bsdf"},
    "light": {"simd", "math", "scene"},
    "trace": _TRACE,
    "photon": {"math"},
    "path": _TRACE | {"trace", "photon"},
    "film": _SCENE,
    "filter": _SCENE | {"simd", "film"},
    "render": _RENDER,
    "apps": _RENDER | {"render"},
}

# Outside libraries: the include's pattern and where it may appear (a path prefix under engine_cpp/).
LIBRARIES: dict[str, tuple[str, tuple[str, ...]]] = {
    "Embree": (r"embree\d?/", ("trace/",)),
    "OpenImageIO": (r"OpenImageIO/", ("image/",)),
    "OpenColorIO": (r"OpenColorIO/", ("image/",)),
    "TBB": (r"(tbb|oneapi)/", ("render/",)),
    "pybind11": (r"pybind11/", ("apps/python/",)),
    "Python": (r"Python\.h", ("apps/python/",)),
    "intrinsics": (r"(\w*mmintrin|immintrin|x86intrin|arm_neon)\.h", ("simd/",)),
}
INTRINSIC_CALL = re.compile(r"\b_mm(256|512)?_\w+\s*\(|\b__m(128|256|512)[id]?\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)
PY_BPY = re.compile(r"^\s*(import|from)\s+bpy\b", re.MULTILINE)

CPP_SUFFIXES = {".h", ".hpp", ".cpp", ".inl"}
SOURCE_SUFFIXES = CPP_SUFFIXES | {".py", ".cmake", ".sh", ".env"}
SKIPPED_FOLDERS = {".git", "build", "out", "node_modules", "__pycache__", ".cache"}
# Not engine and not tests of it, but Python that Blender itself runs.
BPY_FOLDERS = ("addon/", "tests/", "scripts/", "scenes/", "bench/")


def source_files(root: Path) -> Iterator[Path]:
    """Every file that a person wrote: by suffix, plus extension-less scripts."""
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if any(p in SKIPPED_FOLDERS or p.startswith((".venv", "build-")) for p in parts) or not path.is_file():
            continue
        in_scripts = parts[0] in {"scripts", ".ci"} and not path.suffix
        if path.suffix in SOURCE_SUFFIXES or path.name == "CMakeLists.txt" or in_scripts:
            yield path


def without_comments(text: str) -> str:
    """C++ text with comments blanked, so that prose may name what code may not."""
    text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group().count("\n"), text, flags=re.DOTALL)
    return re.sub(r"//[^\n]*", "", text)


def line_of(text: str, offset: int) -> int:
    return text.count("\n", 0, offset) + 1


def check_engine_file(relative: str, text: str) -> Iterator[str]:
    """One file of engine_cpp/; `relative` is its path under that folder."""
    room = relative.split("/", 1)[0]
    if room not in ALLOWED:
        yield f"engine_cpp/{relative}: '{room}' is not a room of docs/architecture.md"
        return
    code = without_comments(text)
    for match in INCLUDE.finditer(code):
        included, where = match.group(1), f"engine_cpp/{relative}:{line_of(code, match.start())}"
        target = included.split("/", 1)[0]
        if target in ALLOWED and "/" in included and target != room and target not in ALLOWED[room]:
            yield f"{where}: {room}/ may not include {included}"
        if included.startswith("../"):
            yield f"{where}: include {included} from engine_cpp/, not by a relative path"
        for library, (pattern, rooms) in LIBRARIES.items():
            if re.match(pattern, included) and not relative.startswith(rooms):
                yield f"{where}: only {' and '.join(rooms)} may include {library} ({included})"
    if room != "simd":
        for match in INTRINSIC_CALL.finditer(code):
            yield f"engine_cpp/{relative}:{line_of(code, match.start())}: intrinsics belong to simd/ ({match.group()})"


def check_any_file(relative: str, text: str) -> Iterator[str]:
    """What holds for every source file of the repository."""
    if LICENSE_LINE not in text[:400]:
        yield f"{relative}:1: no '{LICENSE_LINE}'"
    lines = text.count("\n")
    if lines > MAX_LINES:
        yield f"{relative}: {lines} lines, more than {MAX_LINES}"
    if relative.endswith(".py") and not relative.startswith(BPY_FOLDERS):
        for match in PY_BPY.finditer(text):
            yield f"{relative}:{line_of(text, match.start())}: bpy outside {', '.join(BPY_FOLDERS)}"


def check(root: Path) -> list[str]:
    """Every finding in the repository, in the order of its files."""
    findings: list[str] = []
    for path in source_files(root):
        relative = path.relative_to(root).as_posix()
        text = path.read_text(encoding="utf-8", errors="replace")
        findings += check_any_file(relative, text)
        if relative.startswith("engine_cpp/") and path.suffix in CPP_SUFFIXES:
            findings += check_engine_file(relative.removeprefix("engine_cpp/"), text)
    return findings


def main() -> int:
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[1]
    findings = check(root)
    for finding in findings:
        print(finding)
    print(f"{len(list(source_files(root)))} files, {len(findings)} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
