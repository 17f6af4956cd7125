# SPDX-License-Identifier: GPL-3.0-or-later
"""References as they are kept: NAME.exr in half floats and NAME.json, which tells how it was made and of what scene.

Channels of NAME.exr: R, G, B (linear radiance), `error` (the reference's own standard error, root mean square over the
channels), `emit` (1: the pixel sees the lamp, directly or by mirrors and glass alone, or borders on such a one),
`caustic` (1: light through mirrors or glass is more than a tenth of the pixel's luminance, seen directly or so).
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import exr
from ..references import Refused
from ..result import write_atomically
from .scenes import ALL

FOLDER = Path(__file__).resolve().parent / "references"


@dataclass
class Stored:
    """`pixels` (h, w, 3), `error` (h, w), masks (h, w) bool; `record`: the JSON file's content."""

    pixels: np.ndarray
    error: np.ndarray
    emit: np.ndarray
    caustic: np.ndarray
    record: dict


def write(folder: Path, name: str, made: Stored) -> None:
    """Overwrites both files; the scene's digest is added to the record."""
    import OpenEXR

    folder.mkdir(parents=True, exist_ok=True)
    planes = {color: made.pixels[..., index] for index, color in enumerate("RGB")}
    planes |= {"error": made.error, "emit": made.emit, "caustic": made.caustic}
    planes = {key: np.ascontiguousarray(plane, np.float16) for key, plane in planes.items()}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, planes) as file:
        file.write(str(folder / f"{name}.exr"))
    record = {"scene": name, "digest": ALL[name]().digest()} | made.record
    write_atomically(folder / f"{name}.json", json.dumps(record, indent=1) + "\n")


def read(folder: Path, name: str) -> Stored:
    """A scene's reference. Refused, one sentence: it is not there, or belongs to another scene."""
    picture, told = folder / f"{name}.exr", folder / f"{name}.json"
    missing = [str(path) for path in (picture, told) if not path.exists()]
    if missing:
        raise Refused(f"no reference of the scene {name}: {', '.join(missing)} is not there")
    record = json.loads(told.read_text())
    if record.get("digest") != ALL[name]().digest():
        raise Refused(
            f"{told} belongs to another scene {name} (digest {record.get('digest')}, the scene's is "
            f"{ALL[name]().digest()}); make it anew with bench/rivals/make_references.py"
        )
    planes = exr.channels(picture)
    pixels = np.stack([planes[color] for color in "RGB"], -1)
    return Stored(pixels, planes["error"], planes["emit"] > 0.5, planes["caustic"] > 0.5, record)


def merged(one: Stored, other: Stored) -> Stored:
    """The mean of two independent references, each weighed by the inverse of its mean squared error; the masks of the
    better one. The weights are the same for all pixels, so that no bias comes in."""
    weights = np.array([1 / found.record["rmse"] ** 2 for found in (one, other)])
    first, second = weights / weights.sum()
    pixels = first * one.pixels + second * other.pixels
    error = np.sqrt((first * one.error.astype(np.float64)) ** 2 + (second * other.error.astype(np.float64)) ** 2)
    better = one if first >= second else other
    record = one.record | {
        key: one.record[key] + other.record[key] for key in ("cpu_seconds", "light_paths", "camera_samples")
    }
    record["seeds"] = [*one.record.get("seeds", []), *other.record.get("seeds", [])]
    return Stored(pixels, error, better.emit, better.caustic, record | measured(pixels, error, better))


def measured(pixels: np.ndarray, error: np.ndarray, masks: Stored) -> dict[str, float]:
    """The figures of a record that its planes give: mean radiance and own RMSE, lamp left out."""
    seen = ~masks.emit
    rmse = {key: float(np.sqrt((error[mask] ** 2).mean())) for key, mask in (("", seen), ("_caustic", masks.caustic))}
    found = {"mean": float(pixels[seen].mean())} | {f"rmse{key}": value for key, value in rmse.items()}
    return {key: round(value, 6) for key, value in found.items()}
