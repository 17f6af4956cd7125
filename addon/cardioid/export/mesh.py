# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluated meshes as arrays. Nothing here loops over elements in Python."""

from __future__ import annotations

from collections.abc import Iterator, Set
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import compat
from .arrays import foreach, memory
from .attributes import Layer, layers
from .needs import NOTHING, Needs
from .normals import corner_normals, triangle_normals
from .tangents import corner_tangents

_TRIANGLE = np.dtype((np.int32, 3))                             # 4.1 and later: corners only
_TRIANGLE_POLYGON = np.dtype([("corners", np.int32, 3), ("polygon", np.int32)])  # before
_LOOP = np.dtype([("vertex", np.int32), ("edge", np.int32)])    # before 4.1


@dataclass
class Triangles:
    """corners (T, 3), vertices (T, 3), polygon (T,): indices into the mesh's own arrays."""

    corners: np.ndarray
    vertices: np.ndarray
    polygon: np.ndarray


@contextmanager
def arrays_of(source: Any, data: Any) -> Iterator[Any]:
    """`data`, an evaluated mesh of `source`, or a copy: of a mesh in edit mode Blender shows only parts."""
    if not data.is_editmode:
        yield data
        return
    try:
        yield source.to_mesh()
    finally:
        source.to_mesh_clear()


def add(scene: Any, name: str, mesh: Any, wanted: Set[str], warnings: list[str],
        read: Needs = NOTHING) -> int:
    """Adds an evaluated mesh to `scene`; -1 when it has no triangles. `wanted`: attributes that some material of the
    file names; `read`: what its own materials need besides."""
    mesh.calc_loop_triangles()
    if len(mesh.loop_triangles) == 0:
        return -1
    positions = _positions(mesh)
    tris = triangles(mesh)
    normals = corner_normals(mesh, positions, tris)
    active_uv = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
    generated_min, generated_size = texture_space(mesh)
    attributes = layers(mesh, tris, wanted, name, warnings)
    attributes += _tangents(attributes, {uv or active_uv for uv in read.tangents}, positions, tris, normals)
    attributes += _undeformed(mesh, positions, generated_min, generated_size)
    if read.edges:
        attributes.append(("#vertex_normal", "point", foreach(mesh.vertices, "normal", np.float32, 3)))
    return scene.add_mesh(
        name, positions, tris.vertices,
        slots=_slots(mesh, tris),
        corner_normals=normals,
        attributes=attributes,
        active_uv=active_uv,
        active_color=_active_color(mesh),
        generated_min=generated_min, generated_size=generated_size,
        **({"edges": foreach(mesh.edges, "vertices", np.int32, 2)} if read.edges else {}))


def triangles(mesh: Any) -> Triangles:
    tris = mesh.loop_triangles
    if compat.has("array_attributes"):
        corners = memory(tris, _TRIANGLE)
        polygon = foreach(mesh.loop_triangle_polygons, "value", np.int32)
        corner_vertex = foreach(mesh.attributes[".corner_vert"].data, "value", np.int32)
    else:
        packed = memory(tris, _TRIANGLE_POLYGON)
        corners = None if packed is None else packed["corners"]
        polygon = foreach(tris, "polygon_index", np.int32) if packed is None else packed["polygon"].copy()
        loops = memory(mesh.loops, _LOOP)
        corner_vertex = foreach(mesh.loops, "vertex_index", np.int32) if loops is None else loops["vertex"]
    corners = foreach(tris, "loops", np.int32, 3) if corners is None else np.array(corners, np.int32, order="C")
    return Triangles(corners, np.ascontiguousarray(corner_vertex[corners]), polygon)


def _positions(mesh: Any) -> np.ndarray:
    if compat.has("array_attributes"):
        return foreach(mesh.attributes["position"].data, "vector", np.float32, 3)
    return foreach(mesh.vertices, "co", np.float32, 3)


def _slots(mesh: Any, tris: Triangles) -> np.ndarray | None:
    """Material slot of each triangle; None when all use the first."""
    attribute = mesh.attributes.get("material_index")
    if attribute is None or attribute.domain != "FACE":
        return None
    indices = foreach(attribute.data, "value", np.int32)
    return indices[tris.polygon] if indices.any() else None


def texture_space(mesh: Any) -> tuple[np.ndarray, np.ndarray]:
    """The box whose corners have Generated coordinates 0 and 1. An extent of 0 counts as 2, as in Blender."""
    location = np.array(mesh.texspace_location, np.float32)
    half = np.array(mesh.texspace_size, np.float32)
    half[half == 0] = 1
    return location - half, 2 * half


def _tangents(found: list[Layer], names: Set[str], positions: np.ndarray, tris: Triangles,
              normals: np.ndarray | None) -> list[Layer]:
    """The layer "#tangent:NAME" for each UV map of `found` that is in `names`."""
    uvs = {name: data for name, domain, data in found if name in names and domain == "corner" and data.shape[2] == 2}
    if uvs and normals is None:
        flat = triangle_normals(positions[tris.vertices])[:, None, :]
        normals = np.broadcast_to(flat, (*tris.vertices.shape, 3))
    return [(f"#tangent:{name}", "corner", corner_tangents(positions, tris.vertices, normals, uv))
            for name, uv in uvs.items()]


def _undeformed(mesh: Any, positions: np.ndarray, low: np.ndarray, size: np.ndarray) -> list[Layer]:
    """The layer "#generated" of a mesh that modifiers or shape keys have bent: Generated sticks to the surface."""
    before = foreach(mesh.vertices, "undeformed_co", np.float32, 3)
    if np.allclose(before, positions, rtol=0, atol=1e-6 * float(size.max())) or not np.isfinite(before).all():
        return []
    return [("#generated", "point", np.ascontiguousarray((before - low) / size, np.float32))]


def _active_color(mesh: Any) -> str:
    index = mesh.color_attributes.render_color_index
    names = mesh.color_attributes
    return names[index].name if 0 <= index < len(names) else ""
