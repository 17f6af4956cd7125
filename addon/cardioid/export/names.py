# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers shared with the engine: visibility bits, and Cycles' random number for an object's name."""

from __future__ import annotations

from typing import Any

CAMERA, DIFFUSE, GLOSSY, TRANSMISSION, VOLUME, SHADOW, ALL = 1, 2, 4, 8, 16, 32, 63

_OBJECT_BITS = (("visible_camera", CAMERA), ("visible_diffuse", DIFFUSE), ("visible_glossy", GLOSSY),
                ("visible_transmission", TRANSMISSION), ("visible_volume_scatter", VOLUME), ("visible_shadow", SHADOW))
_WORLD_BITS = (("camera", CAMERA), ("diffuse", DIFFUSE), ("glossy", GLOSSY), ("transmission", TRANSMISSION),
               ("scatter", VOLUME))

_M = 0xFFFFFFFF


def object_visibility(obj: Any) -> int:
    return sum(bit for name, bit in _OBJECT_BITS if getattr(obj, name))


def world_visibility(world: Any) -> int:
    flags = getattr(world, "cycles_visibility", None)
    return ALL if flags is None else SHADOW | sum(bit for name, bit in _WORLD_BITS if getattr(flags, name))


def _rotate(x: Any, k: int) -> Any:
    return ((x << k) | (x >> (32 - k))) & _M


def hash_name(name: str) -> int:
    """The 32-bit number that Cycles gives an object without an instancer."""
    key = 0
    for byte in name.encode():
        key = (key * 37 + (byte if byte < 128 else byte - 256)) & _M
    return hash_number(key)


def hash_number(key: Any) -> Any:
    """Jenkins' final mix of (key, 0) as in Cycles' hash_uint2; an int, or an array of uint64."""
    seed = (0xDEADBEEF + (2 << 2) + 13) & _M
    a, b, c = (seed + key) & _M, seed, seed
    c = ((c ^ b) - _rotate(b, 14)) & _M
    a = ((a ^ c) - _rotate(c, 11)) & _M
    b = ((b ^ a) - _rotate(a, 25)) & _M
    c = ((c ^ b) - _rotate(b, 16)) & _M
    a = ((a ^ c) - _rotate(c, 4)) & _M
    b = ((b ^ a) - _rotate(a, 14)) & _M
    return ((c ^ b) - _rotate(b, 24)) & _M


def unit_hash(key: Any) -> Any:
    """`hash_number` as a number in [0, 1], as Particle Info and Hair Info give Random."""
    return hash_number(key) / float(_M)


def unit_random(number: int) -> float:
    """A signed or unsigned 32-bit id as a number in [0, 1)."""
    return min((number & _M) / _M, 0.99999994)


def affine(matrix: Any) -> tuple[float, ...]:
    """The first three rows of a 4×4 matrix, row-major."""
    return (*matrix[0], *matrix[1], *matrix[2])
