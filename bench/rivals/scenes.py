# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes of the thesis's sections 5.7.1 to 5.7.3 for any renderer, as plain arrays.

Z is up, lengths are metres, colours linear sRGB. A scene has one square lamp of constant radiance that shines from its
front alone, a black square behind it, so that lamps that are no geometry (Cycles') cast the same shadow, and a pinhole
camera with a square picture. There is no other light.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from . import shapes
from .shapes import Body

SIZE = 256
"""Pixels a side."""
BOUNCES = 24
HOUSING, HOUSING_GAP = "housing", 2e-3
"""The square behind the lamp, and its distance in metres."""
GRAIN = 2.0**-20
"""Lengths count up to this in a digest: the last bits of sines differ between processors."""

DIFFUSE, GLASS, MIRROR = "diffuse", "glass", "mirror"


@dataclass(frozen=True)
class Material:
    """Lambert's diffuse, sharp glass without colour, or a sharp mirror of a constant reflectance."""

    kind: str
    color: tuple[float, float, float] = (1.0, 1.0, 1.0)
    ior: float = 1.5


@dataclass(frozen=True)
class Mesh:
    name: str
    material: str
    body: Body

    def normals(self) -> np.ndarray | None:
        """Per vertex, for smooth ones."""
        return shapes.vertex_normals(self.body.vertices, self.body.triangles) if self.body.smooth else None


@dataclass(frozen=True)
class Lamp:
    """`u`, `v`: half edges, metres; the light leaves along u × v; `radiance` in W/(m² sr)."""

    centre: np.ndarray
    u: np.ndarray
    v: np.ndarray
    radiance: tuple[float, float, float]

    @property
    def normal(self) -> np.ndarray:
        across = np.cross(self.u, self.v)
        return across / np.linalg.norm(across)

    @property
    def side(self) -> float:
        return 2 * float(np.linalg.norm(self.u))

    def body(self) -> Body:
        return shapes.quad(self.centre, self.u, self.v)


@dataclass(frozen=True)
class Camera:
    """`fov`: degrees from edge to edge."""

    origin: tuple[float, float, float]
    target: tuple[float, float, float]
    fov: float


@dataclass
class Scene:
    name: str
    lamp: Lamp
    camera: Camera
    materials: dict[str, Material]
    meshes: list[Mesh] = field(default_factory=list)

    def add(self, name: str, material: str, body: Body) -> None:
        self.meshes.append(Mesh(name, material, body))

    def receivers(self) -> list[Mesh]:
        """Meshes that can show a caustic."""
        return [mesh for mesh in self.meshes if self.materials[mesh.material].kind == DIFFUSE and mesh.name != HOUSING]

    def digest(self) -> str:
        """Of all that decides the picture: geometry, materials, lamp, camera, size and bounces."""
        lamp, camera = self.lamp, self.camera
        plain = {
            "materials": {name: [m.kind, m.color, m.ior] for name, m in sorted(self.materials.items())},
            "lamp": [grains(lamp.centre), grains(lamp.u), grains(lamp.v), lamp.radiance],
            "camera": [camera.origin, camera.target, camera.fov],
            "picture": [SIZE, BOUNCES],
        }
        made = hashlib.sha256(json.dumps(plain, sort_keys=True).encode())
        for mesh in self.meshes:
            made.update(f"{mesh.name} {mesh.material} {mesh.body.smooth}".encode())
            made.update(np.array(grains(mesh.body.vertices), "<i4").tobytes())
            made.update(mesh.body.triangles.astype("<i4").tobytes())
        return made.hexdigest()[:16]


def grains(values: np.ndarray) -> list:
    return np.rint(np.asarray(values) / GRAIN).astype(int).tolist()


def begin(name: str, lamp: Lamp, camera: Camera, materials: dict[str, Material]) -> Scene:
    """A scene with its lamp's housing alone."""
    scene = Scene(name, lamp, camera, {"black": Material(DIFFUSE, (0.0, 0.0, 0.0))} | materials)
    scene.add(HOUSING, "black", shapes.quad(lamp.centre - lamp.normal * HOUSING_GAP, lamp.u, lamp.v))
    return scene


def lamp_towards(centre, target, half: float, radiance: tuple[float, float, float], up) -> Lamp:
    """A square lamp of half edge `half` that looks at a point."""
    normal = np.array(target, float) - np.array(centre, float)
    normal /= np.linalg.norm(normal)
    u = np.cross(up, normal)
    u /= np.linalg.norm(u)
    return Lamp(np.array(centre, float), u * half, np.cross(normal, u) * half, radiance)


def cornell() -> Scene:
    """5.7.1: Cornell's box with a glass and a chrome sphere."""
    materials = {
        "white": Material(DIFFUSE, (0.75, 0.75, 0.75)),
        "red": Material(DIFFUSE, (0.63, 0.065, 0.05)),
        "green": Material(DIFFUSE, (0.14, 0.45, 0.091)),
        "glass": Material(GLASS),
        "chrome": Material(MIRROR, (0.9, 0.9, 0.9)),
    }
    lamp = lamp_towards((0, 0, 1.99), (0, 0, 0), 0.15, (40.0, 36.0, 30.0), (0, 1, 0))
    scene = begin("cornell", lamp, Camera((0, -3.9, 1.0), (0, 0, 1.0), 39.0), materials)
    scene.add("floor", "white", shapes.quad((0, 0, 0), (1, 0, 0), (0, 1, 0)))
    scene.add("ceiling", "white", shapes.quad((0, 0, 2), (-1, 0, 0), (0, 1, 0)))
    scene.add("back", "white", shapes.quad((0, 1, 1), (1, 0, 0), (0, 0, 1)))
    scene.add("left", "red", shapes.quad((-1, 0, 1), (0, 1, 0), (0, 0, 1)))
    scene.add("right", "green", shapes.quad((1, 0, 1), (0, -1, 0), (0, 0, 1)))
    scene.add("chrome_sphere", "chrome", shapes.sphere((-0.43, 0.3, 0.402), 0.4))
    scene.add("glass_sphere", "glass", shapes.sphere((0.43, -0.25, 0.402), 0.4))
    return scene


def ring() -> Scene:
    """5.7.2: a metallic ring on a chequered floor in a room."""
    materials = {
        "floor_dark": Material(DIFFUSE, (0.42, 0.26, 0.14)),
        "floor_light": Material(DIFFUSE, (0.6, 0.45, 0.3)),
        "wall": Material(DIFFUSE, (0.55, 0.5, 0.45)),
        "metal": Material(MIRROR, (0.92, 0.78, 0.5)),
    }
    lamp = lamp_towards((1.9, 1.3, 2.3), (0, 0, 0.1), 0.08, (450.0, 420.0, 380.0), (0, 0, 1))
    scene = begin("ring", lamp, Camera((-0.3, -2.1, 2.6), (0, -0.02, 0.05), 39.0), materials)
    even, odd = shapes.chequers(3.0, 12)
    scene.add("floor_even", "floor_dark", even)
    scene.add("floor_odd", "floor_light", odd)
    scene.add("wall_north", "wall", shapes.quad((0, 3, 1.5), (3, 0, 0), (0, 0, 1.5)))
    scene.add("wall_south", "wall", shapes.quad((0, -3, 1.5), (-3, 0, 0), (0, 0, 1.5)))
    scene.add("wall_west", "wall", shapes.quad((-3, 0, 1.5), (0, 3, 0), (0, 0, 1.5)))
    scene.add("wall_east", "wall", shapes.quad((3, 0, 1.5), (0, -3, 0), (0, 0, 1.5)))
    scene.add("ring", "metal", shapes.band(0.82, 0.9, 0.26))
    return scene


def bodies() -> Scene:
    """5.7.3: bodies of glass and chrome on a plane so wide that most of its light never meets the picture."""
    materials = {
        "ground": Material(DIFFUSE, (0.6, 0.58, 0.55)),
        "blue": Material(DIFFUSE, (0.1, 0.16, 0.6)),
        "orange": Material(DIFFUSE, (0.7, 0.3, 0.08)),
        "glass": Material(GLASS),
        "chrome": Material(MIRROR, (0.9, 0.9, 0.9)),
    }
    lamp = lamp_towards((-2.2, 1.2, 4.2), (0, 0, 0), 0.3, (110.0, 106.0, 98.0), (0, 0, 1))
    scene = begin("shapes", lamp, Camera((0.3, -5.2, 2.7), (0.05, 0, 0.35), 38.0), materials)
    scene.add("ground", "ground", shapes.quad((0, 0, 0), (10, 0, 0), (0, 10, 0)))
    scene.add("blue_box", "blue", shapes.box((0.95, 1.1, 0.5), (0.4, 0.4, 0.498), 30))
    scene.add("orange_box", "orange", shapes.box((-1.55, -0.55, 0.2), (0.25, 0.25, 0.198), -20))
    scene.add("glass_sphere", "glass", shapes.sphere((-0.35, -0.75, 0.502), 0.5))
    scene.add("glass_box", "glass", shapes.box((1.45, -0.55, 0.302), (0.3, 0.3, 0.3), 15))
    scene.add("chrome_sphere", "chrome", shapes.sphere((-1.15, 1.0, 0.602), 0.6))
    scene.add("chrome_torus", "chrome", shapes.torus((0.45, -1.6, 0.122), 0.35, 0.12))
    return scene


ALL: dict[str, Callable[[], Scene]] = {"cornell": cornell, "ring": ring, "shapes": bodies}
