# SPDX-License-Identifier: GPL-3.0-or-later
"""The closures that are compared: sheets of rows, a row sweeps one input of one node over five balls.

A row that this Blender does not have (no such node, input or choice) is left out. Inputs have several names where they
were renamed between versions: the first one that the node has counts.
"""

from __future__ import annotations

from dataclasses import dataclass, field

ROUGH = (0.0, 0.1, 0.3, 0.6, 1.0)
SHARE = (0.0, 0.25, 0.5, 0.75, 1.0)
GOLD, PALE, RED = (0.9, 0.65, 0.3, 1.0), (0.95, 0.97, 0.9, 1.0), (0.75, 0.25, 0.15, 1.0)


@dataclass(frozen=True)
class Row:
    """`sweep`: names of an input and its values; `inputs`: fixed ones; `choices`: the node's own properties.
    `socket`: where the node goes on the output."""

    label: str
    kind: str
    sweep: tuple[str, tuple]
    inputs: dict = field(default_factory=dict)
    choices: dict = field(default_factory=dict)
    socket: str = "Surface"


def rough(label: str, kind: str, *distributions: str, **inputs) -> list[Row]:
    return [Row(f"{label} {d}", kind, ("Roughness", ROUGH), inputs, {"distribution": d}) for d in distributions]


def principled(label: str, name: str, values: tuple = SHARE, **inputs) -> Row:
    base = {"Base Color": RED, "Roughness": 0.4}
    return Row(f"Principled {label}", "BsdfPrincipled", (name, values), base | inputs)


def subsurface(method: str, values: tuple = (0.02, 0.05, 0.1, 0.3, 1.0), **inputs) -> Row:
    fixed = {"Color": (0.8, 0.5, 0.3, 1.0), "Radius": (1.0, 0.4, 0.2)} | inputs
    label = f"Subsurface {method}" + "".join(f" {name} {value}" for name, value in inputs.items())
    return Row(label, "SubsurfaceScattering", ("Scale", values), fixed, {"falloff": method})


COATED = {"Coat Weight|Clearcoat": 1.0}
GLASS = {"Base Color": PALE, "Transmission Weight|Transmission": 1.0}
SKIN = {name: (0.8, 0.5, 0.3, 1.0) for name in ("Base Color", "Subsurface Color")}
SKIN["Subsurface Radius"] = (1.0, 0.4, 0.2)
FILM = {"Thin Film Thickness": 400.0}
BASE = {"Color": GOLD}

