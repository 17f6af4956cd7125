# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/tools/check_site.py on sites of a few lines."""

from __future__ import annotations

from pathlib import Path

import check_site


def site(folder: Path, body: str) -> Path:
    (folder / "index.html").write_text(f"<html><body>{body}</body></html>")
    return folder


def test_a_script_from_the_network_is_found(tmp_path: Path):
    found = list(check_site.problems(site(tmp_path, '<script src="https://cdn.example/x.js"></script>')))
    assert found == ["index.html: fetches https://cdn.example/x.js"]


def test_a_style_from_the_network_is_found(tmp_path: Path):
    assert list(check_site.problems(site(tmp_path, '<link rel="stylesheet" href="//fonts.example/a.css">')))


def test_a_link_that_a_reader_follows_may_leave(tmp_path: Path):
    body = '<a href="https://example.org/">out</a> <a href="#here">in</a>'
    assert list(check_site.problems(site(tmp_path, body))) == []


def test_a_missing_picture_is_found(tmp_path: Path):
    assert list(check_site.problems(site(tmp_path, '<img src="images/gone.png">'))) == [
        "index.html: images/gone.png is not there"
    ]


def test_no_site_is_an_error(tmp_path: Path, capsys):
    assert check_site.main([str(tmp_path)]) == 1
    assert "not a built site" in capsys.readouterr().out
