# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of make_golden.py with tables or methods of their own: skies, photometric files, Gabor, normal maps."""

from __future__ import annotations

from golden_values import NOISE, case

IES = """IESNA:LM-63-2002
[TEST] made for a test
TILT=NONE
1 1000 1.5 5 3 1 1 0 0 0
1 1 10
0 22.5 45 67.5 90
0 45 90
100 90 70 30 5
100 80 50 20 4
100 60 40 10 2
"""


def photometric(node) -> None:
    import bpy

    text = bpy.data.texts.get("ies") or bpy.data.texts.new("ies")
    text.from_string(IES)
    node.mode, node.ies = "INTERNAL", text


def sky_cases(version: tuple) -> list[dict]:
    found = []
    analytic = {"sun_direction": (0.3, -0.5, 0.6), "turbidity": 3.4, "ground_albedo": 0.4}
    for kind in ("PREETHAM", "HOSEK_WILKIE"):
        found.append(case(f"sky {kind}", "ShaderNodeTexSky", "Color", {"Vector": "n"}, sky_type=kind, **analytic))
    air = {"sun_elevation": 0.5, "sun_rotation": 0.8, "altitude": 700.0, "air_density": 1.2, "ozone_density": 2.0}
    dust = "aerosol_density" if version >= (5, 0) else "dust_density"
    kinds = ("SINGLE_SCATTERING", "MULTIPLE_SCATTERING") if version >= (5, 0) else ("NISHITA",)
    for kind in kinds:
        params = {"sky_type": kind, **air, dust: 1.7}
        found.append(case(f"sky {kind}", "ShaderNodeTexSky", "Color", {"Vector": "n"}, sun_disc=False, **params))
        below = {"Vector": "v"}  # not of unit length, half of it below the horizon
        found.append(case(f"sky low {kind}", "ShaderNodeTexSky", "Color", below, sun_disc=False, **params))
        sun = {**params, "sun_size": 1.2, "sun_elevation": 1.1, "sun_intensity": 0.7}
        found.append(case(f"sky sun {kind}", "ShaderNodeTexSky", "Color", {"Vector": "n"}, **sun))
    return found


def special_cases(version: tuple) -> list[dict]:
    found = sky_cases(version)
    lines = {"Vector": "v", "Strength": 0.5}
    found.append(case("ies", "ShaderNodeTexIES", "Fac", lines, setup=photometric))
    for k, nm in enumerate((383.0, 440.0, 502.5, 571.0, 640.0, 779.0)):
        found.append(case(f"wavelength {k}", "ShaderNodeWavelength", "Color", {"Wavelength": nm}))
    for strength in (0.4, 1.0, 1.7):
        inputs = {"Strength": strength, "Color": (0.7, 0.35, 0.9, 1.0)}
        found.append(case(f"normal map {strength}", "ShaderNodeNormalMap", "Normal", inputs, uv_map="UVMap"))
    found.append(case("wireframe", "ShaderNodeWireframe", "Fac", {"Size": 0.5}))
    if version >= (4, 5):
        found += newest_cases()
    return found


def newest_cases() -> list[dict]:
    found = []
    for kind in ("2D", "3D"):
        for output in ("Value", "Phase", "Intensity"):
            for anisotropy in (1.0, 0.3):
                inputs = {"Vector": "v", "Scale": 2.0, "Frequency": 1.7, "Anisotropy": anisotropy}
                inputs[f"Orientation {kind}"] = 0.6 if kind == "2D" else (0.5, -0.3, 0.8)
                name = f"gabor {kind} {output} {anisotropy}"
                found.append(case(name, "ShaderNodeTexGabor", output, inputs, NOISE, gabor_type=kind))
    bump = {"Strength": 0.8, "Distance": 0.5, "Height": "c"}
    for width in (0.1, 0.7):
        found.append(case(f"bump {width}", "ShaderNodeBump", "Normal", {**bump, "Filter Width": width}))
    return found
