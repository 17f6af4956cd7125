# SPDX-License-Identifier: GPL-3.0-or-later
"""The three scenes of the thesis's chapter 5 with references and masks that another renderer made (bench/rivals)."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import metrics
from .references import Refused
from .rivals import scenes, stored

ROOT = Path(__file__).resolve().parents[1]
BUILT = ROOT / "build" / "bench" / "rivals"
"""The scenes' .blend files, built on first use; their names hold the scene's digest."""
NAMES = tuple(scenes.ALL)
COLUMNS = {"relmse": ".5f", "relmse_caustic": ".5f", "rmse": ".4f", "rmse_caustic": ".4f"}
COLUMNS |= {"energy": ".4f", "energy_caustic": ".4f"}


@dataclass
class PeerScene:
    """`masks`: pixels that are compared, and those of them with caustics; `error`: the reference's own RMSE there."""

    name: str
    blend: Path
    reference: np.ndarray
    masks: dict[str, np.ndarray]
    error: dict[str, float]

    def evaluate(self, image: np.ndarray) -> dict[str, float]:
        """Figures of a picture; those of the caustics end in `_caustic`. `reference` is the reference's own squared
        error over the picture's."""
        out: dict[str, float] = {}
        for name, mask in self.masks.items():
            found = metrics.evaluate(image, self.reference, mask)
            found["reference"] = (self.error[name] / max(found["rmse"], 1e-12)) ** 2
            out |= {key + ("" if name == "all" else f"_{name}"): value for key, value in found.items()}
        out["flip"] = metrics.flip(np.where(self.masks["all"][..., None], image, 0.0), self.shown())
        return out

    def has_glass(self) -> bool:
        return any(material.kind == scenes.GLASS for material in scenes.ALL[self.name]().materials.values())

    def shown(self) -> np.ndarray:
        return np.where(self.masks["all"][..., None], self.reference, 0.0)


def add_argument(parser) -> None:
    parser.add_argument(
        "--peers",
        type=Path,
        default=stored.FOLDER,
        metavar="DIR",
        help="references of the thesis's scenes (%(default)s)",
    )


def load_all(folder: Path, names: list[str]) -> list[PeerScene]:
    """The scenes by name, all without names. Ends the program with one sentence when the folder lacks something."""
    for name in names:
        if name not in NAMES:
            sys.exit(f"no scene {name}; here there are {', '.join(NAMES)}")
    return [load(folder, name) for name in names or NAMES]


def load_some(folder: Path, names: list[str]) -> list[PeerScene]:
    """Those of the names that are scenes of the folder; all without names."""
    return [load(folder, name) for name in NAMES if name in names or not names]


def load(folder: Path, name: str) -> PeerScene:
    try:
        found = stored.read(folder, name)
    except Refused as error:
        sys.exit(f"{error} (another folder: --peers)")
    masks = {"all": ~found.emit, "caustic": found.caustic & ~found.emit}
    error = {key: float(np.sqrt((found.error[mask].astype(np.float64) ** 2).mean())) for key, mask in masks.items()}
    return PeerScene(name, blend_of(name), found.pixels, masks, error)


def blend_of(name: str) -> Path:
    """The scene as a .blend file for Cycles and our add-on. Ends the program with one sentence without Blender."""
    path = BUILT / f"{name}-{scenes.ALL[name]().digest()}.blend"
    if path.exists():
        return path
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f"{os.getpid()}-{path.name}")
    script = ROOT / "bench" / "rivals" / "to_blend.py"
    command = ["blender", "-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "-P", str(script)]
    try:
        done = subprocess.run([*command, "--", name, str(unfinished)], capture_output=True, text=True, check=False)
    except FileNotFoundError:
        sys.exit(f"Blender is needed to build the scene {name}, and is not on PATH (scripts/setup demo installs it)")
    if done.returncode or not unfinished.exists():
        said = (done.stdout + done.stderr).strip().splitlines()[-3:]
        sys.exit(f"Blender could not build the scene {name}: {' | '.join(said)}")
    unfinished.replace(path)
    return path


def noise(pictures: list[np.ndarray], mask: np.ndarray) -> float | None:
    """RMSE of one picture by the scatter of several seeds alone: it knows no reference, and sees no bias."""
    if len(pictures) < 2:
        return None
    return float(np.sqrt(np.var(pictures, 0, ddof=1)[mask].mean()))


def medians(runs: list[dict]) -> dict[str, float]:
    """Medians, figure by figure, of several seeds."""
    names = [key for key, value in runs[0].items() if isinstance(value, (int, float)) and value is not None]
    return {key: float(np.median([run[key] for run in runs])) for key in names}
