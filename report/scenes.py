# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of the results, grouped into those that can be compared: one subcommand, one scene, one size."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PIL import Image

from bench.result import Picture, Result

from . import crops


@dataclass
class Shot:
    """A picture that could be opened. `name`: its label, told apart from equal ones."""

    picture: Picture
    image: Image.Image
    name: str


@dataclass
class Comparison:
    """Pictures of one scene and size; `places`: top left corners of the crops, squares of `side` pixels."""

    result: str
    scene: str
    shots: list[Shot]
    places: list[crops.Place] = field(default_factory=list)
    side: int = 0

    @property
    def key(self) -> tuple:
        """Of this comparison among all."""
        return self.result, self.scene, self.size

    @property
    def part(self) -> str:
        """What of the scene is shown, where it is not the whole: what stands after its name and a comma."""
        return self.scene.partition(", ")[2]

    @property
    def reference(self) -> Shot | None:
        return next((s for s in self.shots if s.picture.reference), None)

    @property
    def size(self) -> tuple[int, int]:
        return self.shots[0].image.size


def inside(folder: Path, file: str) -> Path:
    """A file of a result's folder. ValueError if the name leads out of it."""
    path = (folder / file).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise ValueError(f"{file} is outside of the result's folder")
    return path


def open_picture(folder: Path, file: str) -> Image.Image:
    """The picture's pixels, RGB. OSError or ValueError if there are none."""
    with Image.open(inside(folder, file)) as image:
        return image.convert("RGB")


def _named(shots: list[Shot]) -> None:
    """Equal labels get their settings, or a number if these are equal too."""
    labels = [s.picture.label for s in shots]
    for shot in shots:
        if labels.count(shot.picture.label) > 1 and shot.picture.settings:
            shot.name = f"{shot.picture.label} ({shot.picture.settings})"
    seen: dict[str, int] = {}
    for shot in shots:
        seen[shot.name] = seen.get(shot.name, 0) + 1
        if seen[shot.name] > 1:
            shot.name += f" [{seen[shot.name]}]"


def _comparison(result: str, scene: str, shots: list[Shot]) -> Comparison:
    """With the reference first and its crops chosen."""
    shots = sorted(shots, key=lambda s: not s.picture.reference)
    _named(shots)
    made = Comparison(result, scene, shots)
    if len(shots) > 1:
        made.side = crops.side(made.size[1], made.size[0])
        pixels = [np.asarray(s.image, np.float32) / 255.0 for s in shots]
        first = pixels.pop(0) if made.reference else None
        made.places = crops.places(pixels, first, made.side)
    return made


def compare(result: Result, folder: Path, problems: list[str]) -> list[Comparison]:
    """The result's comparisons in the order of its pictures; what cannot be shown is added to `problems`."""
    groups: dict[str, dict[tuple[int, int], list[Shot]]] = {}
    for picture in result.pictures:
        try:
            image = open_picture(folder, picture.file)
        except (OSError, ValueError, Image.DecompressionBombError) as error:
            problems.append(f"{result.name}: a picture of {picture.scene} cannot be shown: {picture.label} ({error})")
            continue
        groups.setdefault(picture.scene, {}).setdefault(image.size, []).append(Shot(picture, image, picture.label))
    out = []
    for scene, by_size in groups.items():
        if len(by_size) > 1:
            sizes = ", ".join(
                f"{w} × {h}: {' and '.join(s.picture.label for s in shots)}" for (w, h), shots in by_size.items()
            )
            problems.append(f"{result.name}: pictures of {scene} have different sizes, not compared: {sizes}")
        out += [_comparison(result.name, scene, shots) for shots in by_size.values()]
    return out
