# SPDX-License-Identifier: GPL-3.0-or-later
"""CPU seconds and memory of process trees, counted from outside."""

import sys
import time

import pytest

from bench import measure

SPIN = "import time\nend = time.process_time() + {seconds}\nwhile time.process_time() < end: pass\n"


def python(code: str) -> list[str]:
    return [sys.executable, "-c", code]


def test_cpu_seconds_of_one_process():
    idle = measure.run(python("pass")).cpu
    assert measure.run(python(SPIN.format(seconds=0.5))).cpu - idle == pytest.approx(0.5, abs=0.25)


def test_children_that_were_waited_for_count():
    child = SPIN.format(seconds=0.4)
    code = f"import subprocess, sys\nfor _ in range(2): subprocess.run([sys.executable, '-c', {child!r}])"
    assert measure.run(python(code)).cpu > 0.75


def test_orphans_count():
    child = SPIN.format(seconds=0.6)
    code = f"import subprocess, sys\nsubprocess.Popen([sys.executable, '-c', {child!r}], stdout=subprocess.DEVNULL)"
    assert measure.run(python(code)).cpu > 0.55


def test_sleeping_costs_wall_time_only():
    cost = measure.run(python("import time; time.sleep(0.5)"))
    assert cost.wall >= 0.5
    assert cost.cpu < 0.4


def test_peak_memory():
    # both above this process's own size, which the kernel counts as the child's until it has become the new program
    small, large = (measure.run(python(f"x = bytearray({n} << 20)")).peak_bytes for n in (300, 500))
    assert large - small == pytest.approx(200 * 2**20, rel=0.05)


def test_the_exit_code_and_the_lines_with_their_times():
    cost = measure.run(
        python("import time; print('one', flush=True); time.sleep(0.3); print('two'); raise SystemExit(3)")
    )
    assert cost.code == 3
    assert [text for _, text in cost.lines] == ["one", "two"]
    assert cost.lines[1][0] - cost.lines[0][0] == pytest.approx(0.3, abs=0.2)


def test_it_stops_at_the_line_that_was_waited_for():
    start = time.monotonic()
    cost = measure.run(
        python("import time; print('ready', flush=True); time.sleep(60)"), until=lambda text: text == "ready"
    )
    assert cost.code == 0
    assert time.monotonic() - start < 20


def test_a_timeout_is_a_failure():
    assert measure.run(python("import time; time.sleep(60)"), timeout=0.5).code != 0
