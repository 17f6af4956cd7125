# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks the engine on purpose, one line at a time, and checks that the tests notice.

usage: mutants.py [--table FILE] [--work DIR] [--list] [--no-baseline] [--whole] [NAME ...]

Each mutant of the table (tests/mutants/caustics.py) replaces texts that occur exactly once in one file of the engine.
The tree is copied to the work directory, the mutant is applied there, what depends on it is built and the tests
that are to notice it run: they must pass without the mutant and fail with it. --whole runs all tests of the programs.
The copy has the kernels of one lane width only (AVX2), so that a mutant of them is built once instead of three times.
"""

from __future__ import annotations

import argparse
import os
import re
import runpy
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
COPIED = ("CMakeLists.txt", "cmake", "engine_cpp", "tests/unit")


def eight_lanes(kernel: str) -> str:
    """The three arguments of by_width, all of them the kernel of eight lanes."""
    return ", ".join([f"isa_w8::{kernel}"] * 3)


ONE_WIDTH = {  # changes to the copy: paths in 8 lanes only; scalar code uses the single lane of nodes
    "cmake/Rooms.cmake": [
        (
            "        target_sources(cardioid_${room} PRIVATE $<TARGET_OBJECTS:${name}>)",
            "        if(width EQUAL 8 OR (width EQUAL 1 AND NOT room MATCHES path AND NOT room MATCHES filter))\n"
            "            target_sources(cardioid_${room} PRIVATE $<TARGET_OBJECTS:${name}>)\n"
            "        endif()",
        )
    ],
    "engine_cpp/simd/width.h": [
        ("if (width == 16) return w16;", "if (w1 == nullptr || w16 == nullptr) return nullptr;"),
        ("return width == 8 ? w8 : w1;", "return w8;"),
    ],
    "engine_cpp/path/select_kernels.cpp": [
        (f"isa_w1::{k}, isa_w8::{k}, isa_w16::{k}", eight_lanes(k))
        for k in ("trace_batch", "trace_photons", "replay_rays")
    ],
    "engine_cpp/filter/select_kernels.cpp": [
        ("isa_w1::filter_similar, isa_w8::filter_similar, isa_w16::filter_similar", eight_lanes("filter_similar")),
        ("isa_w1::geometry_weights, isa_w8::geometry_weights,", eight_lanes("geometry_weights") + ");"),
        ("                                     isa_w16::geometry_weights);\n", ""),
    ],
    "engine_cpp/filter/cross_bilateral_select.cpp": [
        (
            "isa_w1::filter_cross_bilateral, isa_w8::filter_cross_bilateral,",
            eight_lanes("filter_cross_bilateral") + ");",
        ),
        ("                                isa_w16::filter_cross_bilateral);\n", ""),
    ],
}
FAILED = re.compile(r"^\[  FAILED  \] (\S+)(?: \(|,| *$)", re.MULTILINE)


class Mutant(NamedTuple):
    name: str
    file: str  # below the root
    edits: list[tuple[str, str]]  # texts that occur exactly once, and what takes their place
    tests: dict[str, str]  # target → GoogleTest filter


@dataclass
class Outcome:
    mutant: str
    build_seconds: float
    test_seconds: float
    failed: list[str]

    @property
    def noticed(self) -> bool:
        return bool(self.failed)


def die(message: str) -> None:
    sys.exit(f"mutants.py: {message}")


def load_table(path: Path) -> list[Mutant]:
    rows = runpy.run_path(str(path))["MUTANTS"]
    mutants = [Mutant(**row) for row in rows]
    names = [m.name for m in mutants]
    if len(set(names)) != len(names):
        die(f"{path}: two mutants of one name")
    return mutants


def edited(what: str, file: str, edits: list[tuple[str, str]], text: str) -> str:
    """The file's text with the edits in it."""
    for old, new in edits:
        count = text.count(old)
        if count != 1:
            die(f"{what}: occurs {count} times in {file}, bring the table up to date:\n{old}")
        if old == new:
            die(f"{what}: changes nothing")
        text = text.replace(old, new)
    return text


def mutated(mutant: Mutant, text: str) -> str:
    return edited(mutant.name, mutant.file, mutant.edits, text)


def copied_bytes(source: Path) -> bytes:
    """What the copy has in place of a file of the tree."""
    name = source.relative_to(ROOT).as_posix()
    if name in ONE_WIDTH:
        return edited("one lane width", name, ONE_WIDTH[name], source.read_text()).encode()
    return source.read_bytes()


def copy_tree(tree: Path) -> None:
    """Copies what differs, so that a second run builds little; files that are gone are removed."""
    wanted = set()
    for name in COPIED:
        top = ROOT / name
        for source in [top] if top.is_file() else sorted(p for p in top.rglob("*") if p.is_file()):
            if "__pycache__" in source.parts:
                continue
            target = tree / source.relative_to(ROOT)
            wanted.add(target)
            content = copied_bytes(source)
            if target.exists() and target.read_bytes() == content:
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content)
    for target in [p for p in tree.rglob("*") if p.is_file()]:
        if target not in wanted:
            target.unlink()


