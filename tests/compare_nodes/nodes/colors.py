# SPDX-License-Identifier: GPL-3.0-or-later
"""Mixing, ramps, curves, and everything that turns one colour into another or a number into a colour."""

from __future__ import annotations

from registry import row
from tile import COL, COL2, P1, Q1, U1, V1, VEC, VEC2, P, U, V, combined, scaled

BLENDS = ("MIX", "DARKEN", "MULTIPLY", "BURN", "LIGHTEN", "SCREEN", "DODGE", "ADD", "OVERLAY", "SOFT_LIGHT",
          "LINEAR_LIGHT", "DIFFERENCE", "EXCLUSION", "SUBTRACT", "DIVIDE", "HUE", "SATURATION", "COLOR",
          "VALUE")  # fmt: skip
FACTOR = scaled(P1, -0.5, 1.5)
COLORS = {"A_Color": COL, "B_Color": COL2}

for blend in BLENDS:
    mix = {"data_type": "RGBA", "blend_type": blend}
    row(f"mix/{blend}", "Mix", {"Factor_Float": FACTOR, **COLORS}, "Result_Color", **mix)
    row(f"mix/{blend}/free factor", "Mix", {"Factor_Float": FACTOR, **COLORS}, "Result_Color", clamp_factor=False,
        **mix)  # fmt: skip
    row(f"mix/{blend}/clamp, wide", "Mix", {"Factor_Float": 0.7, "A_Color": VEC, "B_Color": VEC2}, "Result_Color",
        clamp_result=True, **mix)  # fmt: skip
    row(f"mix/{blend}/wide", "Mix", {"Factor_Float": 0.7, "A_Color": VEC, "B_Color": VEC2}, "Result_Color", **mix)
    row(f"mix rgb/{blend}", "MixRGB", {"Fac": FACTOR, "Color1": COL, "Color2": COL2}, blend_type=blend)
    row(f"mix rgb/{blend}/clamp", "MixRGB", {"Fac": 0.8, "Color1": VEC, "Color2": COL2}, blend_type=blend,
        use_clamp=True)  # fmt: skip
for free in (False, True):
    way = {"clamp_factor": not free}
    end = "/free" if free else ""
    row(f"mix/float{end}", "Mix", {"Factor_Float": FACTOR, "A_Float": U, "B_Float": V}, "Result_Float", **way)
    row(f"mix/vector{end}", "Mix", {"Factor_Float": FACTOR, "A_Vector": VEC, "B_Vector": VEC2}, "Result_Vector",
        data_type="VECTOR", **way)  # fmt: skip
    row(f"mix/vector non-uniform{end}", "Mix", {"Factor_Vector": VEC2, "A_Vector": VEC, "B_Vector": (0.5, -1.0, 2.0)},
        "Result_Vector", data_type="VECTOR", factor_mode="NON_UNIFORM", **way)  # fmt: skip
row("mix/constants", "Mix", {"Factor_Float": 0.3, "A_Color": (0.2, 0.5, 0.9), "B_Color": (1.5, 0.1, 0.3)},
    "Result_Color", data_type="RGBA", blend_type="OVERLAY")  # fmt: skip


def ramp(interpolation: str, mode: str = "RGB", hue: str = "NEAR", stops: int = 4):
    points = [(0.1, (0.9, 0.1, 0.2, 1.0)), (0.35, (0.1, 0.7, 0.3, 0.5)), (0.6, (0.2, 0.2, 0.95, 0.8)),
              (0.85, (1.0, 0.9, 0.1, 0.1))]  # fmt: skip

    def setup(node) -> None:
        band = node.color_ramp
        band.color_mode = mode
        if mode == "RGB":
            band.interpolation = interpolation
        else:
            band.hue_interpolation = hue
        while len(band.elements) > 1:
            band.elements.remove(band.elements[0])
        for i in range(1, stops):
            band.elements.new(points[i][0])
        for element, (position, color) in zip(band.elements, points):
            element.position, element.color = position, color

    return setup


for interpolation in ("LINEAR", "EASE", "CONSTANT", "B_SPLINE", "CARDINAL"):
    row(f"ramp/{interpolation}", "ValToRGB", {"Fac": scaled(U1, -0.2, 1.2)}, "Color", setup=ramp(interpolation))
    row(f"ramp/{interpolation}/alpha", "ValToRGB", {"Fac": scaled(V1, -0.2, 1.2)}, "Alpha", setup=ramp(interpolation))
for mode in ("HSV", "HSL"):
    for hue in ("NEAR", "FAR", "CW", "CCW"):
        row(f"ramp/{mode}/{hue}", "ValToRGB", {"Fac": U1}, "Color", setup=ramp("LINEAR", mode, hue))
