# SPDX-License-Identifier: GPL-3.0-or-later
"""Every placed object of the depsgraph: meshes once, their instances as instances, lamps."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from . import compat, hair, light, mesh, names, needs, pointcloud, strands, values
from .instance_attributes import InstanceAttributes
from .material import Materials
from .options import ExportCancelled, ExportOptions

_UNSUPPORTED = {"VOLUME": "volume grids are", "GPENCIL": "grease pencil is", "GREASEPENCIL": "grease pencil is"}
# What is rendered, and the view layer's filter for it.
_GEOMETRY = {"MESH": "use_solid", "CURVES": "use_strand", "POINTCLOUD": "use_solid"}
_CHECK_EVERY = 256  # instances between questions to should_stop


@dataclass
class _Kind:
    """What the placements of one object, under one instancer, have in common. mesh -1: nothing to place."""

    mesh: int
    desc: dict[str, Any]
    needs: needs.Needs = field(default_factory=needs.Needs)


class Objects:
    """One use: `Objects(…).export()`."""

    def __init__(self, scene: Any, depsgraph: Any, view_layer: Any, materials: Materials, options: ExportOptions,
                 eye: Any, warnings: list[str]) -> None:
        """eye: where the camera is."""
        self._scene, self._depsgraph, self._view_layer = scene, depsgraph, view_layer
        self._materials, self._options, self._warnings = materials, options, warnings
        self._wanted = needs.of_file().attributes
        self._frame = depsgraph.scene_eval.frame_current_final
        self._render = depsgraph.mode == "RENDER"
        self._eye = eye
        self._attributes = InstanceAttributes()
        self._meshes: dict[tuple[Any, ...], int] = {}
        self._kinds: dict[tuple[int, int, int, str], _Kind | None] = {}
        self._told: set[str] = set()

    def export(self) -> None:
        stop = self._options.should_stop
        for number, instance in enumerate(self._depsgraph.object_instances):
            if stop and number % _CHECK_EVERY == 0 and stop():
                raise ExportCancelled
            self._one(instance)

    def _one(self, instance: Any) -> None:
        obj = instance.object
        try:
            if instance.show_particles and self._view_layer.use_strand and self._has_hair(instance):
                self._place(instance, obj, "particles")
            if not instance.show_self:
                return
            if obj.type in _GEOMETRY:
                if getattr(self._view_layer, _GEOMETRY[obj.type]):
                    self._place(instance, obj, obj.type)
            elif obj.type == "LIGHT":
                self._lamp(instance, obj)
            elif obj.type in _UNSUPPORTED:
                self._tell(f"Object “{obj.name}”: {_UNSUPPORTED[obj.type]} not supported, left out")
        except Exception as error:
            self._tell(f"Object “{obj.name}” is left out: {error}")

    def _place(self, instance: Any, obj: Any, geometry: str) -> None:
        # An instance's object is one temporary that is refilled for each step: only its source has an identity.
        dupli = instance.is_instance
        source = instance.instance_object if dupli else obj
        parent = instance.parent if dupli else None
        key = (source.as_pointer(), obj.data.as_pointer(), parent.as_pointer() if dupli else 0, geometry)
        if key not in self._kinds:
            self._kinds[key] = None  # stays so when this fails: told once, not for each instance
            self._kinds[key] = self._kind(obj, source, parent, geometry)
        kind = self._kinds[key]
        if kind is None or kind.mesh < 0:
            return
        desc = {**kind.desc, "transform": names.affine(instance.matrix_world)}
        if dupli:
            desc["random"] = names.unit_random(instance.random_id)
            desc["dupli_generated"] = [0.5 * v - 0.5 for v in instance.orco]
            desc["dupli_uv"] = list(instance.uv)
        found = values.of_instance(instance, kind.needs, self._frame, self._attributes)
        if found:
            desc["values"] = found
        self._scene.add_instance(desc)

    def _kind(self, obj: Any, source: Any, parent: Any, geometry: str) -> _Kind:
        owner = parent or obj
        holdout = owner.is_holdout or owner.holdout_get(view_layer=self._view_layer)
        visibility = names.object_visibility(obj) & names.object_visibility(owner)
        if not holdout and owner.indirect_only_get(view_layer=self._view_layer):
            visibility &= ~names.CAMERA
        if visibility == 0:
            return _Kind(-1, {})
        self._tell_unsupported(obj, owner)
        offset, shading = compat.terminator(obj)
        read = self._materials.needs(obj)
        index = self._geometry(obj, source, read, geometry)
        return _Kind(index, {} if index < 0 else {
            "name": obj.name, "mesh": index, "materials": self._materials.indices(obj), "visibility": visibility,
            "holdout": bool(holdout), "terminator_geometry": offset,
            "terminator_shading": shading, "pass_index": obj.pass_index, "color": list(obj.color),
            "random": names.unit_random(names.hash_name(obj.name))}, read)

    def _geometry(self, obj: Any, source: Any, read: needs.Needs, geometry: str) -> int:
        owner = source if geometry == "particles" else obj.data
        key = (owner.as_pointer(), geometry, read.tangents, read.edges)
        if key not in self._meshes:
            self._meshes[key] = -1
            self._meshes[key] = self._add(obj, source, read, geometry)
        return self._meshes[key]

    def _add(self, obj: Any, source: Any, read: needs.Needs, geometry: str) -> int:
        if geometry == "particles":
            return hair.of_particles(self._scene, source, self._render, self._eye, self._tell)
        if geometry == "CURVES":
            return hair.of_curves(self._scene, obj, self._wanted, self._eye, self._tell)
        if geometry == "POINTCLOUD":
            return pointcloud.add(self._scene, obj.data, self._wanted)
        with mesh.arrays_of(source, obj.data) as filled:
            return mesh.add(self._scene, obj.data.name, filled, self._wanted, self._warnings, read)

    def _has_hair(self, instance: Any) -> bool:
        source = instance.instance_object if instance.is_instance else instance.object
        return any(strands.particle_systems(source, "show_render" if self._render else "show_viewport"))

    def _lamp(self, instance: Any, obj: Any) -> None:
        if compat.has_light_linking(obj):
            self._tell(f"Light “{obj.name}”: light linking is not supported, it reaches all objects")
        graph = self._materials.graph(obj.data, "Light")
        random_id = instance.random_id if instance.is_instance else None
        self._scene.add_light(light.describe(obj, instance.matrix_world, graph, random_id))

    def _tell_unsupported(self, obj: Any, owner: Any) -> None:
        if obj.is_shadow_catcher or owner.is_shadow_catcher:
            self._tell(f"Object “{obj.name}”: shadow catchers are not supported, rendered as it is")
        if any(m.type == "FLUID" and m.fluid_type == "DOMAIN" and m.domain_settings.domain_type == "GAS"
               for m in obj.modifiers):
            self._tell(f"Object “{obj.name}”: smoke and fire are volume grids, which are not supported")
        if compat.has_light_linking(obj) or compat.has_light_linking(owner):
            self._tell(f"Object “{obj.name}”: light linking is not supported, all lights reach it")

    def _tell(self, message: str) -> None:
        if message not in self._told:
            self._told.add(message)
            self._warnings.append(message)
