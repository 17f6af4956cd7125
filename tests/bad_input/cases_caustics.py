# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad scenes (inside Blender) for photons: nothing to catch, lamps and glass that make no sense, limits of settings."""

import bpy
from caustics_kit import ball, floor_scene, glass, grey, in_modes, lamp, metal, told
from scene_kit import add_square, case


@case
def caustics_without_specular_object():
    floor_scene()
    ball("Stone", grey("Stone"))
    lamp("Lamp")
    return in_modes("caustics_without_specular_object", "PTPPM", "PT")


@case
def caustics_without_light():
    floor_scene()
    ball("Glass", glass("Glass"))
    return told("caustics_without_light")


@case
def caustics_of_a_lamp_inside_stone():
    floor_scene()
    ball("Stone", grey("Stone"), location=(0.5, 0, 0.5))
    ball("Glass", glass("Glass"), location=(-0.5, 0, 0.5))
    lamp("Lamp", z=0.5).location.x = 0.5
    return told("caustics_of_a_lamp_inside_stone")


@case
def caustics_of_ten_thousand_lamps():
    """As bright together as the one lamp of the case after."""
    scene = floor_scene()
    ball("Glass", glass("Glass"))
    first = lamp("Lamp", energy=0.01)
    for number in range(1, 10_000):
        obj = bpy.data.objects.new("Lamp", first.data)
        obj.location = (1e-5 * (number % 100 - 50), 1e-5 * (number // 100 - 50), first.location.z)
        scene.collection.objects.link(obj)
    return told("caustics_of_ten_thousand_lamps")


@case
def caustics_of_one_lamp():
    floor_scene()
    ball("Glass", glass("Glass"))
    lamp("Lamp")
    return told("caustics_of_one_lamp")


@case
def caustics_of_dark_lamps():
    floor_scene()
    ball("Glass", glass("Glass"))
    lamp("Off", energy=0)
    lamp("Black").data.color = (0, 0, 0)
    lamp("Dark sun", kind="SUN", energy=0)
    lamp("Dark area", kind="AREA", energy=0)
    return told("caustics_of_dark_lamps")


@case
def caustics_of_a_negative_lamp():
    floor_scene()
    ball("Glass", glass("Glass"))
    lamp("Darkness", energy=-100)
    return told("caustics_of_a_negative_lamp")


def through_glass(name: str, ior: float) -> dict:
    """A glass ball of this IOR before the lamp, and the same floor without it."""
    floor_scene(64)
    lamp("Lamp")
    bare = told(f"{name}_bare")
    obj = ball("Glass", glass("Glass", ior=ior))
    with_glass = told(name)
    bpy.data.objects.remove(obj)
    return {**with_glass, "bare": bare.get("mean")}


@case
def glass_that_bends_nothing():
    return through_glass("glass_that_bends_nothing", 1.0)


@case
def glass_thinner_than_air():
    return through_glass("glass_thinner_than_air", 0.5)


@case
def glass_without_thickness():
    """One sheet: light enters and never leaves."""
    floor_scene(64)
    lamp("Lamp")
    bare = told("glass_without_thickness_bare")
    add_square("Sheet", z=0.5, size=3).data.materials.append(glass("Glass"))
    return {**told("glass_without_thickness"), "bare": bare.get("mean")}


@case
def glass_inside_glass():
    """Balls that overlap, one inside another, and two in the same place."""
    floor_scene(32)
    lamp("Lamp")
    ball("Outer", glass("Glass", ior=1.5))
    ball("Inner", glass("Water", ior=1.33), radius=0.2)
    ball("Beside", glass("Dense", ior=1.8), location=(0.3, 0, 0.5))
    ball("Twin", glass("Twin", ior=1.5))
    return told("glass_inside_glass")


@case
def camera_inside_glass():
    scene = floor_scene(32)
    lamp("Lamp", z=1.2)
    camera = scene.camera
    camera.data.type, camera.data.clip_start = "PERSP", 0.001
    camera.location.z = 0.5
    ball("Glass", glass("Glass"))
    return told("camera_inside_glass")


def rough_plate(name: str, roughness: float) -> dict:
    """A metal plate beside the floor that throws the light of an area lamp onto it."""
    scene = floor_scene(1024)
    scene.cardioid.caustic_roughness = 0.1
    lamp("Lamp", kind="AREA", energy=50).data.size = 0.5
    plate = add_square("Plate", size=0.5)
    plate.location, plate.rotation_euler = (-0.7, 0, 0.5), (0, 1.2, 0)
    plate.data.materials.append(metal("Metal", roughness))
    return told(name)


@case
def roughness_zero():
    return rough_plate("roughness_zero", 0.0)


@case
def roughness_at_the_threshold():
    return rough_plate("roughness_at_the_threshold", 0.1)


@case
def roughness_over_the_threshold():
    return rough_plate("roughness_over_the_threshold", 0.1001)


def photons_of(name: str, count: int) -> dict:
    scene = floor_scene()
    ball("Glass", glass("Glass"))
    lamp("Lamp")
    scene.cardioid.photons = count
    return told(name)


@case
def photons_by_themselves():
    return photons_of("photons_by_themselves", 0)


@case
def one_photon():
    return photons_of("one_photon", 1)


def ball_on_a_plain(name: str, size: float) -> dict:
    """A ball of this diameter on a floor of 10 km; pictures of all sizes are the same."""
    scene = floor_scene(256)
    scene.objects["Floor"].scale = (2500, 2500, 1)
    lamp("Lamp", z=2000 * size, energy=1e8 * size**2)
    scene.camera.data.ortho_scale, scene.camera.location.z = 4 * size, 5000 * size
    scene.camera.data.clip_end = 1e6
    ball("Ball", glass("Glass"), radius=0.5 * size, location=(0, 0, 0.8 * size))
    return told(name)


@case
def grain_of_glass_on_a_plain():
    return ball_on_a_plain("grain_of_glass_on_a_plain", 0.001)


@case
def ball_of_glass_on_a_plain():
    return ball_on_a_plain("ball_of_glass_on_a_plain", 1.0)
