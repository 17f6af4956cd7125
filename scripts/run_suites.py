# SPDX-License-Identifier: GPL-3.0-or-later
"""The suites behind scripts/test. Each prints its counts; the last line sums them up: `N passed, N failed, N skipped`.

usage: run_suites.py [unit|blender|render|lint ...]    without names: everything
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "release"
LOGS = ROOT / "build" / "logs"
PYTHON = "/usr/bin/python3"
TOOLS = ROOT / ".venv" / "tools" / "bin"
COUNTS = re.compile(r"^(\d+) passed, (\d+) failed, (\d+) skipped\s*$", re.MULTILINE)


@dataclass
class Counts:
    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped)

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed, {self.skipped} skipped"


@dataclass
class Outcome:
    """What a command did: its exit code (124: out of time) and everything that it printed."""

    code: int
    text: str


def run(name: str, command: list[str | Path], *, seconds: float, env: dict[str, str] | None = None) -> Outcome:
    """Runs a command without a terminal, its output in build/logs/<name>.log."""
    LOGS.mkdir(parents=True, exist_ok=True)
    log = LOGS / f"{name}.log"
    with log.open("w") as out:
        process = subprocess.Popen(
            [str(c) for c in command],
            cwd=ROOT,
            env={**os.environ, **(env or {})},
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            code = process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)  # with the Blenders that it started
            process.wait()
            out.write(f"\nError: stopped after {seconds:.0f} s\n")
            code = 124
    return Outcome(code, log.read_text(errors="replace"))


def tail(text: str, lines: int = 60) -> str:
    return "\n".join(text.rstrip().splitlines()[-lines:])


def junit_counts(path: Path) -> Counts:
    """Counts of a JUnit file (pytest's and GoogleTest's have the same attributes where it matters)."""
    counts = Counts()
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            counts.failed += 1
        elif case.find("skipped") is not None or case.get("status") == "notrun":
            counts.skipped += 1
        else:
            counts.passed += 1
    return counts


def skip_reasons(path: Path) -> list[str]:
    """Each skipped test of a JUnit file by name, with its reason."""
    reasons = []
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        skipped = case.find("skipped")
        if skipped is not None:
            reasons.append(f"skipped {case.get('name')}: {skipped.get('message', '')}")
    return reasons


def checked(outcome: Outcome, counts: Counts, good_codes: tuple[int, ...] = (0,)) -> Counts:
    """A command that failed without a failed test (a crash, no time left, nothing collected) is a failure too."""
    if outcome.code not in good_codes and counts.failed == 0:
        counts.failed += 1
    if counts.failed:
        print(tail(outcome.text))
    return counts


def pytest_suite(name: str, command: list[str | Path], paths: list[str], seconds: float, env=None) -> Counts:
    """pytest over `paths`; `command` is what starts it, up to its arguments."""
    missing = [p for p in paths if not (ROOT / p).exists()]
    if missing:
        print(f"not there: {', '.join(missing)}")
        return Counts(failed=len(missing))
    with tempfile.TemporaryDirectory() as folder:
        junit = Path(folder) / "junit.xml"
        outcome = run(name, [*command, *paths, "-q", f"--junitxml={junit}"], seconds=seconds, env=env)
        if not junit.exists():
            return checked(outcome, Counts(), good_codes=())
        for reason in skip_reasons(junit):
            print(reason)
        return checked(outcome, junit_counts(junit))


def check_suite(name: str, command: list[str | Path], seconds: float = 300) -> Counts:
    """A check that is one test: its exit code."""
    outcome = run(name, command, seconds=seconds)
    if outcome.code == 0:
        return Counts(passed=1)
    print(tail(outcome.text))
    return Counts(failed=1)


# The suites --------------------------------------------------------------------------------------------------


def cpp_tests() -> Counts:
    """CTest; counts are GoogleTest's cases, a program that dies or leaves no report is one failure."""
    with tempfile.TemporaryDirectory() as folder:
        summary = Path(folder) / "ctest.xml"
        cases = Path(folder) / "cases"
        command = ["ctest", "--test-dir", BUILD, "--parallel", os.cpu_count() or 1, "--output-on-failure"]
        command += ["--label-exclude", "long", "--timeout", 600, "--no-tests=error", "--output-junit", summary]
        outcome = run("ctest", command, seconds=1500, env={"GTEST_OUTPUT": f"xml:{cases}/"})
        counts = sum((junit_counts(p) for p in cases.glob("*.xml")), Counts())
        if summary.exists():
            counts.skipped += junit_counts(summary).skipped
            for reason in skip_reasons(summary):
                print(reason)
        return checked(outcome, counts)


