# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that shading nodes read by name from placements, particles, and the view layer.

Looked up as Blender does (BKE_object_dupli_find_rgba_attribute, BKE_view_layer_find_rgba_attribute): custom properties
first, then RNA paths; what is found nowhere is zero with zero alpha.
"""

from __future__ import annotations

from numbers import Real
from typing import Any

from .instance_attributes import InstanceAttributes
from .names import unit_hash
from .needs import Needs

Color = list[float]
NOWHERE: Color = [0.0, 0.0, 0.0, 0.0]


def of_instance(instance: Any, needs: Needs, frame: float, attributes: InstanceAttributes) -> list[dict[str, Any]]:
    """InstanceDesc.values of one step of `depsgraph.object_instances`."""
    found = [{"name": f"{source}:{name}", "value": _lookup(instance, name, source == "instancer", attributes)}
             for source, name in sorted(needs.values) if name]
    if needs.particles:
        found += _particle(instance, frame)
    return found


def of_view_layer(scene: Any, layer: Any, name: str) -> Color:
    """An Attribute node of type View Layer: custom properties of the layer, the scene, the world."""
    return _first((layer, scene, scene.world), name)


def _lookup(instance: Any, name: str, instancer: bool, attributes: InstanceAttributes) -> Color:
    owners = []
    if instancer and instance.is_instance:
        system = instance.particle_system
        own = attributes.find(instance, name)
        if own is not None:
            return own
        owners += [system.settings if system else None, instance.parent]
    return _first((*owners, instance.object, instance.object.data), name)


def _first(owners: tuple[Any, ...], name: str) -> Color:
    for owner in owners:
        value = None if owner is None else _property(owner, name)
        if value is not None:
            return value
    return list(NOWHERE)


def _property(owner: Any, name: str) -> Color | None:
    """A custom property of this name, or an RNA path; None when there is no number or short vector."""
    escaped = name.replace("\\", "\\\\").replace('"', '\\"')
    for path in (f'["{escaped}"]', name):
        try:
            value = owner.path_resolve(path)
        except (ValueError, AttributeError, TypeError):
            continue
        return _color(value)
    return None


def _color(value: Any) -> Color | None:
    if isinstance(value, Real):
        return [float(value)] * 3 + [1.0]
    try:
        numbers = list(value)
    except TypeError:
        return None
    if not 1 <= len(numbers) <= 4 or isinstance(value, str) or not all(isinstance(v, Real) for v in numbers):
        return None
    return [*map(float, numbers), *NOWHERE[len(numbers):3], *([1.0] if len(numbers) < 4 else [])]


def _particle(instance: Any, frame: float) -> list[dict[str, Any]]:
    """Particle Info of the particle that placed this instance; children have none, as in Cycles."""
    system = instance.particle_system if instance.is_instance else None
    index = instance.persistent_id[0] if system else -1
    if system is None or not 0 <= index < len(system.particles):
        return _named({"index": 0, "random": unit_hash(0)})
    particle = system.particles[index]
    return _named({
        "index": index, "random": unit_hash(index), "age": frame - particle.birth_time, "lifetime": particle.lifetime,
        "size": particle.size, "location": particle.location, "velocity": particle.velocity,
        "angular_velocity": particle.angular_velocity})


def _named(values: dict[str, Any]) -> list[dict[str, Any]]:
    return [{"name": f"particle:{name}", "value": _color(value)} for name, value in values.items()]
