# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases of make_golden.py: node, properties, inputs (constants or the words of Tile.source) and the output."""

from __future__ import annotations

from golden_special import special_cases
from golden_values import NOISE, case, color_cases, math_cases, vector_cases


def texture_cases(version: tuple) -> list[dict]:
    found = []
    for kind in ("LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "SPHERICAL", "QUADRATIC_SPHERE", "RADIAL"):
        found.append(case(f"gradient {kind}", "ShaderNodeTexGradient", "Fac", {"Vector": "v"}, gradient_type=kind))
    colors = {"Vector": "v", "Color1": (0.9, 0.1, 0.3, 1), "Color2": (0.1, 0.8, 0.2, 1)}
    found.append(case("checker", "ShaderNodeTexChecker", "Color", {**colors, "Scale": 3.3}))
    brick = {**colors, "Mortar": (0.3, 0.3, 0.5, 1), "Scale": 4.0, "Mortar Size": 0.03}
    found.append(case("brick", "ShaderNodeTexBrick", "Color", brick))
    found.append(
        case(
            "brick smooth",
            "ShaderNodeTexBrick",
            "Color",
            {**brick, "Mortar Size": 0.1, "Mortar Smooth": 0.6, "Bias": -0.3},
            offset=0.3,
            offset_frequency=3,
            squash=0.6,
            squash_frequency=2,
        )
    )
    found.append(case("brick mortar", "ShaderNodeTexBrick", "Fac", {**brick, "Mortar Size": 0.1, "Mortar Smooth": 0.8}))
    for depth in (0, 2, 5, 10):
        found.append(
            case(
                f"magic {depth}",
                "ShaderNodeTexMagic",
                "Color",
                {"Vector": "v", "Scale": 2.0, "Distortion": 1.3},
                NOISE,
                turbulence_depth=depth,
            )
        )
    for profile in ("SIN", "SAW", "TRI"):
        for kind, way in (("BANDS", "X"), ("BANDS", "DIAGONAL"), ("RINGS", "Z"), ("RINGS", "SPHERICAL")):
            params = {"wave_type": kind, "wave_profile": profile, f"{kind.lower()}_direction": way}
            found.append(
                case(
                    f"wave {profile} {kind} {way}",
                    "ShaderNodeTexWave",
                    "Fac",
                    {"Vector": "v", "Scale": 1.2, "Distortion": 2.0 if way in ("X", "Z") else 0.0, "Phase Offset": 0.4},
                    NOISE,
                    **params,
                )
            )
    for size in ("1D", "2D", "3D", "4D"):
        place = {} if size == "1D" else {"Vector": "v"}
        if size in ("1D", "4D"):
            place["W"] = "x"
        whole = {key: 0.75 if key == "W" else "f" for key in place}
        found.append(case(f"white noise {size}", "ShaderNodeTexWhiteNoise", "Color", whole, noise_dimensions=size))
        found.append(
            case(
                f"noise {size}",
                "ShaderNodeTexNoise",
                "Color",
                {**place, "Scale": 2.3, "Detail": 3.4, "Roughness": 0.6},
                NOISE,
                noise_dimensions=size,
            )
        )
        found.append(
            case(
                f"noise distorted {size}",
                "ShaderNodeTexNoise",
                "Fac",
                {**place, "Scale": 1.3, "Detail": 2.0, "Distortion": 0.8},
                NOISE,
                noise_dimensions=size,
            )
        )
        for feature in ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"):
            inputs = {**place, "Scale": 2.1, "Randomness": 0.9}
            out = {"DISTANCE_TO_EDGE": "Distance", "N_SPHERE_RADIUS": "Radius"}.get(feature, "Color")
            if version >= (4, 0) and feature != "N_SPHERE_RADIUS":
                inputs = {**inputs, "Detail": 1.6, "Roughness": 0.7, "Lacunarity": 1.9}
            normal = (
                {"normalize": True} if version >= (4, 0) and feature not in ("N_SPHERE_RADIUS", "SMOOTH_F1") else {}
            )
            found.append(
                case(
                    f"voronoi {feature} {size}",
                    "ShaderNodeTexVoronoi",
                    out,
                    inputs,
                    NOISE,
                    voronoi_dimensions=size,
                    feature=feature,
                    **normal,
                )
            )
            if out == "Color" and size in ("2D", "3D"):
                metric = {"F1": "MANHATTAN", "F2": "CHEBYCHEV", "SMOOTH_F1": "MINKOWSKI"}[feature]
                inputs = {**inputs, "Exponent": 1.7} if metric == "MINKOWSKI" else inputs
                found.append(
                    case(
                        f"voronoi {metric} {size}",
                        "ShaderNodeTexVoronoi",
                        "Distance",
                        inputs,
                        NOISE,
                        voronoi_dimensions=size,
                        feature=feature,
                        distance=metric,
                        **normal,
                    )
                )
                found.append(
                    case(
                        f"voronoi position {feature} {size}",
                        "ShaderNodeTexVoronoi",
                        "Position",
                        inputs,
                        NOISE,
                        voronoi_dimensions=size,
                        feature=feature,
                        **normal,
                    )
                )
            if size in ("1D", "4D") and out == "Color":
                found.append(
                    case(
                        f"voronoi w {feature} {size}",
                        "ShaderNodeTexVoronoi",
                        "W",
                        inputs,
                        NOISE,
                        voronoi_dimensions=size,
                        feature=feature,
                        **normal,
                    )
                )
        if version < (4, 1):
            for kind in ("FBM", "MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "HETERO_TERRAIN"):
                inputs = {**place, "Scale": 1.7, "Detail": 3.3, "Dimension": 0.8, "Lacunarity": 2.1}
                if kind not in ("FBM", "MULTIFRACTAL"):
                    inputs["Offset"] = 0.4
                if kind in ("RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL"):
                    inputs["Gain"] = 1.3
                found.append(
                    case(
                        f"musgrave {kind} {size}",
                        "ShaderNodeTexMusgrave",
                        "Fac",
                        inputs,
                        NOISE,
                        musgrave_type=kind,
                        musgrave_dimensions=size,
                    )
                )
    return found


def scene_cases() -> list[dict]:
    """Nodes that look at the surface: coordinates, attributes, spaces, normals."""
    found = [
        case(f"coordinate {out}", "ShaderNodeTexCoord", out)
        for out in ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection")
    ]
    found += [
        case(f"geometry {out}", "ShaderNodeNewGeometry", out)
        for out in ("Position", "Normal", "Tangent", "True Normal", "Incoming", "Parametric", "Backfacing")
    ]
    found += [
        case(f"camera {out}", "ShaderNodeCameraData", out) for out in ("View Vector", "View Z Depth", "View Distance")
    ]
    found += [case(f"object {out}", "ShaderNodeObjectInfo", out) for out in ("Location", "Object Index")]
    found += [
        case(f"light path {out}", "ShaderNodeLightPath", out)
        for out in ("Is Camera Ray", "Is Diffuse Ray", "Ray Length")
    ]
    found.append(case("uv map", "ShaderNodeUVMap", "UV", uv_map="UVMap"))
    found.append(case("attribute uv", "ShaderNodeAttribute", "Vector", attribute_name="UVMap"))
    found.append(case("attribute colour", "ShaderNodeAttribute", "Color", attribute_name="Col"))
    found.append(case("attribute alpha", "ShaderNodeAttribute", "Alpha", attribute_name="Col"))
    found.append(case("attribute missing", "ShaderNodeAttribute", "Color", attribute_name="Nothing"))
    found.append(case("colour attribute", "ShaderNodeVertexColor", "Color", layer_name="Col"))
    for axis in "XYZ":
        found.append(case(f"tangent {axis}", "ShaderNodeTangent", "Tangent", direction_type="RADIAL", axis=axis))
    found.append(case("tangent uv", "ShaderNodeTangent", "Tangent", direction_type="UV_MAP", uv_map="UVMap"))
    for space in ("TANGENT", "OBJECT", "WORLD", "BLENDER_OBJECT", "BLENDER_WORLD"):
        found.append(
            case(
                f"normal map {space}",
                "ShaderNodeNormalMap",
                "Normal",
                {"Color": "c", "Strength": 0.7},
                5e-3,
                space=space,
            )
        )
    for kind in ("POINT", "VECTOR", "NORMAL"):
        for a, b in (("WORLD", "OBJECT"), ("OBJECT", "WORLD"), ("WORLD", "CAMERA"), ("CAMERA", "OBJECT")):
            found.append(
                case(
                    f"transform {kind} {a} {b}",
                    "ShaderNodeVectorTransform",
                    "Vector",
                    {"Vector": "v"},
                    vector_type=kind,
                    convert_from=a,
                    convert_to=b,
                )
            )
    found.append(case("bump", "ShaderNodeBump", "Normal", {"Strength": 0.8, "Distance": 0.5, "Height": "u"}))
    found.append(
        case(
            "bump inverted", "ShaderNodeBump", "Normal", {"Strength": 1.0, "Distance": 0.2, "Height": "y"}, invert=True
        )
    )
    found.append(
        case(
            "bump on normal",
            "ShaderNodeBump",
            "Normal",
            {"Strength": 0.6, "Distance": 0.3, "Height": "y", "Normal": "n"},
        )
    )
    found.append(case("checker generated", "ShaderNodeTexChecker", "Fac", {"Scale": 3.7}))
    return found


def newer_cases() -> list[dict]:
    """What 4.x and later have and 3.4 has not."""
    found = [
        case(
            "mix EXCLUSION",
            "ShaderNodeMix",
            "Result_Color",
            {"Factor_Float": "u", "A_Color": "c", "B_Color": (0.7, 0.2, 0.4, 1)},
            data_type="RGBA",
            blend_type="EXCLUSION",
        ),
        case(
            "math FLOORED_MODULO",
            "ShaderNodeMath",
            "Value",
            {"Value": "x", "Value_001": 0.37},
            operation="FLOORED_MODULO",
        ),
    ]
    for size in ("1D", "2D", "3D", "4D"):
        place = {} if size == "1D" else {"Vector": "v"}
        if size in ("1D", "4D"):
            place["W"] = "x"
        for kind in ("MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "FBM", "HETERO_TERRAIN"):
            inputs = {**place, "Scale": 1.7, "Detail": 2.3, "Roughness": 0.6, "Lacunarity": 2.1, "Distortion": 0.3}
            if kind in ("RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "HETERO_TERRAIN"):
                inputs["Offset"] = 0.4
            if kind in ("RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL"):
                inputs["Gain"] = 1.3
            params = {"noise_type": kind, "noise_dimensions": size}
            if kind == "FBM":
                params["normalize"] = False
            found.append(case(f"noise {kind} {size}", "ShaderNodeTexNoise", "Color", inputs, NOISE, **params))
    return found


def cases(version: tuple) -> list[dict]:
    if version >= (4, 1):
        return newer_cases() + texture_cases(version) + special_cases(version)
    return math_cases() + color_cases() + vector_cases() + texture_cases(version) + scene_cases() + special_cases(version)
