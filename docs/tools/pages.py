# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the pages of docs/ without MkDocs: their links, headings and place in the site's navigation."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"

_FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)
_INDENTED = re.compile(r"(?:^|\n\n)(?: {4}[^\n]*(?:\n|$))+")
_CODE = re.compile(r"`+[^`\n]+`+")
_LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
_HTML = re.compile(r"<(?:img|a|script|link|source|iframe)\b[^>]*?\b(?:src|href)=\"([^\"]+)\"")
_REFERENCE = re.compile(r"^\[[^\]]+\]:\s+(\S+)", re.MULTILINE)
_HEADING = re.compile(r"^#{1,6} +(.+?)\s*#*$", re.MULTILINE)


@dataclass(frozen=True)
class Link:
    """A link or picture as it stands in a page: `target` may be empty (this page) or have an address's scheme."""

    page: Path
    target: str
    anchor: str


def pages() -> list[Path]:
    return sorted(DOCS.glob("*.md"))


def without_code(text: str) -> str:
    """The text without code blocks and spans, in which brackets are no links."""
    text = _FENCE.sub("", text)
    return _CODE.sub("", _INDENTED.sub("\n\n", text))


def links(page: Path) -> list[Link]:
    text = without_code(page.read_text())
    found = []
    for target in [*_LINK.findall(text), *_REFERENCE.findall(text), *_HTML.findall(text)]:
        path, _, anchor = target.partition("#")
        found.append(Link(page, unquote(path), anchor))
    return found


def slug(heading: str) -> str:
    """The anchor that the site gives a heading (as Python-Markdown's toc does)."""
    heading = re.sub(r"`|\*\*|\*", "", heading)
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    ascii_only = unicodedata.normalize("NFKD", heading).encode("ascii", "ignore").decode()
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", ascii_only).strip().lower())


def anchors(page: Path) -> set[str]:
    """Anchors of a page; headings that repeat get _1, _2, …"""
    text = _FENCE.sub("", page.read_text())
    found: set[str] = set(re.findall(r'\bid="([^"]+)"', text)) | set(re.findall(r"\{ *#([\w-]+)", text))
    for heading in _HEADING.findall(text):
        name, count = slug(heading), 0
        while (f"{name}_{count}" if count else name) in found:
            count += 1
        found.add(f"{name}_{count}" if count else name)
    return found


def navigation() -> list[str]:
    """The pages of mkdocs.yml's nav, in order."""
    text = (ROOT / "mkdocs.yml").read_text()
    return re.findall(r":\s+([\w-]+\.md)\s*$", text.partition("\nnav:\n")[2], re.MULTILINE)


def broken(link: Link) -> str:
    """What is wrong with a link inside the site; empty when it is fine or leaves the site."""
    if re.match(r"[a-z]+:", link.target):
        return ""
    target = (link.page.parent / link.target).resolve() if link.target else link.page
    where = f"{link.page.name}: {link.target}{'#' if link.anchor else ''}{link.anchor}"
    if not target.is_file():
        return f"{where}: no such file"
    if not target.is_relative_to(DOCS):
        return f"{where}: outside docs/, so not a part of the site"
    if link.anchor and target.suffix == ".md" and link.anchor not in anchors(target):
        return f"{where}: no such heading"
    return ""
