# SPDX-License-Identifier: GPL-3.0-or-later
"""Math, Vector Math, Clamp, Map Range, Float Curve and Value."""

from __future__ import annotations

from registry import row
from tile import P1, U1, V1, VEC, VEC2, VEC3, P, Q, U, V, scaled

ONE = ("SQRT", "INVERSE_SQRT", "ABSOLUTE", "EXPONENT", "SIGN", "ROUND", "FLOOR", "CEIL", "TRUNC", "FRACT", "SINE",
       "COSINE", "TANGENT", "ARCSINE", "ARCCOSINE", "ARCTANGENT", "SINH", "COSH", "TANH", "RADIANS",
       "DEGREES")  # fmt: skip
TWO = ("ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "POWER", "LOGARITHM", "MINIMUM", "MAXIMUM", "LESS_THAN",
       "GREATER_THAN", "MODULO", "FLOORED_MODULO", "SNAP", "PINGPONG", "ARCTAN2")  # fmt: skip
THREE = ("MULTIPLY_ADD", "COMPARE", "SMOOTH_MIN", "SMOOTH_MAX", "WRAP")

for name in ONE:
    row(f"math/{name}", "Math", {0: U}, operation=name)
for name in TWO:
    row(f"math/{name}", "Math", {0: U, 1: V}, operation=name)
    row(f"math/{name}/by-1.5", "Math", {0: U, 1: -1.5}, operation=name)
for name in THREE:
    row(f"math/{name}", "Math", {0: U, 1: V, 2: scaled(P1, 0.1, 1.5)}, operation=name)
    row(f"math/{name}/negative", "Math", {0: U, 1: V, 2: -0.4}, operation=name)
for name in ("ADD", "TANGENT", "DIVIDE", "POWER"):
    row(f"math/{name}/clamp", "Math", {0: U, 1: V}, operation=name, use_clamp=True)
row("math/POWER/whole", "Math", {0: U, 1: 3.0}, operation="POWER")
row("math/POWER/zero", "Math", {0: U, 1: 0.0}, operation="POWER")
row("math/DIVIDE/zero", "Math", {0: U, 1: 0.0}, operation="DIVIDE")
row("math/SNAP/zero", "Math", {0: U, 1: 0.0}, operation="SNAP")
row("math/WRAP/empty", "Math", {0: U, 1: 1.0, 2: 1.0}, operation="WRAP")
row("math/SMOOTH_MIN/zero", "Math", {0: U, 1: V, 2: 0.0}, operation="SMOOTH_MIN")
for a, b in ((2.5, -1.25), (-0.5, 0.5), (0.0, 0.0)):
    for name in ("POWER", "LOGARITHM", "MODULO", "SNAP", "PINGPONG", "ARCTAN2"):
        row(f"math/{name}/constants {a} {b}", "Math", {0: a, 1: b}, operation=name)

VECTORS_ONE = ("NORMALIZE", "LENGTH", "ABSOLUTE", "FLOOR", "CEIL", "FRACTION", "SINE", "COSINE", "TANGENT", "SIGN")
VECTORS_TWO = ("ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "CROSS_PRODUCT", "PROJECT", "REFLECT", "DOT_PRODUCT",
               "DISTANCE", "MINIMUM", "MAXIMUM", "MODULO", "SNAP", "POWER")  # fmt: skip
VECTORS_THREE = ("MULTIPLY_ADD", "FACEFORWARD")

for name in VECTORS_ONE:
    row(f"vector math/{name}", "VectorMath", {0: VEC}, None, operation=name)
for name in VECTORS_TWO:
    row(f"vector math/{name}", "VectorMath", {0: VEC, 1: VEC2}, None, operation=name)
    row(f"vector math/{name}/constant", "VectorMath", {0: VEC, 1: (0.7, -1.2, 0.0)}, None, operation=name)
for name in VECTORS_THREE:
    row(f"vector math/{name}", "VectorMath", {0: VEC, 1: VEC2, 2: VEC3}, None, operation=name)
row("vector math/WRAP", "VectorMath", {0: VEC, 1: (1.3, -0.8, 1.0), 2: VEC2}, None, operation="WRAP")
row("vector math/SCALE", "VectorMath", {0: VEC, "Scale": Q}, None, operation="SCALE")
row("vector math/REFRACT", "VectorMath", {0: VEC, 1: VEC2, "Scale": scaled(P1, 0.5, 1.6)}, None, operation="REFRACT")
row("vector math/NORMALIZE/constant", "VectorMath", {0: (0.0, 0.0, 0.0)}, None, operation="NORMALIZE")

for kind in ("MINMAX", "RANGE"):
    row(f"clamp/{kind}", "Clamp", {"Value": U, "Min": V, "Max": P}, clamp_type=kind)
    row(f"clamp/{kind}/constants", "Clamp", {"Value": U, "Min": 1.0, "Max": -0.5}, clamp_type=kind)

for kind in ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP"):
    steps = {"Steps": 3.5} if kind == "STEPPED" else {}
    ends = {"From Min": -1.2, "From Max": 1.9, "To Min": 0.3, "To Max": -2.0}
    for clamp in (True, False):
        row(f"map range/{kind}/{'clamp' if clamp else 'free'}", "MapRange", {"Value": U, **ends, **steps},
            interpolation_type=kind, clamp=clamp)  # fmt: skip
    linked = {"Value": U, "From Min": V, "From Max": P, "To Min": Q, "To Max": 2.0}
    row(f"map range/{kind}/linked", "MapRange", {**linked, **steps}, interpolation_type=kind)
    row(f"map range/{kind}/empty", "MapRange", {"Value": U, "From Min": 1.0, "From Max": 1.0, **steps},
        interpolation_type=kind)  # fmt: skip
    vector = {"Vector": VEC, "From_Min_FLOAT3": VEC2, "From_Max_FLOAT3": (1.0, 2.0, 0.5), "To_Min_FLOAT3": VEC3,
              "To_Max_FLOAT3": (-1.0, 3.0, 0.2)}  # fmt: skip
    if steps:
        vector |= {"Steps_FLOAT3": (2.0, 3.5, 0.0), "From_Min_FLOAT3": (-1.2, 0.3, -2.0)}
    for clamp in (True, False):
        row(f"map range/vector {kind}/{'clamp' if clamp else 'free'}", "MapRange", vector, "Vector",
            data_type="FLOAT_VECTOR", interpolation_type=kind, clamp=clamp)  # fmt: skip

row("clamp/unit", "Clamp", {"Value": U})
row("value", "Value", setup=lambda node: setattr(node.outputs[0], "default_value", -3.25))
row("map range/unit", "MapRange", {"Value": U1, "To Min": V1})
row("vector math/SCALE/constant", "VectorMath", {0: VEC, "Scale": V}, None, operation="SCALE")
