# SPDX-License-Identifier: GPL-3.0-or-later
"""No AVX object file may define a weak symbol that other files could share: the linker keeps one copy of an inline
function, and if that is the AVX-512 one, every other machine stops with an illegal instruction."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "release"
WIDTHS = {8: "isa_w8", 16: "isa_w16"}
# nm's letters for a symbol that may be merged with another of its name: weak function, weak object, GNU unique.
SYMBOL = re.compile(r"^[0-9a-f]+ ([WwVvu]) (.+)$", re.MULTILINE)


def shared_symbols(objects: list[Path], namespace: str) -> list[str]:
    """Mergeable symbols that the objects define and whose name does not carry the width's namespace."""
    if not objects:
        return []
    text = subprocess.run(
        ["nm", "-C", "--defined-only", *map(str, objects)], check=True, capture_output=True, text=True
    ).stdout
    return sorted({name for _, name in SYMBOL.findall(text) if f"{namespace}::" not in name})


def kernel_objects(width: int) -> list[Path]:
    return sorted(BUILD.glob(f"**/cardioid_*_w{width}.dir/**/*.o"))


@pytest.mark.parametrize("width", WIDTHS)
def test_kernels_define_no_shared_symbol(width: int) -> None:
    objects = kernel_objects(width)
    if not objects:
        pytest.skip("no Release build in build/release")
    assert shared_symbols(objects, WIDTHS[width]) == []


def test_a_planted_inline_function_is_found(tmp_path: Path) -> None:
    source = tmp_path / "planted.cpp"
    source.write_text(
        "inline int shared(int x) { return x + 1; }\n"
        "namespace cardioid::isa_w16 { inline int own(int x) { return x + 2; } }\n"
        "int (*keep[])(int) = {shared, cardioid::isa_w16::own};\n"
    )
    subprocess.run(["g++", "-c", source, "-o", tmp_path / "planted.o"], check=True)
    assert shared_symbols([tmp_path / "planted.o"], "isa_w16") == ["shared(int)"]
