# SPDX-License-Identifier: GPL-3.0-or-later
"""The docs' gallery: Markdown and small JPEG pictures."""

from __future__ import annotations

import re
from pathlib import Path

from PIL import Image

from . import encode, files, view
from .collect import DEMO
from .scenes import Comparison, Shot

ROOT = Path(__file__).resolve().parents[1]
PEERS = "peers"
"""The result whose pictures stand beside each other in the docs."""
LIMIT = 200_000
"""Bytes of a picture in the docs."""
GAP = 6
"""Pixels between two pictures side by side."""


def captions(readme: Path) -> dict[str, str]:
    """What each scene shows, from the table of scenes/README.md."""
    rows = re.findall(r"^\| `(\w+)\.blend` \| (.+?) \|", readme.read_text(), re.MULTILINE)
    return dict(rows)


def title(scene: str) -> str:
    return scene.replace("_", " ").capitalize()


def scene_names() -> list[str]:
    """Of the files of scenes/."""
    return sorted(path.stem for path in (ROOT / "scenes").glob("*.blend"))


def pair(left: Image.Image, right: Image.Image) -> Image.Image:
    """Two pictures of one size side by side."""
    both = Image.new("RGB", (2 * left.width + GAP, left.height), "white")
    both.paste(left, (0, 0))
    both.paste(right, (left.width + GAP, 0))
    return both


def escaped(text: str) -> str:
    """Text for a cell of a Markdown table; its HTML and its marks are shown as they are."""
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([\\`*_\[\]|])", r"\\\1", text).replace("\n", " ")


def row(shot: Shot) -> str:
    """Name, error, energy ratio and CPU seconds of a picture, and how it was made."""
    cells = [f"**{escaped(shot.name)}**" if view.ours(shot) else escaped(shot.name)]
    if shot.picture.reference:
        cells += ["reference", "", "" if shot.picture.cpu is None else f"{shot.picture.cpu:.0f} s"]
    else:
        cells += [text for _, text, _ in view.figures(shot.picture)]
    return "| " + " | ".join([*cells, escaped(shot.picture.settings)]) + " |"


def _demo_part(one: Comparison, what: str, folder: Path) -> str:
    """A scene's picture with the command under it."""
    shot = one.shots[0]
    name = f"{view.slug(one.scene).replace('-', '_')}.jpg"
    files.write_bytes(folder / name, encode.jpeg_under(shot.image, LIMIT))
    cpu = "" if shot.picture.cpu is None else f" {shot.picture.cpu:.0f} CPU seconds."
    picture = f"![{escaped(what.replace('`', '') or title(one.scene))}](images/gallery/{name})"
    return (
        f"## {title(one.scene)}\n\n{picture}\n\n"
        f"{what[:1].upper() + what[1:]}{'.' if what else ''}{cpu}\n\n    {shot.picture.settings}\n"
    )


def _pair_part(one: Comparison, folder: Path) -> str:
    """Two renderers side by side, and the figures of all."""
    left, right = (one.shots[i] for i in view.first_pair(one))
    name = f"{view.slug(one.scene)}-{view.slug(one.result)}-{one.size[0]}x{one.size[1]}.jpg"
    files.write_bytes(folder / name, encode.jpeg_under(pair(left.image, right.image), LIMIT))
    table = "\n".join(row(s) for s in one.shots)
    return (
        f"### {title(one.scene)}\n\n![{escaped(f'Left: {left.name}. Right: {right.name}')}](images/gallery/{name})\n\n"
        f"Left: {escaped(left.name)}. Right: {escaped(right.name)}. From `./scripts/bench {one.result}`.\n\n"
        f"| | relMSE | energy | CPU | settings |\n|---|---:|---:|---:|---|\n{table}\n"
    )


def write(docs: Path, comparisons: list[Comparison]) -> str:
    """DOCS/gallery.md and DOCS/images/gallery/*.jpg; says what was written. Other pictures there stay."""
    folder = docs / "images" / "gallery"
    what = captions(ROOT / "scenes" / "README.md")
    parts = [
        "# Gallery\n\nThe scenes of `scenes/`, each rendered by Cardioid with the command under it, in the checkout,"
        " the add-on being installed (`./scripts/demo` does that). No retouching. `./scripts/report"
        " --demo --gallery docs` renders every scene that has no picture yet, and writes this page."
        " `scenes/README.md` says how the scenes are built.\n"
    ]
    parts += [_demo_part(c, what.get(c.scene, ""), folder) for c in comparisons if c.result == DEMO]
    waiting = [
        title(name) for name in scene_names() if not any(c.result == DEMO and c.scene == name for c in comparisons)
    ]
    if waiting:
        parts[0] += f"\nNo picture yet: {', '.join(waiting)}.\n"
    pairs = [c for c in comparisons if c.result == PEERS and len(c.shots) > 1]
    if pairs:
        parts.append(
            "## Beside other renderers\n\nrelMSE is the error against the reference, energy the mean over the"
            " reference's, CPU the seconds of all cores. A dash: not measured.\n"
        )
    parts += [_pair_part(c, folder) for c in pairs]
    files.write_bytes(docs / "gallery.md", "\n".join(parts).encode())
    return f"{docs / 'gallery.md'}: {len(parts) - 1 - bool(pairs)} pictures"
