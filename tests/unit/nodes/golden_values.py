# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of make_golden.py that need no surface: arithmetic, colours, ramps and curves, rotations."""

from __future__ import annotations

NOISE = 2e-3  # procedural noise

MATH = [
    "ADD",
    "SUBTRACT",
    "MULTIPLY",
    "DIVIDE",
    "MULTIPLY_ADD",
    "POWER",
    "LOGARITHM",
    "SQRT",
    "INVERSE_SQRT",
    "ABSOLUTE",
    "EXPONENT",
    "MINIMUM",
    "MAXIMUM",
    "LESS_THAN",
    "GREATER_THAN",
    "SIGN",
    "COMPARE",
    "SMOOTH_MIN",
    "SMOOTH_MAX",
    "ROUND",
    "FLOOR",
    "CEIL",
    "TRUNC",
    "FRACT",
    "MODULO",
    "WRAP",
    "SNAP",
    "PINGPONG",
    "SINE",
    "COSINE",
    "TANGENT",
    "ARCSINE",
    "ARCCOSINE",
    "ARCTANGENT",
    "ARCTAN2",
    "SINH",
    "COSH",
    "TANH",
    "RADIANS",
    "DEGREES",
]
VECTOR_MATH = [
    "ADD",
    "SUBTRACT",
    "MULTIPLY",
    "DIVIDE",
    "MULTIPLY_ADD",
    "CROSS_PRODUCT",
    "PROJECT",
    "REFLECT",
    "REFRACT",
    "FACEFORWARD",
    "DOT_PRODUCT",
    "DISTANCE",
    "LENGTH",
    "SCALE",
    "NORMALIZE",
    "ABSOLUTE",
    "MINIMUM",
    "MAXIMUM",
    "FLOOR",
    "CEIL",
    "FRACTION",
    "MODULO",
    "WRAP",
    "SNAP",
    "SINE",
    "COSINE",
    "TANGENT",
]
NUMBER_RESULTS = ("DOT_PRODUCT", "DISTANCE", "LENGTH")
BLENDS = [
    "MIX",
    "DARKEN",
    "MULTIPLY",
    "BURN",
    "LIGHTEN",
    "SCREEN",
    "DODGE",
    "ADD",
    "OVERLAY",
    "SOFT_LIGHT",
    "LINEAR_LIGHT",
    "DIFFERENCE",
    "SUBTRACT",
    "DIVIDE",
    "HUE",
    "SATURATION",
    "COLOR",
    "VALUE",
]


def case(
    name: str, kind: str, output: str, inputs: dict | None = None, tolerance: float = 1e-3, setup=None, **params
) -> dict:
    found = {
        "name": name,
        "type": kind,
        "output": output,
        "inputs": inputs or {},
        "params": params,
        "tolerance": tolerance,
    }
    if setup is not None:
        found["setup"] = setup
    return found


def math_cases() -> list[dict]:
    found = []
    for op in MATH:
        inputs = {"Value": "x", "Value_001": "y", "Value_002": 0.3}
        if op in ("POWER", "LOGARITHM", "SQRT", "INVERSE_SQRT"):
            inputs = {"Value": "u", "Value_001": 2.7}
        if op in ("MODULO", "SNAP", "PINGPONG", "WRAP"):
            inputs = {"Value": "x", "Value_001": 0.37, "Value_002": -0.11}
        found.append(case(f"math {op}", "ShaderNodeMath", "Value", inputs, operation=op))
    found.append(
        case("math POWER whole", "ShaderNodeMath", "Value", {"Value": "x", "Value_001": 3.0}, operation="POWER")
    )
    found.append(
        case("math clamp", "ShaderNodeMath", "Value", {"Value": "x", "Value_001": "y"}, operation="ADD", use_clamp=True)
    )
    for op in VECTOR_MATH:
        inputs = {"Vector": "v", "Vector_001": "c", "Vector_002": (0.3, -0.4, 0.7)}
        if op == "SCALE":
            inputs = {"Vector": "v", "Scale": 1.7}
        if op == "REFRACT":
            inputs = {"Vector": "v", "Vector_001": "n", "Scale": 0.8}
        if op in ("MODULO", "SNAP", "WRAP"):
            inputs = {"Vector": "v", "Vector_001": (0.37, 0.21, 0.6), "Vector_002": (-0.1, -0.2, 0.0)}
        inputs = {
            k: v
            for k, v in inputs.items()
            if not (k == "Vector_002" and op not in ("MULTIPLY_ADD", "FACEFORWARD", "WRAP"))
        }
        if op in ("LENGTH", "NORMALIZE", "ABSOLUTE", "FLOOR", "CEIL", "FRACTION", "SINE", "COSINE", "TANGENT"):
            inputs = {"Vector": "v"}
        found.append(
            case(
                f"vector math {op}",
                "ShaderNodeVectorMath",
                "Value" if op in NUMBER_RESULTS else "Vector",
                inputs,
                operation=op,
            )
        )
    for kind in ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP"):
        for clamp in (True, False):
            inputs = {"Value": "x", "From Min": -0.6, "From Max": 0.5, "To Min": 1.2, "To Max": -0.4}
            if kind == "STEPPED":
                inputs["Steps"] = 3.0
            found.append(
                case(
                    f"map range {kind} {clamp}",
                    "ShaderNodeMapRange",
                    "Result",
                    inputs,
                    interpolation_type=kind,
                    clamp=clamp,
                )
            )
        inputs = {
            "Vector": "v",
            "From_Min_FLOAT3": (-0.6, -0.5, -0.1),
            "From_Max_FLOAT3": (0.5, 0.2, 0.3),
            "To_Min_FLOAT3": (1, 0, 2),
            "To_Max_FLOAT3": (2, 3, -1),
        }
        found.append(
            case(
                f"map range vector {kind}",
                "ShaderNodeMapRange",
                "Vector",
                inputs,
                interpolation_type=kind,
                data_type="FLOAT_VECTOR",
            )
        )
    for kind in ("MINMAX", "RANGE"):
        found.append(
            case(f"clamp {kind}", "ShaderNodeClamp", "Result", {"Value": "x", "Min": 0.4, "Max": -0.3}, clamp_type=kind)
        )
    return found


