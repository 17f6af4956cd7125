# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a built site and fails where a page would fetch anything from the network, or a picture or page is missing.

usage: check_site.py build/docs
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

# Attributes that a browser fetches by itself while a page is read. Links that a reader follows may leave the site.
FETCHED = {"script": "src", "img": "src", "source": "src", "iframe": "src", "video": "src", "audio": "src"}
FETCHED_RELATIONS = {"stylesheet", "icon", "preload", "preconnect", "dns-prefetch", "manifest"}


class _Page(HTMLParser):
    """Collects (address, fetched) of a page's references."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[tuple[str, bool]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {key: value or "" for key, value in attrs}
        if tag in FETCHED and FETCHED[tag] in values:
            self.found.append((values[FETCHED[tag]], True))
        elif tag == "link" and FETCHED_RELATIONS & set(values.get("rel", "").split()):
            self.found.append((values.get("href", ""), True))
        elif tag == "a" and "href" in values:
            self.found.append((values["href"], False))


def problems(site: Path) -> Iterator[str]:
    """One line for each reference that must not be there or leads nowhere."""
    for path in sorted(site.rglob("*.html")):
        page = _Page()
        page.feed(path.read_text())
        for address, fetched in page.found:
            parts = urlsplit(address)
            if parts.scheme == "data" or not (parts.path or parts.netloc):
                continue
            if parts.scheme or parts.netloc:
                if fetched:
                    yield f"{path.relative_to(site)}: fetches {address}"
            elif path.name != "404.html" and not (path.parent / unquote(parts.path)).exists():
                yield f"{path.relative_to(site)}: {address} is not there"


def main(arguments: list[str]) -> int:
    site = Path(arguments[0])
    if not (site / "index.html").is_file():
        print(f"error: {site} is not a built site")
        return 1
    found = list(problems(site))
    for line in found:
        print(f"error: {line}")
    print(f"{len(list(site.rglob('*.html')))} pages, {len(found)} problems")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
