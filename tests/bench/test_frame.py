# SPDX-License-Identifier: GPL-3.0-or-later
"""The bench's frame: options, budgets, full disks, kills and Ctrl-C."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from bench import __main__ as command
from bench import options, programs, progress, store

ROOT = Path(__file__).resolve().parents[2]


def parsed(*words: str):
    got = command.parser().parse_args(words)
    options.settle(got)
    return got


def test_options_stand_before_and_after_the_subcommand(tmp_path):
    first = parsed("--budget", "5", "--scene", "cornell", "--cache", str(tmp_path), "--full", "rays")
    last = parsed("rays", "--budget", "5", "--scene", "cornell", "--cache", str(tmp_path), "--full")
    assert vars(first) == vars(last)
    assert (first.budget, first.scene, first.cache, first.full) == (5.0, ["cornell"], tmp_path, True)


def test_the_budget_is_18_minutes_and_none_in_full():
    assert parsed("memory").budget == 1080.0
    assert parsed("memory", "--full").budget == 0.0
    assert parsed("memory", "--full", "--budget", "60").budget == 60.0


def test_all_shares_its_budget(tmp_path, monkeypatch):
    budgets = []

    class Fake:
        @staticmethod
        def add_arguments(commands):
            commands.add_parser("one")

        @staticmethod
        def run(chosen, found):
            budgets.append(chosen.budget)
            return 0

    monkeypatch.setattr(command, "MODULES", {"one": Fake})
    assert command.main(["all", "--budget", "100", "--cache", str(tmp_path)]) == 0
    assert budgets == [pytest.approx(100, abs=5)]
    monkeypatch.setattr(Fake, "run", staticmethod(lambda chosen, found: 1))
    assert command.main(["all", "--cache", str(tmp_path)]) == 1


def test_all_goes_on_after_a_failure_but_not_after_a_full_disk(tmp_path, monkeypatch, capsys):
    class Fake:
        def __init__(self, name, error):
            self.name, self.error = name, error

        def add_arguments(self, commands):
            commands.add_parser(self.name)

        def run(self, chosen, found):
            print(f"{self.name} ran")
            if self.error:
                raise self.error
            return 0

    fakes = {"a": Fake("a", RuntimeError("broken")), "b": Fake("b", None), "c": Fake("c", store.DiskFull("full"))}
    fakes["d"] = Fake("d", None)
    monkeypatch.setattr(command, "MODULES", fakes)
    assert command.main(["all", "--cache", str(tmp_path)]) == 1
    said = capsys.readouterr()
    assert "b ran" in said.out and "d ran" not in said.out
    assert "a: broken" in said.err and "full" in said.err


def test_a_run_that_would_overrun_is_not_started(tmp_path):
    records = store.Store(tmp_path / "r.jsonl", 10.0)
    key = ("run", "engine", 1)
    assert not records.out_of_time(key)
    records.asked -= 8.0
    records.add(key, {})
    assert records.estimate(("run", "engine", 2)) == pytest.approx(8.0, abs=0.5)
    assert not records.out_of_time(("run", "engine", 2))
    records.end -= 3.0
    assert records.out_of_time(("run", "engine", 2))
    assert records.stopped
    assert not records.out_of_time(("run", "another", 2))


def test_the_line_of_a_step_tells_the_time_left(tmp_path, capsys):
    clock = iter([0.0, 10.0, 20.0])
    steps = progress.Progress(3, store.Store(tmp_path / "r.jsonl", 100.0), clock=lambda: next(clock))
    steps.step("cornell, PT")
    steps.step("cornell, SPPM")
    steps.step("ring, PT")
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith("[1/3] cornell, PT … ") and "to go" not in lines[0]
    assert "left of the budget, about 20 s to go" in lines[1]
    assert "[3/3] ring, PT" in lines[2] and "about 10 s to go" in lines[2]


def test_a_torn_line_does_not_swallow_the_next_record(tmp_path):
    path = tmp_path / "r.jsonl"
    path.write_text('{"key": ["a"], "x": 1}\n{"key": ["to')
    store.Store(path).add(("b",), {"x": 2})
    again = store.Store(path)
    assert again.get("a")["x"] == 1 and again.get("b")["x"] == 2


LIMITED = """
import resource, sys
from pathlib import Path
from bench import __main__ as command, options
class Fake:
    def add_arguments(commands): commands.add_parser("fake")
    def run(chosen, found):
        records = options.records_of(chosen, "fake")
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        for i in range(100):
            if not records.get("run", i): records.add(("run", i), {"text": "x" * 90})
        return 0
