# SPDX-License-Identifier: GPL-3.0-or-later
"""World, camera and film."""

import bpy
import common
import kit
from kit import case


@case(wheels=True)
def hdri(scene):
    """An environment picture with a sun in it, turned by a Mapping node: importance sampling of the world."""
    kit.lamp_stage()
    g = common.Graph(bpy.context.scene.world, "ShaderNodeOutputWorld")
    at = g.node("Mapping", {"Vector": g.node("TexCoord").outputs["Generated"], "Rotation": (0, 0, 0.7)})
    sky = g.node("TexEnvironment", {"Vector": at.outputs[0]}, image=kit.sky_image())
    bpy.context.scene.world.cycles.sampling_method = "MANUAL"
    bpy.context.scene.world.cycles.sample_map_resolution = 256
    g.surface(g.node("Background", {"Color": sky.outputs["Color"], "Strength": 0.8}))


@case(wheels=True)
def world_constant(scene):
    """A sky of one colour and nothing else."""
    kit.lamp_stage()
    kit.world((0.4, 0.55, 0.8), 1.2)


@case()
def world_gradient(scene):
    """A sky from nodes without a picture."""
    kit.lamp_stage()
    g = common.Graph(bpy.context.scene.world, "ShaderNodeOutputWorld")
    height = g.node("SeparateXYZ", {"Vector": g.node("TexCoord").outputs["Generated"]}).outputs["Z"]
    color = g.ramp(height, [(0.0, (0.9, 0.5, 0.2)), (0.4, (0.2, 0.4, 0.9)), (1.0, (0.05, 0.1, 0.4))])
    g.surface(g.node("Background", {"Color": color, "Strength": 1.0}))


@case(samples=48, wheels=True)
def depth_of_field(scene):
    """A wide aperture with six turned blades, squeezed, focused on the nearest of three balls."""
    kit.world((0.5, 0.55, 0.6), 1.0)
    kit.floor()
    for i, color in enumerate(((0.8, 0.2, 0.1), (0.2, 0.7, 0.2), (0.1, 0.3, 0.8))):
        common.sphere(
            f"ball {i}", (-0.8 + 0.8 * i, -1.0 + 1.3 * i, 0.4), 0.4, kit.diffuse(color, name=f"ball {i}"), 48, 24
        )
    dof = kit.camera().data.dof
    dof.use_dof, dof.focus_distance, dof.aperture_fstop = True, 3.9, 0.25
    dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio = 6, 0.4, 1.5


@case()
def orthographic(scene):
    """An orthographic camera with shift."""
    kit.lamp_stage()
    kit.world((0.5, 0.5, 0.5), 1.0)
    data = scene.camera.data
    data.type, data.ortho_scale, data.shift_x, data.shift_y = "ORTHO", 3.2, 0.1, -0.05


@case()
def camera_shift(scene):
    """Lens shift, vertical sensor fit and pixels that are not square."""
    kit.lamp_stage()
    kit.world((0.5, 0.5, 0.5), 1.0)
    data = scene.camera.data
    data.shift_x, data.shift_y, data.sensor_fit, data.sensor_height = -0.12, 0.08, "VERTICAL", 20.0
    scene.render.pixel_aspect_x = 1.4


@case()
def camera_clip(scene):
    """Clip distances that cut into the scene."""
    kit.lamp_stage()
    kit.world((0.5, 0.5, 0.5), 1.0)
    scene.camera.data.clip_start, scene.camera.data.clip_end = 4.95, 6.5


@case(samples=96, wheels=True)
def transparent_film(scene):
    """Transparent film: the sky lights but is not seen, alpha is compared too."""
    kit.lamp_stage()
    bpy.data.objects.remove(bpy.data.objects["floor"])
    kit.world((0.5, 0.6, 0.8), 1.0)
    scene.render.film_transparent = True


@case()
def film_exposure_box_filter(scene):
    """Film exposure 1.7 and the box filter."""
    kit.lamp_stage()
    kit.world((0.3, 0.3, 0.3), 1.0)
    scene.cycles.film_exposure, scene.cycles.pixel_filter_type = 1.7, "BOX"


@case()
def bounces_limited(scene):
    """Two bounces in all, one diffuse: the limits cut the same paths."""
    kit.lamp_stage()
    kit.lamp("AREA", (1.2, -1.6, 2.4), size=1.0, energy=110.0)
    scene.cycles.max_bounces, scene.cycles.diffuse_bounces = 2, 1
