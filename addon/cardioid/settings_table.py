# SPDX-License-Identifier: GPL-3.0-or-later
"""Every render setting in one table: its name in `scene.cardioid`, the artist's words, the Cycles setting that it
follows and the key of the engine's Settings (engine_cpp/scene/scene_desc.h) that it becomes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

k_integrators = {
    # identifier: (label, description, stable number in .blend files, engine name)
    "PTPPM": ("Path Tracing + Photons",
              "Path tracing for all light, photons for the caustics: clean caustics of every lamp, also in mirrors", 0,
              "hybrid"),
    "PT": ("Path Tracing",
           "Path tracing alone. Caustics of small lamps stay noisy, those of lamps without size are missing", 1,
           "path_tracing"),
    "SPPM": ("Photon Mapping",
             "Photons for all light but lamps that are seen, directly or in mirrors. Mostly to compare", 2,
             "photon_mapping"),
}

k_indirect_caustics = {
    "PHOTONS": ("Photons", "As clean as direct caustics", 0),
    "PATH_TRACING": ("Path Tracing", "Noisier, but all photons are left to the direct caustics", 1),
    "OFF": ("Off", "Left out: quicker and a little darker", 2),
}

k_radius_schedules = {
    "MEMORYLESS": ("Alike Everywhere",
                   "By the number of the pass alone, so that machines can share a frame", 0),
    "PER_PIXEL": ("By Photons Found", "Each pixel's radius shrinks by the photons that it has found", 1),
}

k_filter_methods = {
    "CLUSTERS": ("Clusters", "Smooths light of like brightness and cause; keeps textures and shadows", 0),
    "THESIS": ("Thesis", "As it was first published, to compare", 1),
    "CROSS_BILATERAL": ("Cross-Bilateral", "The usual filter, by texture, depth and normals; to compare", 2),
    "NONE": ("Fireflies Only", "Fireflies go, all other noise stays", 3),
}

k_pixel_filters = {
    "BOX": ("Box", "Average over the pixel's own square; hard edges", 0),
    "GAUSSIAN": ("Gaussian", "Soft filter", 1),
    "BLACKMAN_HARRIS": ("Blackman-Harris", "Soft filter that keeps edges sharp; Cycles' default", 2),
}


@dataclass(frozen=True)
class Setting:
    """One property of `scene.cardioid`.

    kind: int, float, bool, or enum (with `items`: identifier to (label, description, number)).
    cycles: the attribute of scene.cycles that it follows until the user changes it; None: it has a value of its own.
    key: the engine's name for it; None: used by the add-on only.
    options: further keywords of the bpy property (min, max, subtype, …).
    tunes: it changes the filter, so a picture whose film is kept can follow it without rendering.
    """

    name: str
    kind: str
    label: str
    description: str
    default: Any
    cycles: str | None = None
    key: str | None = None
    items: dict | None = None
    options: dict = field(default_factory=dict)
    tunes: bool = False


def _bounces(name: str, label: str, description: str, default: int, cycles: str, key: str) -> Setting:
    return Setting(name, "int", label, description, default, cycles, key, options={"min": 0, "max": 1024})


def _tuning(name: str, kind: str, label: str, description: str, default: Any, *, cycles: str | None = None,
            items: dict | None = None, **options: Any) -> Setting:
    """A setting of the filter; the engine calls it by the same name."""
    return Setting(name, kind, label, description, default, cycles, name, items, options, tunes=True)


k_settings = (
    Setting("samples", "int", "Samples", "Camera paths traced for each pixel. More samples: less noise, longer render",
            4096, "samples", "samples", options={"min": 1, "max": 1 << 24}),
    Setting("time_limit", "float", "Time Limit",
            "Stop after this time and keep the picture as it is then. Exporting is not counted. 0: no limit",
            0.0, "time_limit", "time_limit", options={"min": 0.0, "step": 100, "unit": "TIME_ABSOLUTE"}),
    Setting("use_adaptive_sampling", "bool", "Noise Threshold",
            "Stop early where the picture is clean enough, so that samples go where noise is",
            True, "use_adaptive_sampling"),
    Setting("adaptive_threshold", "float", "Noise Threshold",
            "Noise at which a pixel needs no more samples. Smaller: cleaner and slower. 0: chosen by the samples",
            0.01, "adaptive_threshold", "adaptive_threshold",
            options={"min": 0.0, "max": 1.0, "soft_min": 0.001, "soft_max": 0.5, "step": 0.1, "precision": 4}),
    Setting("adaptive_min_samples", "int", "Min Samples",
            "Samples that every pixel gets before its noise is judged. 0: chosen by the threshold",
            0, "adaptive_min_samples", "adaptive_min_samples", options={"min": 0, "max": 4096}),
    Setting("seed", "int", "Seed", "Another seed gives another pattern of noise",
            0, "seed", "seed", options={"min": 0, "max": 2147483647}),
    Setting("use_animated_seed", "bool", "Animated Seed", "Change the pattern of noise on every frame",
            False, "use_animated_seed"),
    Setting("sample_offset", "int", "Sample Offset",
            "Skip this many samples first, to render parts of a frame on several machines and merge them",
            0, "sample_offset", "first_sample", options={"min": 0, "max": 1 << 24}),
    _bounces("max_bounces", "Total", "Largest number of times that light may bounce on its way to the camera",
             12, "max_bounces", "max_bounces"),
    _bounces("diffuse_bounces", "Diffuse", "Largest number of diffuse bounces, within the total",
             4, "diffuse_bounces", "max_diffuse_bounces"),
    _bounces("glossy_bounces", "Glossy", "Largest number of glossy bounces, within the total",
             4, "glossy_bounces", "max_glossy_bounces"),
    _bounces("transmission_bounces", "Transmission", "Largest number of passages through glass, within the total",
             12, "transmission_bounces", "max_transmission_bounces"),
    _bounces("volume_bounces", "Volume",
             "Largest number of times that smoke, fog or liquids scatter light, within the total; 0 is one time",
             0, "volume_bounces", "max_volume_bounces"),
    _bounces("transparent_bounces", "Transparent",
             "Largest number of transparent surfaces that a ray passes; counted apart from the other bounces",
             8, "transparent_max_bounces", "max_transparent_bounces"),
    Setting("clamp_direct", "float", "Direct Light",
            "Brightest value that a direct light path may add. Removes fireflies and real light with them. "
            "0: no clamping",
            0.0, "sample_clamp_direct", "clamp_direct", options={"min": 0.0, "max": 1e8}),
    Setting("clamp_indirect", "float", "Indirect Light",
            "Brightest value that an indirect light path may add. Removes fireflies and real light with them. "
            "0: no clamping",
            10.0, "sample_clamp_indirect", "clamp_indirect", options={"min": 0.0, "max": 1e8}),
    Setting("reflective_caustics", "bool", "Reflective", "Light that mirrors and metal throw onto rougher surfaces",
            True, "caustics_reflective", "reflective_caustics"),
    Setting("refractive_caustics", "bool", "Refractive", "Light that glass and water gather onto rougher surfaces",
            True, "caustics_refractive", "refractive_caustics"),
    Setting("filter_glossy", "float", "Filter Glossy",
            "Blur sharp reflections seen in rougher ones: less noise, less truth. 0: off",
            1.0, "blur_glossy", "filter_glossy", options={"min": 0.0, "max": 10.0}),
    Setting("indirect_caustics", "enum", "Indirect Caustics",
            "Caustics of light that a rough surface has scattered first: a bright wall seen as a glint under a glass",
            "PATH_TRACING", None, "indirect_caustics", k_indirect_caustics),
    Setting("photons", "int", "Photons",
            "Photons sent out for each sample of the picture. More: smoother caustics, longer samples, more memory. "
            "0: chosen by the size of the picture",
            0, None, "photons", options={"min": 0, "max": 0x7FFFFFFF, "soft_max": 10_000_000}),
    Setting("photon_radius", "float", "Radius",
            "How far around it a pixel looks for photons at first, in pixels; the radius shrinks while rendering. "
            "Smaller: sharper caustics with more noise",
            1.0, None, "photon_radius", options={"min": 0.01, "max": 1000.0, "soft_min": 0.5, "soft_max": 10.0,
                                                 "subtype": "PIXEL"}),
    Setting("caustic_roughness", "float", "Roughness Limit",
            "Reflections and refractions up to this roughness throw their caustics by photons, rougher ones by path "
            "tracing. Moves work from one to the other, the finished picture stays the same",
            0.1, None, "caustic_roughness", options={"min": 0.0, "max": 1.0, "subtype": "FACTOR"}),
    Setting("radius_shrink", "float", "Radius Shrink",
            "The smaller, the faster the radius shrinks: sharper sooner, smooth later. 1: it stays, and its blur too",
            0.6666667, None, "radius_shrink", options={"min": 0.01, "max": 1.0, "subtype": "FACTOR"}),
    Setting("radius_schedule", "enum", "Radius Schedule", "What makes the radius shrink",
            "MEMORYLESS", None, "radius_schedule", k_radius_schedules),
    Setting("guided_emission", "bool", "Guide Photons",
            "Learn in the first passes which photons reach the picture as caustics, and send out more of these",
            True, None, "guided_emission"),
    Setting("blend_caustic_hits", "bool", "Blend with Path Tracing",
            "Use the caustics that path tracing finds too, each where it is better. Helps with large lamps and skies",
            True, None, "blend_caustic_hits"),
    Setting("physical_refraction", "bool", "Physical Refraction",
            "Radiance changes where light enters glass or water, as in nature. Off: as in Cycles",
            False, None, "physical_refraction"),
    _tuning("use_filter", "bool", "Noise Filter",
            "Take fireflies and noise out of the picture. Off: the picture as it was traced",
            True, cycles="use_denoising"),
    _tuning("filter_method", "enum", "Method", "How noise is told from picture", "CLUSTERS", items=k_filter_methods),
    _tuning("firefly_density", "float", "Firefly Removal",
            "Light that too few pixels around share is withheld until more samples confirm it. "
            "Larger: more fireflies go, and small glints with them. 0: all light stays",
            0.0661157, min=0.0, max=10.0, soft_max=0.25, step=0.5, precision=3),
    _tuning("luminance_sensitivity", "float", "Light Sensitivity",
            "How unlike in brightness light may be and still be smoothed together. Larger: smoother. "
            "Smaller: faint shadow edges stay, and noise with them",
            0.5, min=0.0, max=0.99, subtype="FACTOR"),
    _tuning("filter_size", "int", "Filter Size",
            "Width in pixels of what is smoothed together, odd: an even one counts as the next. Larger: smoother, "
            "slower, and fine shadows blur. 1: nothing is smoothed",
            11, min=1, max=63, soft_max=31, step=2, subtype="PIXEL"),
    _tuning("filter_direct", "bool", "Direct Light", "Smooth light that reaches surfaces straight from lamps", True),
    _tuning("filter_indirect", "bool", "Light of One Bounce", "Smooth light that was scattered once before", True),
    _tuning("filter_deep", "bool", "Light of More Bounces", "Smooth light that was scattered more often", True),
    _tuning("texture_width", "float", "Texture Width",
            "Cross-Bilateral only: how unlike in texture pixels may be and still be smoothed together",
            0.1, min=0.0001, max=1000.0, soft_min=0.01, soft_max=1.0, step=1, precision=3),
    Setting("keep_film", "bool", "Keep Film",
            "Keep the film in memory after the render, so that the filter can be tuned without rendering again",
            True),
    Setting("live_filter", "bool", "Live Update",
            "Let the picture follow each change of the filter at once, while an Image Editor shows it", True),
    Setting("save_film", "bool", "Save Film",
            "Save the film beside each rendered frame, as frame.cardioid, to filter it again another day", False),
    Setting("pixel_filter", "enum", "Type", "How samples between pixels are weighed",
            "BLACKMAN_HARRIS", "pixel_filter_type", "pixel_filter", k_pixel_filters),
    Setting("filter_width", "float", "Width", "Width of the pixel filter; wider is softer",
            1.5, "filter_width", "filter_width", options={"min": 0.01, "max": 10.0, "subtype": "PIXEL"}),
    Setting("exposure", "float", "Exposure", "Brightness of the picture as it is saved, passes included",
            1.0, "film_exposure", "exposure", options={"min": 0.0, "max": 10.0}),
    Setting("transparent_glass", "bool", "Transparent Glass",
            "Let the background's transparency show through glass too", False, "film_transparent_glass",
            "transparent_glass"),
    Setting("transparent_roughness", "float", "Roughness Threshold", "Glass rougher than this stays opaque",
            0.1, "film_transparent_roughness", "transparent_roughness", options={"min": 0.0, "max": 1.0}),
    Setting("threads", "int", "Threads", "Processor threads to render with. 0: as Blender is set",
            0, None, "threads", options={"min": 0, "max": 1024}),
    Setting("robust_intersection", "bool", "Watertight Rays",
            "Never let a ray slip between two triangles that share an edge. Slower by 12 to 20 percent; "
            "for closed models that are very finely meshed or far from the origin",
            False, None, "robust_intersection"),
    Setting("memory_limit", "int", "Memory Limit (MB)",
            "Refuse to start a render that needs more memory than this. 0: the machine's memory",
            0, None, "memory_limit", options={"min": 0, "max": 1 << 24}),
    Setting("texture_cache", "int", "Texture Cache (MB)", "Memory for textures; larger files are read in pieces",
            1024, None, "texture_cache_mb", options={"min": 16, "max": 1 << 20}),
)

k_by_name = {setting.name: setting for setting in k_settings}
k_tuning = tuple(setting for setting in k_settings if setting.tunes)