def build(work: Path, targets: list[str], log: Path) -> float:
    started = time.monotonic()
    env = {**os.environ, "CCACHE_BASEDIR": str(work), "CCACHE_NOHASHDIR": "1"}
    configure = ["cmake", "-S", work / "tree", "-B", work / "build", "-G", "Ninja", "-DCARDIOID_PYTHON=OFF"]
    with log.open("w") as out:
        for command in (configure, ["ninja", "-C", work / "build", "-j", str(os.cpu_count() or 2), *targets]):
            if subprocess.run([str(c) for c in command], stdout=out, stderr=out, env=env).returncode != 0:
                print("\n".join(log.read_text(errors="replace").splitlines()[-30:]))
                die(f"does not build; see {log}")
    return time.monotonic() - started


def program(work: Path, target: str) -> Path:
    found = [p for p in (work / "build" / "tests" / "unit").rglob(target) if p.is_file()]
    if len(found) != 1:
        die(f"{target}: {len(found)} programs of this name")
    return found[0]


def run_tests(work: Path, tests: dict[str, str], whole: bool, log: Path) -> tuple[float, list[str]]:
    """Seconds, and the tests that failed. A program that ends without a verdict counts as one failed test."""
    started, failed = time.monotonic(), []
    with log.open("w") as out:
        for target, chosen in tests.items():
            command = [str(program(work, target)), f"--gtest_filter={'*' if whole else chosen}"]
            done = subprocess.run(command, capture_output=True, text=True, errors="replace")
            out.write(done.stdout + done.stderr)
            if "Running 0 tests" in done.stdout:
                die(f"{target}: no test is named {chosen}")
            names = list(dict.fromkeys(FAILED.findall(done.stdout)))
            failed += names if names or done.returncode == 0 else [f"{target} ended with {done.returncode}"]
    return time.monotonic() - started, failed


def all_tests(mutants: list[Mutant]) -> dict[str, str]:
    union: dict[str, list[str]] = {}
    for mutant in mutants:
        for target, chosen in mutant.tests.items():
            union.setdefault(target, []).extend(c for c in chosen.split(":") if c not in union.get(target, []))
    return {target: ":".join(chosen) for target, chosen in union.items()}


def try_mutant(mutant: Mutant, work: Path, whole: bool) -> Outcome:
    path = work / "tree" / mutant.file
    original = path.read_text()
    path.write_text(mutated(mutant, original))
    slug = re.sub(r"\W+", "-", mutant.name)
    try:
        build_seconds = build(work, list(mutant.tests), work / f"{slug}.build.log")
        test_seconds, failed = run_tests(work, mutant.tests, whole, work / f"{slug}.log")
    finally:
        path.write_text(original)
    return Outcome(mutant.name, build_seconds, test_seconds, failed)


def print_row(outcome: Outcome) -> None:
    shown = ", ".join(outcome.failed[:3]) + (f" and {len(outcome.failed) - 3} more" if len(outcome.failed) > 3 else "")
    verdict = "noticed" if outcome.noticed else "LIVES"
    times = f"{outcome.build_seconds:6.0f} s {outcome.test_seconds:6.0f} s"
    print(f"{outcome.mutant:34} {verdict:8} {times}  {shown}", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="mutants to try; none: all")
    parser.add_argument("--table", type=Path, default=ROOT / "tests" / "mutants" / "caustics.py")
    parser.add_argument("--work", type=Path, default=ROOT / "build" / "mutants", help="copy of the tree and its build")
    parser.add_argument("--list", action="store_true", help="check the table against the tree and stop")
    parser.add_argument("--no-baseline", action="store_true", help="do not run the tests without a mutant first")
    parser.add_argument("--whole", action="store_true", help="all tests of the programs, not those of the table")
    args = parser.parse_args()

    mutants = load_table(args.table)
    unknown = set(args.names) - {m.name for m in mutants}
    if unknown:
        die(f"no mutant is named {', '.join(sorted(unknown))}")
    chosen = [m for m in mutants if not args.names or m.name in args.names]
    for mutant in chosen:
        mutated(mutant, (ROOT / mutant.file).read_text())
    if args.list:
        for mutant in chosen:
            print(f"{mutant.name:34} {mutant.file}")
        return 0

    args.work.mkdir(parents=True, exist_ok=True)
    copy_tree(args.work / "tree")
    tests = all_tests(chosen)
    build(args.work, list(tests), args.work / "baseline.build.log")
    if not args.no_baseline:
        seconds, failed = run_tests(args.work, tests, args.whole, args.work / "baseline.log")
        print(f"without mutants: {len(failed)} failed in {seconds:.0f} s", flush=True)
        if failed:
            die(f"these must pass first: {', '.join(failed)}")
    outcomes = []
    for mutant in chosen:
        outcomes.append(try_mutant(mutant, args.work, args.whole))
        print_row(outcomes[-1])
    living = sum(not o.noticed for o in outcomes)
    print(f"{len(outcomes)} mutants, {living} live")
    return 1 if living else 0


if __name__ == "__main__":
    sys.exit(main())