def ramp(stops, interpolation, mode="RGB", hue="NEAR"):
    def setup(node) -> None:
        band = node.color_ramp
        band.color_mode, band.interpolation = mode, interpolation
        if mode != "RGB":
            band.hue_interpolation = hue
        band.elements[0].position, band.elements[0].color = stops[0]
        band.elements[1].position, band.elements[1].color = stops[-1]
        for position, color in stops[1:-1]:
            band.elements.new(position).color = color

    return setup


def curve(points_by_curve, extend="EXTRAPOLATED"):
    def setup(node) -> None:
        node.mapping.extend = extend
        for index, points in points_by_curve.items():
            line = node.mapping.curves[index]
            line.points[0].location, line.points[-1].location = points[0], points[-1]
            for x, y in points[1:-1]:
                line.points.new(x, y)
        node.mapping.update()

    return setup


def color_cases() -> list[dict]:
    found = []
    for mode in BLENDS:
        inputs = {"Factor_Float": "u", "A_Color": "c", "B_Color": (0.7, 0.2, 0.4, 1)}
        found.append(case(f"mix {mode}", "ShaderNodeMix", "Result_Color", inputs, data_type="RGBA", blend_type=mode))
    found.append(
        case(
            "mix rgb",
            "ShaderNodeMixRGB",
            "Color",
            {"Fac": "x", "Color1": "c", "Color2": (0.9, 0.1, 2, 1)},
            blend_type="ADD",
            use_clamp=True,
        )
    )
    found.append(
        case(
            "mix free factor",
            "ShaderNodeMix",
            "Result_Color",
            {"Factor_Float": "x", "A_Color": "c", "B_Color": (1, 0, 2, 1)},
            data_type="RGBA",
            clamp_factor=False,
            clamp_result=True,
        )
    )
    found.append(
        case(
            "mix float",
            "ShaderNodeMix",
            "Result_Float",
            {"Factor_Float": "u", "A_Float": "y", "B_Float": 3.0},
            data_type="FLOAT",
        )
    )
    found.append(
        case(
            "mix vector",
            "ShaderNodeMix",
            "Result_Vector",
            {"Factor_Float": "x", "A_Vector": "v", "B_Vector": (1, 2, 3)},
            data_type="VECTOR",
        )
    )
    found.append(
        case(
            "mix vector each",
            "ShaderNodeMix",
            "Result_Vector",
            {"Factor_Vector": "v", "A_Vector": (0, 1, 0), "B_Vector": (1, 2, 3)},
            data_type="VECTOR",
            factor_mode="NON_UNIFORM",
        )
    )
    found.append(
        case(
            "hue saturation",
            "ShaderNodeHueSaturation",
            "Color",
            {"Hue": 0.8, "Saturation": 1.6, "Value": 0.7, "Fac": 0.9, "Color": "c"},
        )
    )
    found.append(
        case("bright contrast", "ShaderNodeBrightContrast", "Color", {"Bright": 0.2, "Contrast": 0.7, "Color": "c"})
    )
    found.append(case("gamma", "ShaderNodeGamma", "Color", {"Gamma": 2.2, "Color": "c"}))
    found.append(case("gamma zero", "ShaderNodeGamma", "Color", {"Gamma": 0.0, "Color": "c"}))
    found.append(case("invert", "ShaderNodeInvert", "Color", {"Fac": 0.8, "Color": "c"}))
    found.append(case("rgb to bw", "ShaderNodeRGBToBW", "Val", {"Color": "c"}))
    found.append(case("blackbody", "ShaderNodeBlackbody", "Color", {"Temperature": 4200.0}))
    for k, t in enumerate((600.0, 900.0, 1100.0, 1300.0, 1700.0, 2800.0, 9000.0, 20000.0)):
        found.append(case(f"blackbody {k}", "ShaderNodeBlackbody", "Color", {"Temperature": t}))
    for mode in ("RGB", "HSV", "HSL"):
        found.append(case(f"separate {mode}", "ShaderNodeSeparateColor", "Red", {"Color": "c"}, mode=mode))
        found.append(case(f"separate second {mode}", "ShaderNodeSeparateColor", "Green", {"Color": "c"}, mode=mode))
        found.append(
            case(
                f"combine {mode}", "ShaderNodeCombineColor", "Color", {"Red": "u", "Green": 0.6, "Blue": 0.7}, mode=mode
            )
        )
    found.append(case("separate hsv", "ShaderNodeSeparateHSV", "S", {"Color": "c"}))
    found.append(case("combine rgb", "ShaderNodeCombineRGB", "Image", {"R": "x", "G": "y", "B": 0.1}))
    two = [(0.1, (0.9, 0.1, 0.2, 1)), (0.8, (0.1, 0.3, 0.9, 0.5))]
    four = [(0.05, (0.9, 0.1, 0.2, 1)), (0.3, (0.2, 0.8, 0.1, 0.3)), (0.6, (0.3, 0.3, 0.9, 1)), (0.9, (1, 1, 0.2, 0.5))]
    for mode in ("LINEAR", "EASE", "CONSTANT", "CARDINAL", "B_SPLINE"):
        for name, stops in (("two", two), ("four", four)):
            found.append(
                case(f"ramp {mode} {name}", "ShaderNodeValToRGB", "Color", {"Fac": "u"}, setup=ramp(stops, mode))
            )
    for hue in ("NEAR", "FAR", "CW", "CCW"):
        found.append(
            case(f"ramp hsv {hue}", "ShaderNodeValToRGB", "Color", {"Fac": "u"}, setup=ramp(two, "LINEAR", "HSV", hue))
        )
    found.append(case("ramp hsl", "ShaderNodeValToRGB", "Color", {"Fac": "u"}, setup=ramp(four, "LINEAR", "HSL")))
    found.append(case("ramp alpha", "ShaderNodeValToRGB", "Alpha", {"Fac": "x"}, setup=ramp(four, "LINEAR")))
    bent = {0: [(0, 0.1), (0.4, 0.7), (1, 0.9)], 2: [(0, 1), (1, 0)], 3: [(0, 0), (0.5, 0.3), (1, 1)]}
    found.append(case("rgb curves", "ShaderNodeRGBCurve", "Color", {"Fac": 0.9, "Color": "c"}, setup=curve(bent)))
    found.append(
        case(
            "rgb curves outside",
            "ShaderNodeRGBCurve",
            "Color",
            {"Fac": 1.0, "Color": "v"},
            setup=curve(bent, "HORIZONTAL"),
        )
    )
    found.append(
        case(
            "vector curves",
            "ShaderNodeVectorCurve",
            "Vector",
            {"Fac": 1.0, "Vector": "v"},
            setup=curve({1: [(-1, -1), (0.2, 0.7), (1, 1)]}),
        )
    )
    found.append(
        case(
            "float curve",
            "ShaderNodeFloatCurve",
            "Value",
            {"Factor": 1.0, "Value": "x"},
            setup=curve({0: [(0, 0.2), (0.3, 0.8), (1, 0.4)]}),
        )
    )
    return found


