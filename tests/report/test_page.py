# SPDX-License-Identifier: GPL-3.0-or-later
"""What the page says, how pictures are chosen, and that files are whole."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import conftest
import numpy as np
import pytest
from PIL import Image

from bench.result import Picture, save
from report import collect, crops, encode, files, gallery, page, view
from report.scenes import Comparison, Shot

ROOT = Path(__file__).resolve().parents[2]


def command(cache: Path, out: Path, *more: str, **options) -> subprocess.CompletedProcess:
    """`./scripts/report` without its set-up."""
    words = [sys.executable, "-m", "report", "--cache", str(cache), "--out", str(out), *more]
    return subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False, **options)


def test_the_page_holds_everything_and_fetches_nothing(cache: Path) -> None:
    html = page.build(collect.collect(cache)).html
    for text in ("LuxCore: not installed", "no clamping", "Testron 9", "abc1234", "30.1 s against 12.3 s", "reduced"):
        assert text in html
    for text in ("0.457", "0.913", "30.5 s"):
        assert text in html
    assert "http" not in html.replace("http-equiv", "")
    assert "url(" not in html


def test_names_with_html_are_escaped(cache: Path) -> None:
    result = conftest.peers(cache)
    for one in result.pictures:
        one.label, one.settings = f"{one.label} {conftest.HTML}", conftest.HTML
        one.scene = f"{one.scene}{conftest.HTML}"
    result.tables[0].note = f"`{conftest.HTML}`"
    result.settings, result.missing, result.title = {conftest.HTML: conftest.HTML}, [conftest.HTML], conftest.HTML
    save(result, cache)
    html = page.build(collect.collect(cache)).html
    assert "<img src=x" not in html
    assert "&lt;img src=x" in html
    assert "<code>&lt;img src=x onerror=&#34;alert(1)&#34;&gt;</code>" in html


def test_pictures_lose_quality_before_the_page_is_too_large(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    large = page.build(collect.collect(cache))
    monkeypatch.setattr(page, "SIZE_LIMIT", large.size - 100)
    small = page.build(collect.collect(cache))
    assert (large.quality, small.quality) == (92, 85)
    assert "lowered to keep the page small" in small.html


def test_the_first_crop_is_where_the_pictures_differ_most() -> None:
    reference = conftest.gradient(0.2)
    noisy = reference.copy()
    x, y = conftest.SPOT
    noisy[y : y + 44, x : x + 44] += 0.2
    noisy[3, 3] = 5000.0
    found = crops.places([noisy, reference], reference, 44)
    assert found[0] == conftest.SPOT
    noisy[4:12, 4:12] += 0.01
    further = crops.places([noisy, reference], reference, 44)[1:]
    assert further
    assert all(abs(x - a) >= 88 or abs(y - b) >= 88 for a, b in further)


def test_equal_pictures_have_no_crops() -> None:
    assert crops.places([conftest.gradient(0.2)] * 2, None, 44) == []


def shot(label: str, error: float | None, cpu: float, reference: bool = False) -> Shot:
    return Shot(Picture("s", label, "f", "", cpu, error, 1.0, reference), Image.new("RGB", (4, 4)), label)


def test_the_slider_begins_with_the_best_of_cycles_and_ours_at_about_equal_time() -> None:
    shots = [
        shot("Reference", None, 900.0, True),
        shot("Cycles, 120 s", 0.1, 120.0),
        shot("Cycles, 30 s", 0.2, 30.0),
        shot("Cycles full depth, 29 s", 0.3, 29.0),
        shot("LuxCore", 0.01, 29.0),
        shot("Cardioid PT", 0.3, 30.0),
        shot("Cardioid PTPPM", 0.02, 29.0),
        shot("Cardioid PTPPM + filter", 0.01, 29.0),
        shot("Cycles + OIDN", 0.01, 29.0),
    ]
    assert view.first_pair(Comparison("r", "s", shots)) == (2, 6)
    assert view.first_pair(Comparison("r", "s", [shots[0], shots[6]])) == (0, 1)
    assert view.first_pair(Comparison("r", "s", shots[1:3])) == (0, 1)


def test_missing_light_is_marked() -> None:
    assert [marked for _, _, marked in view.figures(Picture("s", "a", "f", "", 1.0, 0.5, 0.97))] == [False, True, False]
    assert [marked for _, _, marked in view.figures(Picture("s", "a", "f", "", 1.0, 0.5, 0.99))] == [
        False,
        False,
        False,
    ]
    assert view.figures(Picture("s", "a", "f", "", 1.0, 0.5, float("nan")))[1][2]
    assert [text for _, text, _ in view.figures(Picture("s", "a", "f"))] == ["–", "–", "–"]


def test_cells_follow_their_format_and_survive_a_wrong_one() -> None:
    assert view.cell(0.12345, ".2f") == view.Cell("0.12", "0.12345", True)
    assert view.cell("text", ".2f").text == "text"
    assert view.cell(float("nan"), ".2f") == view.Cell("nan", "", True)
    assert view.cell([1], ".2f").text == "[1]"
    assert view.cell(None, ".2f").text == "–"


def test_without_results_one_sentence_and_no_page(tmp_path: Path) -> None:
    done = command(tmp_path, tmp_path / "out")
    assert done.returncode == 1
    assert "run ./scripts/bench first" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert not (tmp_path / "out").exists()


def test_warnings_are_printed_too(cache: Path, tmp_path: Path) -> None:
    (cache / "results" / "rays").mkdir()
    done = command(cache, tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert "warning: rays: no result.json" in done.stdout
    assert "8 pictures" in done.stdout


def test_a_full_disk_leaves_the_old_page(cache: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    (out / "index.html").write_text("old")

    def small_files() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))

    done = command(cache, out, preexec_fn=small_files, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
    assert done.returncode == 1
    assert "cannot write" in done.stderr
    assert "index.html" in done.stderr
    assert [path.name for path in out.iterdir()] == ["index.html"]
    assert (out / "index.html").read_text() == "old"


def test_a_folder_that_is_a_file_is_told(cache: Path, tmp_path: Path) -> None:
    (tmp_path / "out").write_text("")
    done = command(cache, tmp_path / "out")
    assert done.returncode == 1
    assert "Traceback" not in done.stderr


def test_the_gallery_has_figures_and_leaves_other_pictures(cache: Path, tmp_path: Path) -> None:
    docs = tmp_path / "docs"
    files.write_bytes(docs / "images" / "gallery" / "other.jpg", b"")
    gallery.write(docs, page.build(collect.collect(cache)).comparisons)
    text = (docs / "gallery.md").read_text()
    names = sorted(path.name for path in (docs / "images" / "gallery").iterdir())
    assert names == [
        "cornell-peers-192x144.jpg",
        "other.jpg",
        "wine-glass-direct-light-peers-192x144.jpg",
        "wine-glass-peers-192x144.jpg",
    ]
    assert all(f"images/gallery/{name}" in text for name in names if name != "other.jpg")
    assert "| Cycles 3.4.1 | 0.457 | 0.913 | 30.5 s | 24 samples |" in text
    assert "| **Cardioid** | 0.0123 | 0.999 | 30.1 s | 16 samples |" in text


def test_gallery_pictures_are_small_enough() -> None:
    noise = Image.fromarray(np.random.default_rng(1).integers(0, 255, (300, 400, 3), dtype=np.uint8))
    assert len(encode.jpeg_under(noise, 20_000)) <= 20_000


def test_markdown_cells_are_escaped() -> None:
    assert gallery.escaped("a|b <c> *d*") == r"a\|b &lt;c&gt; \*d\*"
