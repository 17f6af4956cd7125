# SPDX-License-Identifier: GPL-3.0-or-later
"""References that are kept with the repository: the mean of a long run and half the difference of its two independent
halves in a half-float EXR file, and beside it a JSON file that says of which scene, by whom and how good.

    kept = references.load("glossy_spheres", references.digest(blend))   # refused: references.Refused
    kept.mean, kept.parts          # (h, w, 3), (2, h, w, 3): the two halves, for figures net of the reference's noise
    kept.error                     # its own expected {"relmse": …, "mse": …}
    references.save("glossy_spheres", pictures, blend, engine="…", samples=4096)
    ok, words = references.good_enough(kept.error["relmse"], smallest_measured_relmse)
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from . import metrics
from .result import write_atomically

FOLDER = Path(__file__).resolve().parent / "references"
LARGEST_HALF = 65504.0
NOISE_BITS = 4
"""Of the mantissa of the halves' difference: its size is what counts, and long mantissas do not compress."""
SHARE = 0.1
"""A reference is good enough when its own error is under this share of what is measured with it."""
FORMAT = 1


class Refused(ValueError):
    """The reference does not belong to what was asked for; the message is one sentence for the user."""


@dataclass
class About:
    """The JSON file. `samples`: a pixel, in all; `seconds`: CPU seconds in all; `error`: of the mean itself."""

    scene: str
    digest: str
    engine: str
    samples: int
    size: tuple[int, int]
    error: dict[str, float]
    settings: str = ""
    seconds: float = 0.0
    program: str = ""
    format: int = FORMAT


@dataclass
class Kept:
    """Linear pixels, top row first, float32."""

    about: About
    parts: np.ndarray
    """(2, h, w, 3): two independent halves."""
    mean: np.ndarray = field(init=False)

    def __post_init__(self):
        self.mean = self.parts.mean(0)

    @property
    def error(self) -> dict[str, float]:
        """Expected relmse and mse of the mean itself."""
        return self.about.error


def digest(*files: Path) -> str:
    """Of the scene's files: 16 hexadecimal digits."""
    found = hashlib.sha256()
    for file in files:
        found.update(file.read_bytes())
    return found.hexdigest()[:16]


def halves(pictures: np.ndarray) -> np.ndarray:
    """(2, h, w, 3) of an even number of independent pictures (n, h, w, 3) of equal samples."""
    if len(pictures) < 2 or len(pictures) % 2:
        raise ValueError(f"a reference needs an even number of independent pictures, not {len(pictures)}")
    whole = np.asarray(pictures, np.float64)
    return np.stack([whole[0::2].mean(0), whole[1::2].mean(0)])


def rounded(noise: np.ndarray) -> np.ndarray:
    """With a short mantissa, so that it compresses."""
    mantissa, exponent = np.frexp(noise)
    return np.ldexp(np.round(mantissa * 2**NOISE_BITS) / 2**NOISE_BITS, exponent)


def save(
    name: str,
    pictures: np.ndarray,
    scene: Path,
    engine: str,
    samples: int,
    *,
    settings: str = "",
    seconds: float = 0.0,
    program: str = "",
    folder: Path = FOLDER,
) -> Kept:
    """Writes NAME.exr and NAME.json from independent pictures (n, h, w, 3), n even; returns what `load` will."""
    import OpenEXR

    parts = halves(pictures)
    error = metrics.reference_error(np.asarray(pictures, np.float64))
    mean = np.minimum(parts.mean(0), LARGEST_HALF).astype(np.float16)
    noise = rounded(np.clip((parts[0] - parts[1]) / 2, -LARGEST_HALF, LARGEST_HALF)).astype(np.float16)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    channels = {c: np.ascontiguousarray(mean[..., i]) for i, c in enumerate("RGB")}
    channels |= {f"noise.{c}": np.ascontiguousarray(noise[..., i]) for i, c in enumerate("RGB")}
    folder.mkdir(parents=True, exist_ok=True)
    with OpenEXR.File(header, channels) as file:
        file.write(str(folder / f"{name}.exr"))
    height, width = mean.shape[:2]
    about = About(
        name, digest(scene), engine, int(samples), (width, height), error, settings, round(seconds, 1), program
    )
    write_atomically(folder / f"{name}.json", json.dumps(asdict(about), indent=1) + "\n")
    return load(name, about.digest, folder=folder)


def load(name: str, scene_digest: str, *, width: int = 0, folder: Path = FOLDER) -> Kept:
    """The reference NAME of the scene with this digest, `width` pixels wide (0: as it is). Refused, with one sentence,
    if there is none, if it is of another scene or size, or cannot be read."""
    import OpenEXR

    path = folder / f"{name}.exr"
    try:
        raw = json.loads(path.with_suffix(".json").read_text())
        about = About(**raw | {"size": tuple(raw["size"])})
        if about.format != FORMAT:
            raise ValueError("another format")
    except FileNotFoundError as error:
        raise Refused(f"there is no reference {path.parent.name}/{path.name}") from error
    except (OSError, KeyError, TypeError, ValueError) as error:
        raise Refused(f"the reference {path} cannot be read: {error}") from error
    if about.digest != scene_digest:
        raise Refused(
            f"the reference {path.parent.name}/{path.name} is of another scene ({about.digest}, not {scene_digest})"
        )
    if width and about.size[0] != width:
        raise Refused(f"the reference {path} is {about.size[0]} pixels wide, not {width}")
    try:
        with OpenEXR.File(str(path), separate_channels=True) as file:
            planes = file.channels()
            mean, noise = (
                np.stack([np.asarray(planes[prefix + c].pixels, np.float32) for c in "RGB"], -1)
                for prefix in ("", "noise.")
            )
    except (OSError, KeyError, RuntimeError) as error:
        raise Refused(f"the reference {path} cannot be read: {error}") from error
    return Kept(about, np.stack([mean + noise, mean - noise]))


def good_enough(own: float, measured: float) -> tuple[bool, str]:
    """Whether a reference's own error is under a tenth of the (smallest) error that is measured with it; in words."""
    share = own / measured if measured > 0 else float("inf")
    return share < SHARE, f"the reference's own relMSE is {share:.1%} of the smallest one measured (wanted: under 10 %)"
