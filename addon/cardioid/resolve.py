# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender's scene to the engine's Settings: the user's values, those that follow Cycles, the command line's."""

from __future__ import annotations

import os
from typing import Any

import bpy

from . import cycles_values, passes
from .settings_table import Setting, k_integrators, k_settings, k_tuning

k_preview_samples = 24
k_preview_bounces = 6
k_preview_seconds = 4.0
k_megabyte = 1 << 20


def resolve(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, overrides: dict[str, Any] | None = None,
            *, preview: bool = False) -> dict[str, Any]:
    """Keywords for the engine's `set_settings`, without width, height and crop (the exporter knows them).

    overrides: values by their names in scene.cardioid that win over the scene's (command line).
    Raises ValueError with a sentence for the artist.
    """
    values = {setting.name: getattr(scene.cardioid, setting.name) for setting in k_settings}
    values["integrator"] = scene.cardioid.integrator
    values["samples"], values["sample_offset"] = _samples(scene, view_layer, values)
    values["filter_width"] = _filter_width(values)
    if preview:
        values.update(samples=min(values["samples"], k_preview_samples), time_limit=k_preview_seconds,
                      max_bounces=min(values["max_bounces"], k_preview_bounces), sample_offset=0,
                      use_adaptive_sampling=False, keep_film=False, save_film=False)
    values.update(overrides or {})
    values["seed"] = _seed(scene, values)
    values["adaptive_threshold"] = _adaptive_threshold(values)
    engine = _engine_settings(scene, values)
    engine["record_clusters"] = records_film(values) or any(one.of_filter for one in passes.enabled(view_layer))
    return engine


def filter_settings(scene: bpy.types.Scene, overrides: dict[str, Any] | None = None) -> dict[str, Any]:
    """The part of the engine's settings that may change after the render: keywords of a FilterJob."""
    values = {setting.name: getattr(scene.cardioid, setting.name) for setting in k_tuning} | (overrides or {})
    return {setting.key: _engine_value(setting, values[setting.name]) for setting in k_tuning}


def records_film(values: dict[str, Any]) -> bool:
    """Whether the engine must record what the filter needs. A background Blender keeps no film for a hand to tune."""
    return values["use_filter"] or values["save_film"] or (values["keep_film"] and not bpy.app.background)


def _samples(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, values: dict[str, Any]) -> tuple[int, int]:
    """Samples and the first of them; while following Cycles with the view layer's count and Cycles' sample subset."""
    samples, offset = values["samples"], values["sample_offset"]
    # From 4.5 on Cycles' offset counts only while its sample subset is switched on
    subset = cycles_values.value(scene, "use_sample_subset", None)
    if subset is False and not scene.cardioid.is_own("sample_offset"):
        offset = 0
    if scene.cardioid.is_own("samples"):
        return samples, offset
    rule = cycles_values.value(scene, "use_layer_samples", "USE")
    if view_layer.samples > 0 and rule != "IGNORE":
        samples = min(samples, view_layer.samples) if rule == "BOUNDED" else view_layer.samples
    if subset:
        samples = max(1, min(samples - offset, cycles_values.value(scene, "sample_subset_length", samples)))
    return samples, offset


def _filter_width(values: dict[str, Any]) -> float:
    """Cycles' box filter is one pixel wide whatever the width says."""
    return 1.0 if values["pixel_filter"] == "BOX" else values["filter_width"]


def _adaptive_threshold(values: dict[str, Any]) -> float:
    """0 where every pixel gets all samples; Cycles' 0 chooses by the number of samples."""
    if not values["use_adaptive_sampling"]:
        return 0.0
    return values["adaptive_threshold"] or max(0.001, 1.0 / values["samples"])


def _seed(scene: bpy.types.Scene, values: dict[str, Any]) -> int:
    if not values["use_animated_seed"]:
        return values["seed"]
    # Knuth's multiplicative step spreads neighbouring frames over all seeds
    frame = scene.frame_current + scene.frame_subframe
    return (values["seed"] + int(frame * 1000) * 2654435761) & 0x7FFFFFFF


def threads(scene: bpy.types.Scene, wanted: int | None = None) -> int:
    """Threads of the engine; 0: all. wanted: in place of the scene's setting."""
    count = scene.cardioid.threads if wanted is None else wanted
    if count == 0 and scene.render.threads_mode == "FIXED":
        return scene.render.threads
    return count


def _engine_value(setting: Setting, value: Any) -> Any:
    if setting.name == "filter_size":
        return value | 1  # there is a pixel in its middle
    return value.lower() if setting.kind == "enum" else value


def _engine_settings(scene: bpy.types.Scene, values: dict[str, Any]) -> dict[str, Any]:
    if values["integrator"] not in k_integrators:
        raise ValueError("This file asks for an integrator that this version of Cardioid does not have; choose another "
                         "in Render Properties, Sampling")
    engine = {setting.key: _engine_value(setting, values[setting.name]) for setting in k_settings if setting.key}
    engine["integrator"] = k_integrators[values["integrator"]][3]
    if values["integrator"] == "PT":
        engine["caustic_roughness"] = 0.0  # all but exact mirrors and glass is diffuse to it
    engine["threads"] = threads(scene, values["threads"])
    engine["memory_limit"] = values["memory_limit"] * k_megabyte
    engine["transparent_film"] = scene.render.film_transparent
    engine["ocio_config"] = ocio_config()
    engine.update(_fast_gi(scene))
    return engine


def _fast_gi(scene: bpy.types.Scene) -> dict[str, Any]:
    """Cycles' Fast GI as it stands in the scene and its world. Only Replace; `unsupported` tells of Add."""
    bounces = cycles_values.value(scene, "ao_bounces_render", 1)
    light = getattr(scene.world, "light_settings", None)
    replaces = cycles_values.value(scene, "fast_gi_method", "REPLACE") in ("REPLACE", 0)
    used = cycles_values.value(scene, "use_fast_gi", False) and replaces and bounces > 0 and light is not None
    return {"fast_gi": "replace" if used else "off", "fast_gi_bounces": max(bounces, 1),
            "fast_gi_factor": light.ao_factor if light else 1.0, "fast_gi_distance": light.distance if light else 10.0}


def unsupported(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer) -> list[str]:
    """Sentences for settings of Cycles that change its picture and that are not followed."""
    told = []
    if cycles_values.value(scene, "use_fast_gi", False) and cycles_values.value(
            scene, "fast_gi_method", "REPLACE") in ("ADD", 1):
        told.append("Fast GI Approximation: Add is not supported, no light is added")
    if scene.render.use_motion_blur and view_layer.use_motion_blur:
        told.append("Motion blur is not supported, the frame is rendered as it stands")
    if scene.render.use_simplify:
        if any(cycles_values.value(scene, name, False) for name in ("use_camera_cull", "use_distance_cull")):
            told.append("Simplify: camera and distance culling are not followed, all objects are rendered")
        if cycles_values.value(scene, "texture_limit_render", "OFF") not in ("OFF", 0):
            told.append("Simplify: the texture limit is not followed, textures have their full size")
    return told


def ocio_config() -> str:
    """Path of Blender's colour configuration; empty when there is none."""
    given = os.environ.get("OCIO", "")
    if given:
        return given
    folder = bpy.utils.system_resource("DATAFILES", path="colormanagement")
    path = os.path.join(folder, "config.ocio") if folder else ""
    return path if path and os.path.exists(path) else ""