command.MODULES = {"fake": Fake}
sys.exit(command.main(["fake", "--cache", sys.argv[1]]))
"""


def test_a_disk_that_fills_ends_in_one_sentence_and_keeps_what_is_there(tmp_path):
    done = subprocess.run([sys.executable, "-c", LIMITED, tmp_path], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 1
    said = done.stderr.strip()
    assert "\n" not in said and "fake.jsonl could not be written" in said
    assert "are needed" in said and "are kept" in said
    kept = store.Store(tmp_path / "fake.jsonl")
    assert 10 < len(kept.records) < 100
    assert (tmp_path / "fake.jsonl").read_bytes().endswith(b"}\n")
    assert f"the {len(kept.records)} records" in said


def test_a_full_disk_under_a_program_is_told_as_such(tmp_path):
    found = store.failure("it failed", [(0.0, "write: No space left on device")], tmp_path / "a.exr")
    assert isinstance(found, store.DiskFull)
    assert not isinstance(store.failure("it failed", [(0.0, "no such scene")], tmp_path / "a.exr"), store.DiskFull)


def test_a_full_disk_while_a_result_is_saved(tmp_path, monkeypatch, capsys):
    class Fake:
        @staticmethod
        def add_arguments(commands):
            commands.add_parser("fake")

        @staticmethod
        def run(chosen, found):
            raise OSError(errno.ENOSPC, "No space left on device", "result.json")

    monkeypatch.setattr(command, "MODULES", {"fake": Fake})
    assert command.main(["fake", "--cache", str(tmp_path)]) == 1
    assert capsys.readouterr().err.count("\n") == 1


KILLED = """
import os, sys, time
from pathlib import Path
from bench import store
records = store.Store(Path(sys.argv[1]))
for i in range(20):
    if not records.get("run", i):
        time.sleep(0.05)
        records.add(("run", i), {"by": os.getpid()})
"""


def test_a_killed_run_goes_on_where_it_was(tmp_path):
    path = tmp_path / "r.jsonl"
    first = subprocess.Popen([sys.executable, "-c", KILLED, path], cwd=ROOT)
    while not path.exists() or len(path.read_text().splitlines()) < 5:
        time.sleep(0.02)
    first.kill()
    first.wait()
    before = len(store.Store(path).records)
    subprocess.run([sys.executable, "-c", KILLED, path], cwd=ROOT, check=True)
    makers = [store.Store(path).get("run", i)["by"] for i in range(20)]
    assert 5 <= before < 20
    assert makers[:before] == [first.pid] * before
    assert first.pid not in makers[before:]


INTERRUPTED = """
import sys
from bench import __main__ as command, measure
class Fake:
    def add_arguments(commands): commands.add_parser("fake")
    def run(chosen, found):
        print("started", flush=True)
        measure.run([sys.executable, "-c", "import os, sys, time; open(sys.argv[1], 'w').write(str(os.getpid())); "
                     "time.sleep(60)", sys.argv[1] + "/pid"])
command.MODULES = {"fake": Fake}
sys.exit(command.main(["fake", "--cache", sys.argv[1]]))
"""


def started(folder: Path) -> tuple[subprocess.Popen, int]:
    """The bench with a program under it, and that program's process number. Ctrl-C reaches it even where the tests run
    in the background, whose programs inherit that it is ignored."""
    process = subprocess.Popen(
        [sys.executable, "-c", INTERRUPTED, folder],
        cwd=ROOT,
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    while not (folder / "pid").exists() or not (folder / "pid").read_text():
        time.sleep(0.02)
    return process, int((folder / "pid").read_text())


def gone(pid: int) -> bool:
    end = time.monotonic() + 10
    while time.monotonic() < end:
        try:
            os.kill(pid, 0)
            if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except (ProcessLookupError, FileNotFoundError):
            return True
        time.sleep(0.05)
    return False


def test_ctrl_c_ends_with_one_line_and_takes_the_program_with_it(tmp_path):
    process, child = started(tmp_path)
    process.send_signal(signal.SIGINT)
    said = process.communicate(timeout=20)[1].strip()
    assert process.returncode == 130
    assert said.startswith("Stopped.") and "\n" not in said
    assert gone(child)


def test_a_killed_bench_leaves_no_program_behind(tmp_path):
    process, child = started(tmp_path)
    process.kill()
    process.communicate()
    assert gone(child)


def test_a_new_build_has_another_digest(tmp_path):
    folder = tmp_path / "cardioid"
    folder.mkdir()
    (folder / "_core.so").write_bytes(b"one")
    before = programs.of_addon(folder)
    programs.of_addon.cache_clear()
    (folder / "_core.so").write_bytes(b"two")
    assert programs.of_addon(folder) != before
    assert len(programs.digest(sys.executable, str(tmp_path))) == 8
