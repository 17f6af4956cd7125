# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: repeats the search index as a script, which a page that is opened from disk can load."""

from __future__ import annotations

from pathlib import Path


def on_post_build(config, **_) -> None:
    index = Path(config["site_dir"]) / "search" / "search_index.json"
    index.with_suffix(".js").write_text(f"var __index = {index.read_text()}")