SHEETS: dict[str, list[Row]] = {
    "glossy": [
        *rough("Glossy", "BsdfGlossy|BsdfAnisotropic", "GGX", "BECKMANN", "MULTI_GGX", "ASHIKHMIN_SHIRLEY", **BASE),
        Row("Glossy SHARP", "BsdfGlossy", ("Color", (GOLD, PALE, RED, (1, 1, 1, 1), (0.1, 0.1, 0.1, 1))), {},
            {"distribution": "SHARP"}),
        *(Row(f"Anisotropic {d} {r}", "BsdfAnisotropic", ("Anisotropy", (-0.8, -0.4, 0.3, 0.6, 0.9)),
              {"Color": GOLD, "Roughness": r, "Rotation": 0.1}, {"distribution": d})
          for d in ("GGX", "BECKMANN", "ASHIKHMIN_SHIRLEY") for r in (0.2, 0.5)),
    ],
    "glass": [
        *rough("Glass", "BsdfGlass", "GGX", "BECKMANN", "MULTI_GGX", Color=PALE, IOR=1.45),
        *rough("Refraction", "BsdfRefraction", "GGX", "BECKMANN", Color=PALE, IOR=1.3),
        Row("Glass IOR", "BsdfGlass", ("IOR", (0.8, 1.0, 1.2, 1.8, 2.5)), {"Color": PALE, "Roughness": 0.3},
            {"distribution": "GGX"}),
        Row("Glass film", "BsdfGlass", ("Thin Film Thickness", (0.0, 200.0, 400.0, 600.0, 900.0)),
            {"Color": PALE, "Roughness": 0.2, "Thin Film IOR": 1.33}, {"distribution": "GGX"}),
    ],
    "metallic": [
        *(Row(f"Metallic {t} {d}", "BsdfMetallic", ("Roughness", ROUGH), {}, {"fresnel_type": t, "distribution": d})
          for t in ("F82", "PHYSICAL_CONDUCTOR") for d in ("GGX", "MULTI_GGX", "BECKMANN")),
        *(Row(f"Metallic film {t}", "BsdfMetallic", ("Thin Film Thickness", (0.0, 200.0, 400.0, 600.0, 900.0)),
              {"Roughness": 0.3, "Thin Film IOR": 1.4}, {"fresnel_type": t}) for t in ("F82", "PHYSICAL_CONDUCTOR")),
        Row("Metallic anisotropy", "BsdfMetallic", ("Anisotropy", (0.0, 0.2, 0.4, 0.7, 0.9)), {"Roughness": 0.4}),
    ],
    "diffuse": [
        Row("Diffuse", "BsdfDiffuse", ("Roughness", ROUGH), {"Color": RED}),
        Row("Translucent", "BsdfTranslucent", ("Color", (GOLD, PALE, RED, (1, 1, 1, 1), (0.1, 0.1, 0.1, 1)))),
        Row("Transparent", "BsdfTransparent", ("Color", (GOLD, PALE, RED, (1, 1, 1, 1), (0.1, 0.1, 0.1, 1)))),
        Row("Velvet", "BsdfVelvet", ("Sigma", (0.05, 0.2, 0.5, 0.8, 1.0)), BASE),
        *(Row(f"Sheen {d}", "BsdfSheen", ("Roughness", (0.05, 0.1, 0.3, 0.6, 1.0)), BASE, {"distribution": d})
          for d in ("ASHIKHMIN", "MICROFIBER")),
        *(Row(f"Toon {c} smooth {s}", "BsdfToon", ("Size", (0.1, 0.3, 0.5, 0.7, 0.9)), {"Color": GOLD, "Smooth": s},
              {"component": c}) for c in ("DIFFUSE", "GLOSSY") for s in (0.0, 0.4)),
    ],
    "principled": [
        principled("roughness", "Roughness", ROUGH),
        principled("metallic", "Metallic"),
        principled("metal roughness", "Roughness", ROUGH, Metallic=1.0),
        principled("diffuse roughness", "Diffuse Roughness", ROUGH),
        principled("specular", "Specular IOR Level|Specular"),
        principled("specular tint", "Specular Tint", (0.0, 0.3, 0.5, 0.8, 1.0)),
        principled("ior", "IOR", (1.0, 1.2, 1.5, 2.0, 3.0)),
        principled("anisotropic", "Anisotropic", (0.0, 0.3, 0.5, 0.8, 1.0), Metallic=1.0),
        principled("sheen", "Sheen Weight|Sheen"),
        principled("sheen roughness", "Sheen Roughness", (0.05, 0.2, 0.5, 0.8, 1.0), **{"Sheen Weight": 1.0}),
        principled("sheen tint", "Sheen Tint", (0.0, 0.3, 0.5, 0.8, 1.0), **{"Sheen Weight|Sheen": 1.0}),
        principled("alpha", "Alpha"),
        principled("emission", "Emission Strength", (0.0, 0.2, 0.5, 1.0, 2.0),
                   **{"Emission Color|Emission": (0.3, 0.6, 1.0, 1.0)}),
    ],
    "principled_layers": [
        principled("coat", "Coat Weight|Clearcoat"),
        principled("coat roughness", "Coat Roughness|Clearcoat Roughness", ROUGH, **COATED),
        principled("coat ior", "Coat IOR", (1.0, 1.2, 1.5, 2.0, 3.0), **COATED),
        principled("coat tint", "Coat Tint", (GOLD, PALE, RED, (1, 1, 1, 1), (0.1, 0.1, 0.1, 1)), **COATED),
        principled("transmission", "Transmission Weight|Transmission"),
        principled("glass roughness", "Roughness", ROUGH, **GLASS),
        principled("transmission roughness", "Transmission Roughness", ROUGH, Roughness=0.0, **GLASS),
        principled("glass ior", "IOR", (0.8, 1.0, 1.2, 1.8, 2.5), **GLASS),
        principled("film", "Thin Film Thickness", (0.0, 200.0, 400.0, 600.0, 900.0)),
        principled("film metal", "Thin Film IOR", (1.0, 1.2, 1.4, 1.8, 2.5), Metallic=1.0, **FILM),
        principled("film glass", "Thin Film Thickness", (0.0, 200.0, 400.0, 600.0, 900.0), **GLASS),
    ],
    "subsurface": [
        *(subsurface(m) for m in ("BURLEY", "RANDOM_WALK", "RANDOM_WALK_FIXED_RADIUS", "RANDOM_WALK_SKIN")),
        subsurface("RANDOM_WALK", Anisotropy=0.7),
        principled("subsurface", "Subsurface Weight|Subsurface", **SKIN, **{"Subsurface Scale": 0.2}),
        principled("subsurface scale", "Subsurface Scale", (0.02, 0.05, 0.1, 0.3, 1.0), **SKIN,
                   **{"Subsurface Weight|Subsurface": 1.0}),
    ],
    "hair": [
        *(Row(f"Hair {c} {u}", "BsdfHair", ("RoughnessV", (0.1, 0.2, 0.4, 0.7, 1.0)),
              {"Color": GOLD, "Offset": 0.05, "RoughnessU": u}, {"component": c})
          for c in ("Reflection", "Transmission") for u in (0.2, 0.6)),
        Row("Principled Hair colour", "BsdfHairPrincipled", ("Roughness", (0.1, 0.2, 0.4, 0.7, 1.0)), BASE,
            {"parametrization": "COLOR"}),
        Row("Principled Hair melanin", "BsdfHairPrincipled", ("Melanin", SHARE), {}, {"parametrization": "MELANIN"}),
    ],
    "volume": [
        Row("Absorption", "VolumeAbsorption", ("Density", (0.3, 1.0, 3.0, 6.0, 12.0)), BASE, {}, "Volume"),
        *(Row(f"Scatter g {g}", "VolumeScatter", ("Density", (0.3, 1.0, 3.0, 6.0, 12.0)),
              {"Color": (0.8, 0.7, 0.6, 1.0), "Anisotropy": g}, {}, "Volume") for g in (-0.5, 0.0, 0.7)),
        Row("Principled Volume", "VolumePrincipled", ("Density", (0.3, 1.0, 3.0, 6.0, 12.0)),
            {"Color": (0.7, 0.5, 0.3, 1.0)}, {}, "Volume"),
        Row("Principled Volume emission", "VolumePrincipled", ("Emission Strength", (0.0, 0.2, 0.5, 1.0, 2.0)),
            {"Density": 2.0, "Emission Color": (0.9, 0.5, 0.2, 1.0)}, {}, "Volume"),
    ],
}