def vector_cases() -> list[dict]:
    found = []
    for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL"):
        inputs = {"Vector": "v", "Rotation": (0.3, -0.7, 1.1), "Scale": (1.2, 0.5, 2.0)}
        if kind in ("POINT", "TEXTURE"):
            inputs["Location"] = (0.1, 0.2, -0.4)
        found.append(case(f"mapping {kind}", "ShaderNodeMapping", "Vector", inputs, vector_type=kind))
    for kind in ("AXIS_ANGLE", "X_AXIS", "Y_AXIS", "Z_AXIS", "EULER_XYZ"):
        inputs = {"Vector": "v", "Center": (0.1, 0.2, 0.3)}
        if kind == "EULER_XYZ":
            inputs["Rotation"] = (0.3, -0.7, 1.1)
        else:
            inputs["Angle"] = 0.8
        if kind == "AXIS_ANGLE":
            inputs["Axis"] = (0.4, 0.5, 1.0)
        found.append(
            case(
                f"rotate {kind}",
                "ShaderNodeVectorRotate",
                "Vector",
                inputs,
                rotation_type=kind,
                invert=kind in ("X_AXIS", "EULER_XYZ"),
            )
        )
    found.append(case("fresnel", "ShaderNodeFresnel", "Fac", {"IOR": 1.6, "Normal": "n"}))
    found.append(case("layer weight fresnel", "ShaderNodeLayerWeight", "Fresnel", {"Blend": 0.3, "Normal": "n"}))
    found.append(case("layer weight facing", "ShaderNodeLayerWeight", "Facing", {"Blend": 0.8, "Normal": "n"}))
    found.append(case("layer weight half", "ShaderNodeLayerWeight", "Facing", {"Blend": 0.5, "Normal": "n"}))
    found.append(case("separate xyz", "ShaderNodeSeparateXYZ", "Y", {"Vector": "v"}))
    found.append(case("colour to number", "ShaderNodeMath", "Value", {"Value": "c", "Value_001": 0.0}, operation="ADD"))
    return found
