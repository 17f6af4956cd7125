# SPDX-License-Identifier: GPL-3.0-or-later
"""Strands of hair as Blender has them: particle systems that render paths, and objects of hair curves."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import Any

import numpy as np

from .arrays import foreach
from .names import unit_hash
from .tubes import Strands


def particle_systems(obj: Any, show: str) -> list[Any]:
    """Modifiers of `obj` whose particles are hair that is drawn as paths. show: "show_render" or "show_viewport"."""
    return [m for m in obj.modifiers if m.type == "PARTICLE_SYSTEM" and getattr(m, show)
            and m.particle_system.settings.type == "HAIR" and m.particle_system.settings.render_type == "PATH"]


def of_particles(obj: Any, modifiers: list[Any], slots: int, background: bool) -> list[Strands]:
    """Strands in object space, one entry per system. `slots`: material slots of the object."""
    found: list[Strands] = []
    first = 0
    for modifier in modifiers:
        system = modifier.particle_system
        numbers = _numbers(system, background)
        if not numbers:
            continue
        settings = system.settings
        keys = _keys(obj, system, numbers, settings.render_step if background else settings.display_step)
        slot = min(max(settings.material - 1, 0), max(slots - 1, 0))
        found.append(Strands(
            keys, _radii(keys, settings), np.full(len(keys), slot, np.int32),
            unit_hash(np.arange(first, first + len(keys), dtype=np.uint64)).astype(np.float32),
            _on_emitter(obj, modifier, numbers)))
        first += len(keys)
    return found


def _numbers(system: Any, background: bool) -> range:
    """Particle numbers that are drawn: children in place of their parents where there are any."""
    parents, children = len(system.particles), len(system.child_particles)
    if not background:
        children = int(children * system.settings.display_percentage / 100)
    return range(parents if system.settings.child_type != "NONE" and children else 0, parents + children)


def _keys(obj: Any, system: Any, numbers: range, step: int) -> np.ndarray:
    count = (1 << step) + 1
    if system.settings.kink == "SPIRAL":
        count += system.settings.kink_extra_steps
    co_hair = system.co_hair
    flat = [v for number in numbers for key in range(count) for v in co_hair(obj, particle_no=number, step=key)]
    world = np.array(flat, np.float32).reshape(len(numbers), count, 3)
    # Keys that a short path does not have are at the origin: they stay at the one before.
    to_object = np.array(obj.matrix_world.inverted_safe(), np.float32)
    return world @ to_object[:3, :3].T + to_object[:3, 3]


def _radii(keys: np.ndarray, settings: Any) -> np.ndarray:
    """(n, k): from root to tip by the length along the strand, bent by the shape."""
    along = np.zeros(keys.shape[:2], np.float32)
    np.cumsum(np.linalg.norm(np.diff(keys, axis=1), axis=2), axis=1, out=along[:, 1:])
    rest = 1 - along / np.maximum(along[:, -1:], 1e-20)
    shape = settings.shape
    if shape:
        rest = np.power(np.clip(rest, 0, 1), 1 + shape if shape < 0 else 1 / max(1 - shape, 1e-6))
    scale = settings.radius_scale / 2
    found = (rest * (settings.root_radius - settings.tip_radius) + settings.tip_radius) * scale
    if settings.use_close_tip:
        found[:, -1] = 0
    return found.astype(np.float32)


def _on_emitter(obj: Any, modifier: Any, numbers: range) -> dict[str, np.ndarray]:
    """UV maps of the emitter where the strands grow."""
    system = modifier.particle_system
    particles = system.particles
    if obj.type != "MESH" or not len(particles):
        return {}
    layers = {}
    for index, layer in enumerate(obj.data.uv_layers):
        values = [system.uv_on_emitter(modifier, particle=particles[n if n < len(particles) else 0], particle_no=n,
                                       uv_no=index) for n in numbers]
        layers[layer.name] = np.array(values, np.float32).reshape(-1, 2)
    return layers


def of_curves(data: Any, wanted: Set[str]) -> list[Strands]:
    """Strands of a hair curves data-block, grouped by their number of points."""
    points = foreach(data.points, "position", np.float32, 3)
    counts = foreach(data.curves, "points_length", np.int32)
    firsts = foreach(data.curves, "first_point_index", np.int32)
    radius = data.attributes.get("radius")
    radii = np.full(len(points), 0.005, np.float32) if radius is None else foreach(radius.data, "value", np.float32)
    layers = list(_curve_layers(data, wanted))
    found = []
    for count in np.unique(counts[counts > 1]):
        curves = np.flatnonzero(counts == count)
        places = firsts[curves][:, None] + np.arange(count)
        found.append(Strands(
            points[places], radii[places], np.zeros(len(curves), np.int32),
            unit_hash(curves.astype(np.uint64)).astype(np.float32),
            {name: values[curves] for name, domain, values in layers if domain == "CURVE"},
            {name: values[places] for name, domain, values in layers if domain == "POINT"}))
    return found


def curve_uv(data: Any) -> str:
    """The attribute that stands for a UV map: the first two-dimensional one of the strands."""
    return next((a.name for a in data.attributes if a.data_type == "FLOAT2" and a.domain == "CURVE"), "")


def _curve_layers(data: Any, wanted: Set[str]) -> Iterator[tuple[str, str, np.ndarray]]:
    uv = curve_uv(data)
    for attribute in data.attributes:
        if attribute.name in wanted or attribute.name == uv:
            values = values_of(attribute)
            if values is not None:
                yield attribute.name, attribute.domain, values


def values_of(attribute: Any) -> np.ndarray | None:
    """(n, c) floats of an attribute, or None for types that nodes do not read."""
    kinds = {"FLOAT": ("value", 1), "FLOAT2": ("vector", 2), "FLOAT_VECTOR": ("vector", 3), "FLOAT_COLOR": ("color", 4),
             "BYTE_COLOR": ("color", 4)}
    if attribute.data_type not in kinds:
        return None
    name, channels = kinds[attribute.data_type]
    return foreach(attribute.data, name, np.float32, channels).reshape(-1, channels)
