# SPDX-License-Identifier: GPL-3.0-or-later
"""Films that are kept after their render, so that the filter can be tuned. A film lives until its scene is rendered
again, another file is loaded, the artist frees it, or the add-on is switched off."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
from bpy.app.handlers import persistent

from .frame_size import Shape


@dataclass
class Kept:
    """The film of one layer and view of a scene, or one that was opened.

    shape: what the render result looked like. settings, stats: the filter's, for the picture that is shown now. entry:
    what the render was, for metadata. image: the datablock that shows an opened film; empty: the render result. source:
    the file that it was opened from.
    """

    film: Any
    shape: Shape
    settings: dict[str, Any]
    stats: dict[str, Any] = field(default_factory=dict)
    entry: dict[str, Any] = field(default_factory=dict)
    image: str = ""
    source: str = ""
    samples: int = field(init=False)
    memory_bytes: int = field(init=False)

    def __post_init__(self) -> None:
        self.samples, self.memory_bytes = self.film.samples, self.film.memory_bytes  # panels draw often


_kept: dict[tuple[str, str, str], Kept] = {}  # by scene, layer and view
_opened: dict[str, Kept] = {}                 # by the name of the image that shows it


def keep(scene: str, layer: str, view: str, kept: Kept) -> None:
    _kept[scene, layer, view] = kept


def get(scene: str, layer: str, view: str) -> Kept | None:
    return _kept.get((scene, layer, view))


def of_scene(scene: str) -> dict[tuple[str, str], Kept]:
    """By layer and view."""
    return {(key[1], key[2]): kept for key, kept in list(_kept.items()) if key[0] == scene}


def show_in_image(image: str, kept: Kept) -> None:
    kept.image = image
    _opened[image] = kept


def of_image(image: str) -> Kept | None:
    return _opened.get(image)


def opened() -> list[Kept]:
    return list(_opened.values())


def give_way(scene: str, layer: str, view: str) -> None:
    """Frees one film before the next one needs memory."""
    _kept.pop((scene, layer, view), None)


def drop(scene: str) -> None:
    """Frees the films of a scene."""
    for key in [key for key in _kept if key[0] == scene]:
        _kept.pop(key, None)


def drop_image(image: str) -> None:
    _opened.pop(image, None)


def drop_orphans() -> None:
    """Frees the films of scenes and images that are no longer in the file."""
    for key in [key for key in _kept if key[0] not in bpy.data.scenes]:
        _kept.pop(key, None)
    for name in [name for name in _opened if name not in bpy.data.images]:
        _opened.pop(name, None)


def clear() -> None:
    _kept.clear()
    _opened.clear()


@persistent
def _another_file(*_arguments) -> None:
    clear()


def register() -> None:
    bpy.app.handlers.load_pre.append(_another_file)


def unregister() -> None:
    bpy.app.handlers.load_pre.remove(_another_file)
    clear()
