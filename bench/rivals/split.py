# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference pictures by the thesis's own split (section 5.3), each kind of path by the method that finds it well, on
the kernels of Mitsuba 3 through Dr.Jit; a variant must have been set before this module is imported.

- camera: path tracing with next-event estimation and MIS, without caustics. No bias.
- direct caustics (lamp, mirrors or glass, a diffuse point that the camera sees): light paths that end with a connection
  to the camera. No bias.
- other caustics (seen in mirrors or glass, or bounced on): light paths leave their power in a grid of texels over every
  diffuse mesh, where camera paths look it up. Biased by a blur of one texel, which is smaller than a pixel.

Light paths start mostly in cells of the lamp's directions in which a first pass met mirrors or glass, and in all others
with a probability of its own, so that none is left out.
"""

from __future__ import annotations

from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

from .. import exr
from . import mitsuba_scene, runner
from .scenes import BOUNCES, SIZE, Scene

CELLS = 96
"""A side of the grid of directions."""
GUIDED = 0.95
TEXEL, LARGEST, ELSEWHERE = 5e-3, 4096, 1024
"""Metres of a texel; texels a side at most, on floors and on other meshes."""
LIGHT_PATHS = 1 << 21
"""A pass's."""
CAMERA_SAMPLES = 16
"""A pass's, independent: passes of Mitsuba's stratified samplers share most of their error, whatever their seeds."""
PIXELS = SIZE * SIZE
LIGHT_SHARE = 0.5
"""Of the CPU seconds."""
ROULETTE = 5


def diffuse(bsdf: mi.BSDFPtr) -> mi.Bool:
    return mi.has_flag(bsdf.flags(), mi.BSDFFlags.DiffuseReflection)


def add(target: mi.Float, value: mi.Color3f, index: mi.UInt32, active: mi.Bool) -> None:
    """Adds a colour to element `index` of an array of colours."""
    for channel in range(3):
        dr.scatter_reduce(dr.ReduceOp.Add, target, value[channel], index * 3 + channel, active)


class Texels:
    """Power of caustics that arrived on diffuse meshes."""

    def __init__(self, plain: Scene, scene: mi.Scene):
        identity = {one.id(): int(dr.reinterpret_array(mi.UInt32, mi.ShapePtr(one))[0]) for one in scene.shapes()}
        starts, sides = np.zeros((2, max(identity.values()) + 1), np.uint32)
        self.count = 0
        for mesh in plain.receivers():
            largest = LARGEST if mesh.name.startswith(("floor", "ground")) else ELSEWHERE
            extent = np.ptp(mesh.body.vertices, axis=0).max()
            side = min(largest, 1 << int(np.ceil(np.log2(extent / TEXEL))))
            starts[identity[mesh.name]], sides[identity[mesh.name]] = self.count, side
            self.count += side * side
        self.starts, self.sides = mi.UInt32(starts), mi.UInt32(sides)

    def at(self, hit: mi.SurfaceInteraction3f, active: mi.Bool) -> tuple[mi.UInt32, mi.Float, mi.Bool]:
        """Index and area of the texel at a point, and whether there is one."""
        shape = dr.reinterpret_array(mi.UInt32, hit.shape)
        side = dr.gather(mi.UInt32, self.sides, shape, active)
        active = active & (side > 0)
        width = mi.Float(side)
        column, row = (mi.UInt32(dr.clip(x * width, 0, width - 1)) for x in (hit.uv.x, hit.uv.y))
        area = dr.norm(dr.cross(hit.dp_du, hit.dp_dv)) / (width * width)
        return dr.gather(mi.UInt32, self.starts, shape, active) + row * side + column, area, active


@dr.syntax
def find_cells(scene: mi.Scene, count: int, seed: int) -> mi.UInt32:
    """Marks the cells of directions in which a light path's first hit is a mirror or glass."""
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    direction = sampler.next_2d()
    ray, _, _ = scene.sample_emitter_ray(0, sampler.next_1d(), sampler.next_2d(), direction, True)
    hit = scene.ray_intersect(ray)
    found = dr.zeros(mi.UInt32, CELLS * CELLS)
    cell = mi.UInt32(direction.x * CELLS) + CELLS * mi.UInt32(direction.y * CELLS)
    dr.scatter(found, 1, cell, hit.is_valid() & ~diffuse(hit.bsdf()))
    return found


def widened(marked: np.ndarray) -> np.ndarray:
    """With the eight neighbours of every marked cell; the grid wraps, as the map from square to disk does."""
    return np.any([np.roll(marked, (dy, dx), (0, 1)) for dy in (-1, 0, 1) for dx in (-1, 0, 1)], axis=0)


