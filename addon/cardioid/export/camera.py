# SPDX-License-Identifier: GPL-3.0-or-later
"""The camera: Blender's sensor fit, lens shift and pixel aspect become a view plane."""

from __future__ import annotations

import math
from typing import Any

from .names import affine
from .options import ExportError, ExportOptions


def camera_object(scene: Any, options: ExportOptions) -> Any:
    """The camera of this picture. Raises ExportError when there is none."""
    obj = getattr(options.engine, "camera_override", None) or scene.camera
    if obj is None:
        raise ExportError(f"Scene “{scene.name}” has no camera: add one and make it active (Ctrl Numpad 0)")
    return obj


def describe(obj: Any, scene: Any, options: ExportOptions, warnings: list[str]) -> dict[str, Any]:
    """Keywords of `Scene.set_camera`."""
    matrix = _model_matrix(obj, options.engine)
    desc: dict[str, Any] = {"name": obj.name, "transform": affine(matrix)}
    if obj.type == "CAMERA":
        return {**desc, **_from_camera(obj, matrix, scene, options, warnings)}
    if obj.type == "LIGHT" and obj.data.type == "SPOT":
        lens = 16.0 / math.tan(obj.data.spot_size * 0.5)
    else:
        lens = 50.0
    plane = view_plane(options.resolution, _aspect(scene), "AUTO", (36.0, 24.0), lens, (0.0, 0.0))
    return {**desc, "kind": "perspective", "view_plane": plane, "clip_start": 1e-5, "clip_end": 1e5}


def view_plane(resolution: tuple[int, int], aspect: tuple[float, float], fit: str, sensor: tuple[float, float],
               lens: float, shift: tuple[float, float], ortho_scale: float | None = None) -> list[float]:
    """Left, right, bottom, top at distance 1; with `ortho_scale` in scene units. Sensor and lens in millimetres."""
    x, y = resolution[0] * aspect[0], resolution[1] * aspect[1]
    horizontal = fit == "HORIZONTAL" or (fit == "AUTO" and x > y)
    size = sensor[1] if fit == "VERTICAL" else sensor[0]
    long_side = size / lens if ortho_scale is None else ortho_scale
    width, height = (long_side, long_side * y / x) if horizontal else (long_side * x / y, long_side)
    dx, dy = shift[0] * long_side, shift[1] * long_side
    return [dx - width / 2, dx + width / 2, dy - height / 2, dy + height / 2]


def _from_camera(obj: Any, matrix: Any, scene: Any, options: ExportOptions, warnings: list[str]) -> dict[str, Any]:
    data = obj.data
    if data.type not in ("PERSP", "ORTHO"):
        kind = "Panoramic" if data.type == "PANO" else f"{data.type.capitalize()} type"
        warnings.append(f"Camera “{obj.name}”: {kind} is not supported, rendered as perspective")
    ortho = data.type == "ORTHO"
    shift_x = options.engine.camera_shift_x(obj) if options.engine else data.shift_x
    plane = view_plane(options.resolution, _aspect(scene), data.sensor_fit, (data.sensor_width, data.sensor_height),
                       data.lens, (shift_x, data.shift_y), data.ortho_scale if ortho else None)
    return {"kind": "orthographic" if ortho else "perspective", "view_plane": plane, "clip_start": data.clip_start,
            "clip_end": data.clip_end, **_depth_of_field(data, matrix, ortho)}


def _depth_of_field(data: Any, matrix: Any, ortho: bool) -> dict[str, Any]:
    dof = data.dof
    if not dof.use_dof:
        return {"aperture_radius": 0.0}
    size = 1.0 if ortho else data.lens * 1e-3
    return {"aperture_radius": size / (2.0 * max(dof.aperture_fstop, 1e-5)), "blades": dof.aperture_blades,
            "blade_rotation": dof.aperture_rotation, "aperture_ratio": dof.aperture_ratio,
            "focus_distance": _focus_distance(dof, matrix)}


def _focus_distance(dof: Any, matrix: Any) -> float:
    if dof.focus_object is None:
        return dof.focus_distance
    target = dof.focus_object.matrix_world
    bones = getattr(dof.focus_object.pose, "bones", {})
    if dof.focus_subtarget in bones:
        target = target @ bones[dof.focus_subtarget].matrix
    forward = matrix.col[2].to_3d().normalized()
    return abs(forward.dot(matrix.translation - target.translation))


def _model_matrix(obj: Any, engine: Any) -> Any:
    """The camera's matrix without scale."""
    matrix = (engine.camera_model_matrix(obj) if engine else obj.matrix_world).copy()
    for axis in range(3):
        matrix.col[axis] = matrix.col[axis].normalized()
    return matrix


def _aspect(scene: Any) -> tuple[float, float]:
    return scene.render.pixel_aspect_x, scene.render.pixel_aspect_y
