# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders of scenes/ by the command line renderer, for the pictures of the documentation. Kept in build/docs-figures by
what was asked for, so that a drawing can be changed without rendering."""

from __future__ import annotations

import hashlib
import json
import os
import resource
import subprocess
from pathlib import Path

import numpy as np
import OpenEXR
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / "build" / "docs-figures"
IMAGES = ROOT / "docs" / "images"
PROGRAMS = ROOT / "build" / "release" / "engine_cpp" / "apps" / "cli"


def program(name: str) -> str:
    """cardioid-render or cardioid-filter: by CARDIOID_RENDER or CARDIOID_FILTER, else of the release build."""
    path = Path(os.environ.get(name.replace("-", "_").upper(), PROGRAMS / name))
    if not path.is_file():
        raise SystemExit(
            f"{path} is not there: build first (scripts/test unit), or set {name.replace('-', '_').upper()}"
        )
    return str(path)


def scene_file(name: str) -> Path:
    """scenes/<name>.blend as a scene file, exported by Blender with the add-on of this checkout."""
    path = CACHE / f"{name}.cardioid"
    blend = ROOT / "scenes" / f"{name}.blend"
    if path.exists() and path.stat().st_mtime > blend.stat().st_mtime:
        return path
    addons = CACHE / "scripts" / "addons"
    addons.mkdir(parents=True, exist_ok=True)
    if not (addons / "cardioid").exists():
        (addons / "cardioid").symlink_to(ROOT / "addon" / "cardioid")
    command = [
        "blender",
        "-b",
        "-noaudio",
        str(blend),
        "--addons",
        "cardioid",
        "-E",
        "CARDIOID",
        "-o",
        str(CACHE / "x"),
        "-f",
        "1",
        "--",
        "--cardioid-samples",
        "1",
        "--cardioid-export",
        str(path),
    ]
    subprocess.run(
        command,
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "BLENDER_USER_SCRIPTS": str(CACHE / "scripts")},
    )
    return path


def words(settings: dict[str, object]) -> list[str]:
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def render(scene: str, samples: int, film: bool = False, **settings: object) -> Path:
    """The EXR of a render, 2 threads, seed 1; its statistics beside it as .json, its film as .film."""
    arguments = ["--samples", str(samples), "--seed", "1", "--threads", "2", *words(settings)]
    digest = hashlib.sha256(" ".join([scene, str(film), *arguments]).encode()).hexdigest()[:10]
    out = CACHE / f"{scene}_{digest}.exr"
    if not out.exists():
        extra = ["--film", str(out.with_suffix(".film"))] if film else []
        command = [
            program("cardioid-render"),
            str(scene_file(scene)),
            "-q",
            *arguments,
            *extra,
            "-o",
            str(out),
            "--stats",
            str(out.with_suffix(".json")),
        ]
        before = cpu_seconds()
        subprocess.run(command, check=True)
        out.with_suffix(".cpu").write_text(f"{cpu_seconds() - before:.2f}")
    return out


def cpu_seconds() -> float:
    """User and system time of all programs that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def cpu(exr: Path) -> float:
    """CPU seconds of the render behind a picture, start-up included."""
    return float(exr.with_suffix(".cpu").read_text())


def filtered(film: Path, **settings: object) -> Path:
    """The EXR of a film filtered again."""
    digest = hashlib.sha256(" ".join(words(settings)).encode()).hexdigest()[:10]
    out = film.with_name(f"{film.stem}_{digest}.exr")
    if not out.exists():
        command = [program("cardioid-filter"), str(film), "-q", *words(settings), "-o", str(out)]
        subprocess.run(command, check=True)
    return out


def stats(exr: Path) -> dict:
    return json.loads(exr.with_suffix(".json").read_text())


def load(exr: Path, layer: str = "") -> np.ndarray:
    """A pass as linear float32 (h, w, 3), top row first; without a name the picture."""
    with OpenEXR.File(str(exr), separate_channels=True) as file:
        planes = file.channels()
        return np.stack([np.asarray(planes[f"{layer}.{c}" if layer else c].pixels, np.float32) for c in "RGB"], -1)


def show(linear: np.ndarray, exposure: float = 1.0) -> np.ndarray:
    """sRGB bytes of linear pixels; what is brighter than white is white."""
    x = np.clip(linear * exposure, 0, 1)
    x = np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return (255 * x + 0.5).astype(np.uint8)


def enlarge(pixels: np.ndarray, times: int) -> np.ndarray:
    """Whole pixels, so that noise stays what it is."""
    return pixels.repeat(times, 0).repeat(times, 1)


def save(pixels: np.ndarray, name: str) -> Path:
    """docs/images/<name>.jpg, as good as 200 KB allow."""
    path = IMAGES / f"{name}.jpg"
    for quality in (92, 88, 84, 80, 74, 68):
        Image.fromarray(pixels).save(path, quality=quality, subsampling=0, optimize=True)
        if path.stat().st_size <= 200_000:
            break
    return path