class Directions:
    """Where light paths start: `cells` are the marked ones, `marked` tells of each whether it is."""

    def __init__(self, scene: mi.Scene, seed: int):
        found = sum(np.array(find_cells(scene, LIGHT_PATHS, seed + i)).astype(np.int64) for i in range(12))
        marked = widened((found > 0).reshape(CELLS, CELLS)).ravel()
        self.cells, self.marked = mi.UInt32(np.flatnonzero(marked).astype(np.uint32)), mi.Float(np.float32(marked))
        self.number = int(marked.sum())

    def sample(self, sampler: mi.Sampler) -> tuple[mi.Point2f, mi.Float]:
        """A point of the square of directions, and one over its density."""
        guided = sampler.next_1d() < GUIDED
        chosen = mi.UInt32(dr.minimum(sampler.next_1d() * self.number, self.number - 1))
        cell = dr.gather(mi.UInt32, self.cells, chosen)
        inside = mi.Point2f(sampler.next_2d())
        corner = mi.Point2f(mi.Float(cell % CELLS), mi.Float(cell // CELLS))
        point = dr.select(guided, (corner + inside) / CELLS, inside)
        at = mi.Point2u(dr.minimum(point * CELLS, CELLS - 1))
        marked = dr.gather(mi.Float, self.marked, at.x + CELLS * at.y)
        return point, dr.rcp(1 - GUIDED + GUIDED * marked * (CELLS * CELLS / self.number))


@dr.syntax
def light_pass(scene, texels: Texels, directions: Directions, seed: int, picture: mi.Float, power: mi.Float) -> None:
    """Adds LIGHT_PATHS light paths to the camera's picture of caustics and to the texels."""
    sensor, context = scene.sensors()[0], mi.BSDFContext(mi.TransportMode.Importance)
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, LIGHT_PATHS)
    direction, inverse = directions.sample(sampler)
    ray, weight, _ = scene.sample_emitter_ray(0, sampler.next_1d(), sampler.next_2d(), direction, True)
    ray, weight = mi.Ray3f(ray), mi.Color3f(weight) * inverse
    bent, active, depth = mi.Bool(False), mi.Bool(True), mi.UInt32(0)
    while active:
        hit = scene.ray_intersect(ray, active)
        active &= hit.is_valid()
        bsdf = hit.bsdf()
        ends = active & diffuse(bsdf)
        caustic = ends & bent
        index, area, on = texels.at(hit, caustic)
        add(power, weight / area, index, on)
        to_camera, importance = sensor.sample_direction(hit, sampler.next_2d(caustic), caustic)
        seen = caustic & (to_camera.pdf > 0)
        seen &= ~scene.ray_test(hit.spawn_ray_to(to_camera.p), seen)
        value = weight * importance * bsdf.eval(context, hit, hit.to_local(to_camera.d), seen)
        pixel = mi.Point2u(dr.clip(to_camera.uv, 0, SIZE - 1))
        add(picture, value, pixel.x + SIZE * pixel.y, seen)
        active &= ~ends
        sample, factor = bsdf.sample(context, hit, sampler.next_1d(active), sampler.next_2d(active), active)
        after = hit.to_world(sample.wo)
        geometric = dr.abs(dr.dot(hit.n, after) / dr.dot(hit.n, ray.d))
        shading = dr.abs(mi.Frame3f.cos_theta(hit.wi) / mi.Frame3f.cos_theta(sample.wo))
        weight *= factor * geometric * shading  # Veach's correction for interpolated normals (thesis of 1997, p. 155)
        ray = hit.spawn_ray(after)
        bent |= active
        depth += 1
        active &= (depth < BOUNCES) & (dr.max(weight) > 0)


@dr.syntax
def camera_pass(scene, texels: Texels, irradiance: mi.Float, seed: int) -> list[mi.Float]:
    """Sums over CAMERA_SAMPLES samples a pixel: all light, its part from caustics that were looked up where the camera
    sees them through mirrors and glass alone, and the lamp seen so."""
    sensor, context, count = scene.sensors()[0], mi.BSDFContext(), PIXELS * CAMERA_SAMPLES
    sampler = mi.load_dict({"type": "independent"})
    sampler.seed(seed, count)
    pixel = dr.arange(mi.UInt32, count) // CAMERA_SAMPLES
    place = mi.Point2f(mi.Float(pixel % SIZE), mi.Float(pixel // SIZE)) + sampler.next_2d()
    first = sensor.sample_ray(0, 0, place / SIZE, mi.Point2f(0.5))[0]
    ray, before = mi.Ray3f(first), dr.zeros(mi.Interaction3f)
    weight, light, caustic, lamp = mi.Color3f(1), mi.Color3f(0), mi.Color3f(0), mi.Color3f(0)
    scattered, sharp, density = mi.Bool(False), mi.Bool(True), mi.Float(1)
    active, depth = mi.Bool(True), mi.UInt32(0)
    while active:
        hit = scene.ray_intersect(ray, active)
        emitter = hit.emitter(scene)
        shines = active & (emitter != None)  # noqa: E711 (an array of pointers)
        other = scene.pdf_emitter_direction(before, mi.DirectionSample3f(scene, hit, before), shines & ~sharp)
        share = dr.select(sharp, dr.select(scattered, 0.0, 1.0), density / dr.maximum(density + other, 1e-20))
        emitted = dr.select(shines, weight * emitter.eval(hit, shines) * share, 0)
        light += emitted
        lamp += dr.select(scattered, 0, emitted)
        active &= hit.is_valid()
        bsdf = hit.bsdf()
        matte = active & diffuse(bsdf)
        to_lamp, arriving = scene.sample_emitter_direction(hit, sampler.next_2d(matte), True, matte)
        value, other = bsdf.eval_pdf(context, hit, hit.to_local(to_lamp.d), matte)
        share = to_lamp.pdf / dr.maximum(to_lamp.pdf + other, 1e-20)
        light += dr.select(matte & (to_lamp.pdf > 0), weight * value * arriving * share, 0)
        index, _, on = texels.at(hit, matte & (depth > 0))
        looked = mi.Color3f([dr.gather(mi.Float, irradiance, index * 3 + channel, on) for channel in range(3)])
        looked = dr.select(on, weight * bsdf.eval_diffuse_reflectance(hit, on) * looked * dr.inv_pi, 0)
        light += looked
        caustic += dr.select(scattered, 0, looked)
        sample, factor = bsdf.sample(context, hit, sampler.next_1d(active), sampler.next_2d(active), active)
        weight *= factor
        density, sharp = sample.pdf, mi.has_flag(sample.sampled_type, mi.BSDFFlags.Delta)
        before, ray = mi.Interaction3f(hit), hit.spawn_ray(hit.to_world(sample.wo))
        scattered |= matte
        depth += 1
        active &= (depth <= BOUNCES) & (dr.max(weight) > 0)
        survives, late = dr.minimum(dr.max(weight), 0.95), depth > ROULETTE
        active &= ~late | (sampler.next_1d(active) < survives)
        weight = dr.select(late, weight / survives, weight)
    sums = [dr.zeros(mi.Float, PIXELS * 3) for _ in range(3)]
    for target, value in zip(sums, (light, caustic, lamp)):
        add(target, value, pixel, mi.Bool(True))
    return sums


class Batches:
    """Mean of independent pictures and the standard error of that mean."""

    def __init__(self):
        self.count, self.total, self.squares = 0, 0.0, 0.0

    def add(self, flat: mi.Float, factor: float) -> None:
        picture = np.array(flat, np.float64).reshape(SIZE, SIZE, 3) * factor
        self.count, self.total, self.squares = self.count + 1, self.total + picture, self.squares + picture**2

    def mean(self) -> np.ndarray:
        return self.total / self.count

    def variance(self) -> np.ndarray:
        return np.maximum(self.squares / self.count - self.mean() ** 2, 0.0) / (self.count - 1)


class Split:
    """All that the estimators find of a scene in a given time; CPU seconds and seeds are the caller's."""

    def __init__(self, plain: Scene, seed: int):
        self.scene = mitsuba_scene.load(plain)
        self.texels, self.seed = Texels(plain, self.scene), seed * 1_000_000
        self.power = dr.zeros(mi.Float, self.texels.count * 3)
        self.direct, self.camera, self.indirect, self.lamp = Batches(), Batches(), Batches(), Batches()
        self.light_paths = 0

    def next_seed(self) -> int:
        self.seed += 1
        return self.seed

    def run(self, clock: runner.Clock, cpu: float) -> None:
        """At least two batches of each, so that there is an error."""
        directions = Directions(self.scene, self.seed + 500_000)
        while clock.cpu() < LIGHT_SHARE * cpu or self.direct.count < 2:
            self.trace_light(directions)
        irradiance = self.power / self.light_paths
        while clock.cpu() < cpu or self.camera.count < 2:
            self.trace_camera(irradiance)

    def trace_light(self, directions: Directions, passes: int = 4) -> None:
        picture = dr.zeros(mi.Float, PIXELS * 3)
        for _ in range(passes):
            light_pass(self.scene, self.texels, directions, self.next_seed(), picture, self.power)
            dr.eval(picture, self.power)
        self.light_paths += passes * LIGHT_PATHS
        self.direct.add(picture, PIXELS / (passes * LIGHT_PATHS))

    def trace_camera(self, irradiance: mi.Float) -> None:
        found = camera_pass(self.scene, self.texels, irradiance, self.next_seed())
        dr.eval(found)
        for batches, flat in zip((self.camera, self.indirect, self.lamp), found):
            batches.add(flat, 1 / CAMERA_SAMPLES)

    def picture(self) -> np.ndarray:
        return self.camera.mean() + self.direct.mean()

    def caustics(self) -> np.ndarray:
        """Their part of the picture where they are seen directly or through mirrors and glass alone."""
        return self.direct.mean() + self.indirect.mean()

    def error(self) -> np.ndarray:
        """Standard error per pixel (h, w), root mean square over the channels."""
        return np.sqrt((self.camera.variance() + self.direct.variance()).mean(-1))


def render(chosen) -> None:
    """As render_mitsuba.py's other modes."""
    from .scenes import ALL

    clock = runner.Clock()
    made = Split(ALL[chosen.scene](), chosen.seed)
    made.run(clock, chosen.cpu)
    exr.save(Path(chosen.out), made.picture())
    clock.report(made.camera.count * CAMERA_SAMPLES, mi.__version__)
