# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that differs between Blender's versions, in one table and the few functions that read it."""

from __future__ import annotations

from typing import Any

import bpy

VERSION: tuple[int, int, int] = tuple(bpy.app.version)

# What is different: (first version that has it, meaning). `has(key)` is the only reader.
SINCE: dict[str, tuple[int, int]] = {
    "nodes_always_on": (5, 0),       # use_nodes is deprecated and has no effect
    "corner_normals": (4, 1),        # mesh.corner_normals; before: calc_normals_split and auto smooth
    "array_attributes": (4, 1),      # 'position' and '.corner_vert' are attributes, uv_layer.uv exists
    "principled_2": (4, 0),          # Principled BSDF with Coat, Sheen Weight, …
    "principled_3": (5, 0),          # films on metal; the coat follows the bumped normal
    "microfacet_2": (3, 5),          # facets mask and shadow each other together
    "diffuse_2": (4, 3),             # rough diffuse keeps its energy
    "ies_2": (4, 1),                 # photometric files fade beyond their angles …
    "ies_3": (5, 0),                 # … and keep their last value, as before 4.1
    "vector_transform_2": (4, 4),    # normals are transformed by the inverse transpose
    "bump_2": (3, 6),                # normals of Bump and of displacement may point below the surface
    "bump_3": (4, 5),                # bumps of diffuse surfaces are shadowed by a GGX term
    "normal_map_2": (4, 0),          # strength scales the map in tangent space
    "displacement_2": (4, 5),        # displacement that only bumps is measured over a tenth of a pixel
    "tables_2": (4, 5),              # ramps and curves have an entry more (seen in 4.5, not in 3.4)
    "voronoi_2": (5, 0),             # another hash of the cells
    "new_lamps": (4, 0),             # soft lamps are spheres or soft falloff disks; spots and suns lost a cosine
    "lamps_are_objects": (4, 5),     # nodes of lamps see all of their transform
    "light_use_shadow": (4, 2),      # light.use_shadow replaces light.cycles.cast_shadow
    "emission_sampling": (3, 5),     # material.cycles.emission_sampling replaces sample_as_light
    "material_transparent_shadow": (4, 2),  # on the material; before: on material.cycles
}

# Nodes that mean something else since then: docs/nodes.md tells what.
NODE_SINCE = {
    "ShaderNodeBsdfPrincipled": ("principled_2", "principled_3"),
    "ShaderNodeBsdfGlossy": "microfacet_2",
    "ShaderNodeBsdfAnisotropic": "microfacet_2",
    "ShaderNodeBsdfRefraction": "microfacet_2",
    "ShaderNodeBsdfGlass": "principled_2",
    "ShaderNodeBsdfDiffuse": "diffuse_2",
    "ShaderNodeBump": ("bump_2", "bump_3"),
    "ShaderNodeTexIES": ("ies_2", "ies_3"),
    "ShaderNodeVectorTransform": "vector_transform_2",
    "ShaderNodeNormalMap": ("normal_map_2", "bump_3"),
    "ShaderNodeDisplacement": ("bump_2", "displacement_2"),
    "ShaderNodeVectorDisplacement": ("bump_2", "displacement_2"),
    "ShaderNodeTexVoronoi": "voronoi_2",
    "ShaderNodeValToRGB": "tables_2",
}


def has(key: str) -> bool:
    return VERSION[:2] >= SINCE[key]


def node_tree(owner: Any) -> Any:
    """The shading nodes of a material, world or light, or None when it does without."""
    if owner.node_tree is None:
        return None
    always_on = has("nodes_always_on") and not isinstance(owner, bpy.types.Light)
    return owner.node_tree if always_on or owner.use_nodes else None


def cycles(owner: Any, name: str, default: Any) -> Any:
    """A property that Cycles' add-on keeps on the data-block; `default` when that add-on is off or lacks it."""
    return getattr(getattr(owner, "cycles", None), name, default)


def casts_shadow(light: Any) -> bool:
    return bool(light.use_shadow if has("light_use_shadow") else cycles(light, "cast_shadow", True))


def samples_emission(material: Any) -> bool:
    if has("emission_sampling"):
        return cycles(material, "emission_sampling", "AUTO") != "NONE"
    return bool(cycles(material, "sample_as_light", True))


def transparent_shadow(material: Any) -> bool:
    if has("material_transparent_shadow"):
        return bool(material.use_transparent_shadow)
    return bool(cycles(material, "use_transparent_shadow", True))


def displacement_method(material: Any) -> str:
    """MaterialDesc.displacement_method; on the material since 4.1, on material.cycles before."""
    on_material = getattr(material, "displacement_method", None)
    return (on_material or cycles(material, "displacement_method", "BUMP")).lower()


def terminator(obj: Any) -> tuple[float, float]:
    """Shadow Terminator offsets of an object: geometry, shading. 4.2 and newer keep them on the object itself."""
    geometry = getattr(obj, "shadow_terminator_geometry_offset", None)
    if geometry is not None:
        return geometry, obj.shadow_terminator_shading_offset
    return cycles(obj, "shadow_terminator_geometry_offset", 0.1), cycles(obj, "shadow_terminator_offset", 0.0)


def has_light_linking(obj: Any) -> bool:
    linking = getattr(obj, "light_linking", None)
    return linking is not None and bool(linking.receiver_collection or linking.blocker_collection)


def node_versions(node_type: str) -> dict[str, Any]:
    """Parameters that tell apart nodes which share a type but not a meaning."""
    keys = NODE_SINCE.get(node_type)
    if keys is None:
        return {}
    return {"version": 1 + sum(has(key) for key in ((keys,) if isinstance(keys, str) else keys))}