def python_tests() -> Counts:
    """Python that needs no Blender: the arithmetic of the bench and of the comparisons with Cycles."""
    folders = ["tests/bench", "tests/docs", "tests/render", "tests/compare_nodes", "tests/compare_files"]
    return pytest_suite("python", [TOOLS / "python", "-m", "pytest"], folders, 300)


def report_tests() -> Counts:
    """The page of scripts/report, also in headless Chromium."""
    return pytest_suite("report", [ROOT / ".venv/browser/bin/python", "-m", "pytest"], ["tests/report"], 180)


def in_blender(name: str, starter: list[str | Path]) -> Counts:
    """tests/blender inside one Blender, with preferences and scripts of its own."""
    with tempfile.TemporaryDirectory() as folder:
        env = {f"BLENDER_USER_{part}": folder for part in ("RESOURCES", "CONFIG", "SCRIPTS", "DATAFILES")}
        command = [*starter, ROOT / "scripts" / "pytest_in_blender.py", "--"]
        return pytest_suite(name, command, ["tests/blender"], 600, env)


def blender_34() -> Counts:
    return in_blender("blender34", ["blender", "--background", "--factory-startup", "-noaudio", "--python"])


def bpy_45() -> Counts:
    return in_blender("bpy45", [ROOT / ".venv/bpy45/bin/python"])


def bpy_50() -> Counts:
    return in_blender("bpy50", [ROOT / ".venv/bpy50/bin/python"])


def bad_input() -> Counts:
    return pytest_suite("bad_input", [PYTHON, "-m", "pytest"], ["tests/bad_input"], 600)


def scene_files() -> Counts:
    """Each file of scenes/: packed, told, and rendered small by Debian's Blender."""
    return pytest_suite("scenes", [PYTHON, "-m", "pytest"], ["tests/scenes"], 300)


def render_comparison() -> Counts:
    """tests/render/run.py against Cycles and the stored pictures; it prints the counts line itself."""
    script = ROOT / "tests" / "render" / "run.py"
    if not script.exists():
        print(f"not there: {script.relative_to(ROOT)}")
        return Counts(failed=1)
    outcome = run("render", [PYTHON, script], seconds=1500)
    found = COUNTS.findall(outcome.text)
    counts = Counts(*map(int, found[-1])) if found else Counts()
    for line in outcome.text.splitlines():
        if line.startswith("skipped "):
            print(line)
    return checked(outcome, counts, good_codes=(0,) if found else ())


def ruff() -> Counts:
    return check_suite("ruff", [TOOLS / "ruff", "check", "--no-cache", "--output-format=concise", "."])


def clang_format() -> Counts:
    return check_suite("clang_format", [ROOT / "scripts" / "format", "--check"])


def rooms() -> Counts:
    return check_suite("rooms", [PYTHON, ROOT / "scripts" / "check_rooms.py"])


def lint_tests() -> Counts:
    return pytest_suite("lint_tests", [PYTHON, "-m", "pytest"], ["tests/lint"], 300)


PARTS: dict[str, list[tuple[str, Callable[[], Counts]]]] = {
    "lint": [
        ("ruff", ruff),
        ("clang-format", clang_format),
        ("rooms, licenses, file lengths", rooms),
        ("tests of the checks, kernel symbols", lint_tests),
    ],
    "unit": [("C++", cpp_tests), ("Python", python_tests), ("report page", report_tests)],
    "blender": [
        ("Debian's Blender 3.4", blender_34),
        ("bpy 4.5", bpy_45),
        ("bpy 5.0", bpy_50),
        ("bad input", bad_input),
        ("files of scenes/", scene_files),
    ],
    "render": [("render comparison", render_comparison)],
}


def main(names: list[str]) -> int:
    unknown = [n for n in names if n not in PARTS]
    if unknown:
        print(f"no such part: {', '.join(unknown)}; there are {', '.join(PARTS)}")
        return 2
    if shutil.which("blender") is None:
        print("blender is not on PATH")
        return 2
    total = Counts()
    for part in names or PARTS:
        for title, suite in PARTS[part]:
            start = time.monotonic()
            print(f"== {title}", flush=True)
            counts = suite()
            print(f"   {title}: {counts}  ({time.monotonic() - start:.1f} s)", flush=True)
            total = total + counts
    print()
    print(total)
    return 1 if total.failed or not total.passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
