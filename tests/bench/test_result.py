# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of the bench as files."""

from __future__ import annotations

import pytest

from bench import result


def example() -> result.Result:
    table = result.Table(
        "errors", "Errors", {"scene": ["scene", ""]}, [{"scene": "ring", "cpu": 1.5}, {"scene": "box"}]
    )
    verdict = result.Verdict("lower at all times", "thesis 5.7", False, "2 of 9 over")
    return result.Result("peers", "Peers", "./scripts/bench peers --full", True, [table], verdicts=[verdict])


def test_a_result_is_read_back_as_it_was_written(tmp_path):
    written = example()
    result.save(written, tmp_path)
    assert result.load_all(tmp_path) == [written]
    assert written.machine["cores"] >= 1 and written.made


def test_tables_are_csv_files_with_every_column(tmp_path):
    where = result.save(example(), tmp_path)
    assert (where / "errors.csv").read_text() == "scene,cpu\nring,1.5\nbox,\n"


def test_a_picture_that_is_not_there_is_refused(tmp_path):
    one = example()
    one.pictures.append(result.Picture("ring", "Cardioid", "ring.png"))
    with pytest.raises(FileNotFoundError, match=r"ring\.png"):
        result.save(one, tmp_path)


@pytest.mark.parametrize("text", ["", "{", "{}", '{"format": 99}', '{"format": 1, "colour": 3}'])
def test_other_files_are_refused_by_name(tmp_path, text):
    (tmp_path / "result.json").write_text(text)
    with pytest.raises(ValueError, match=r"result\.json: no result of the bench"):
        result.load(tmp_path)


def test_what_does_not_hold_is_said():
    said = result.show(example())
    assert "DOES NOT HOLD: lower at all times" in said
    assert "./scripts/bench peers --full" in said


def test_a_failed_write_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "result.json"
    result.write_atomically(path, "old")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(result.os, "replace", full)
    with pytest.raises(OSError, match="No space"):
        result.write_atomically(path, "new")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
