# SPDX-License-Identifier: GPL-3.0-or-later
"""`./scripts/report`: one HTML page, and with --gallery the docs' gallery, from the results of ./scripts/bench."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from . import collect, demo, files, gallery, page

ROOT = Path(__file__).resolve().parents[1]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="scripts/report", description=__doc__)
    parser.add_argument(
        "--cache", type=Path, default=ROOT / "build/bench", metavar="DIR", help="of the bench (default: build/bench)"
    )
    parser.add_argument(
        "--out", type=Path, default=ROOT / "build/report", metavar="DIR", help="for the page (default: build/report)"
    )
    parser.add_argument(
        "--gallery",
        type=Path,
        metavar="DOCS",
        help="also write DOCS/gallery.md and DOCS/images/gallery/*.jpg, from the same results",
    )
    parser.add_argument(
        "--demo",
        action="store_true",
        help="first render the demo picture of each scene of scenes/ into the cache; those that are there stay",
    )
    parser.add_argument(
        "--scene", action="append", metavar="NAME", help="with --demo: only this scene; may be repeated"
    )
    parser.add_argument(
        "--samples", type=int, default=demo.SAMPLES, help="with --demo: of a pixel (default: %(default)s)"
    )
    parser.add_argument("--percent", type=int, default=100, help="with --demo: of the scene's size (default: 100)")
    return parser.parse_args()


def run(options: argparse.Namespace) -> None:
    """Writes what was asked for and says what it wrote. OSError or ValueError says why not."""
    if options.demo:
        demo.render_all(options.cache, options.scene, options.samples, options.percent)
    made = page.build(collect.collect(options.cache))
    target = options.out / "index.html"
    files.write_bytes(target, made.html.encode())
    for problem in made.problems:
        print(f"warning: {problem}")
    shots = sum(len(c.shots) for c in made.comparisons)
    print(f"{os.path.relpath(target)}: {made.size / 1e6:.1f} MB, {shots} pictures (WebP, quality {made.quality})")
    if options.gallery:
        print(gallery.write(options.gallery, made.comparisons))


def main() -> int:
    try:
        run(arguments())
    except (OSError, ValueError) as error:
        print(f"scripts/report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