row("ramp/one stop", "ValToRGB", {"Fac": U1}, "Color", setup=ramp("LINEAR", stops=1))
row("ramp/constant input", "ValToRGB", {"Fac": 0.47}, "Color", setup=ramp("EASE"))


def curves(extend: str = "HORIZONTAL", combined_too: bool = True, handles: str = "AUTO", low: float = 0.0,
           high: float = 1.0):  # fmt: skip
    def setup(node) -> None:
        mapping = node.mapping
        mapping.extend = extend
        if low != 0.0 or high != 1.0:
            mapping.use_clip = True
            mapping.clip_min_x, mapping.clip_min_y, mapping.clip_max_x, mapping.clip_max_y = low, low, high, high
        for i, curve in enumerate(mapping.curves):
            if i < 3 or combined_too:
                x = low + (high - low) * (0.25 + 0.1 * i)
                point = curve.points.new(x, low + (high - low) * (0.7 - 0.15 * i))
                point.handle_type = handles
        mapping.update()

    return setup


WIDE = combined(scaled(U1, -0.4, 1.5), scaled(V1, -0.3, 1.4), scaled(P1, -0.5, 1.5))
for extend in ("HORIZONTAL", "EXTRAPOLATED"):
    row(f"rgb curves/{extend}", "RGBCurve", {"Fac": 1.0, "Color": COL}, setup=curves(extend))
    row(f"rgb curves/{extend}/wide", "RGBCurve", {"Fac": scaled(Q1, -0.5, 1.5), "Color": WIDE}, setup=curves(extend))
    row(f"vector curves/{extend}", "VectorCurve", {"Fac": 0.8, "Vector": WIDE}, setup=curves(extend, low=-1.0))
    row(f"float curve/{extend}", "FloatCurve", {"Factor": 0.9, "Value": scaled(U1, -0.5, 1.5)}, setup=curves(extend))
row("rgb curves/one by one", "RGBCurve", {"Color": COL}, setup=curves(combined_too=False, handles="VECTOR"))
row("rgb curves/untouched", "RGBCurve", {"Color": COL})
row("vector curves/far", "VectorCurve", {"Vector": VEC}, setup=curves("EXTRAPOLATED", low=-1.0))
row("float curve/linked factor", "FloatCurve", {"Factor": V1, "Value": U1}, setup=curves())

row("hue saturation/color", "HueSaturation",
    {"Hue": scaled(P1, 0.0, 1.0), "Saturation": 1.4, "Value": 0.8, "Fac": 0.9, "Color": COL})  # fmt: skip
row("hue saturation/linked", "HueSaturation",
    {"Hue": U1, "Saturation": scaled(V1, 0.0, 2.0), "Value": scaled(P1, 0.0, 2.0), "Fac": Q1, "Color": COL2})
row("hue saturation/wide", "HueSaturation", {"Hue": 0.7, "Saturation": 1.9, "Value": 1.1, "Color": VEC})
row("brightness contrast/color", "BrightContrast", {"Color": COL, "Bright": 0.2, "Contrast": 0.5})
row("brightness contrast/linked", "BrightContrast", {"Color": VEC, "Bright": P, "Contrast": U})
row("gamma/color", "Gamma", {"Color": COL, "Gamma": 2.2})
row("gamma/linked", "Gamma", {"Color": VEC, "Gamma": scaled(Q1, 0.0, 3.0)})
row("gamma/zero", "Gamma", {"Color": COL, "Gamma": 0.0})
row("invert/color", "Invert", {"Fac": 1.0, "Color": COL})
row("invert/linked", "Invert", {"Fac": U, "Color": VEC})
row("rgb to bw/color", "RGBToBW", {"Color": COL})
row("rgb to bw/wide", "RGBToBW", {"Color": VEC})
row("rgb/value", "RGB", setup=lambda node: setattr(node.outputs[0], "default_value", (0.3, 1.7, 0.05, 0.5)))

row("blackbody/low", "Blackbody", {"Temperature": scaled(U1, -100.0, 1500.0)})
row("blackbody/all", "Blackbody", {"Temperature": scaled(U1, 800.0, 15000.0)})
row("blackbody/constant", "Blackbody", {"Temperature": 3300.0})
row("wavelength/all", "Wavelength", {"Wavelength": scaled(U1, 360.0, 800.0)})
row("wavelength/constant", "Wavelength", {"Wavelength": 530.0})
for output in ("Quadratic", "Linear", "Constant"):
    row(f"light falloff/{output}", "LightFalloff", {"Strength": scaled(U1, 0.0, 20.0), "Smooth": scaled(V1, 0.0, 3.0)},
        output, floor=0.1)  # fmt: skip
row("mix/linked factor", "Mix", {"Factor_Float": V1, **COLORS}, "Result_Color", data_type="RGBA", blend_type="HUE")
