# SPDX-License-Identifier: GPL-3.0-or-later
"""The demo picture of each scene: rendered by Blender with the checkout's add-on, kept as a result of the bench."""

from __future__ import annotations

import os
import shlex
import shutil
import tempfile
from pathlib import Path

from bench import measure
from bench.result import Picture, Result, commit, folder, save

from .collect import DEMO, read
from .gallery import scene_names

ROOT = Path(__file__).resolve().parents[1]
SAMPLES = 256
MORE = {
    "bust_in_water": ["--cardioid-indirect-caustics", "photons"],
    "light_bulb": ["--cardioid-photon-radius", "3"],
    "window_room": ["--cardioid-photon-radius", "6"],
    "bathroom_mirror": ["--cardioid-photon-radius", "2"],
}
"""What a scene needs beside the defaults: in the water most light is caustics of scattered light; in the rooms photons,
which the filter leaves as they are, bring nearly all light to the walls, so they are gathered from further around."""
ADDON = ROOT / "addon" / "cardioid"


def command(scene: str, samples: int, percent: int) -> list[str]:
    """What a reader types in the checkout, the add-on being installed; the picture is out/<scene>_0001.png."""
    smaller = f"import bpy; bpy.context.scene.render.resolution_percentage = {percent}"
    words = ["blender", "-b", f"scenes/{scene}.blend", "--addons", "cardioid", "-E", "CARDIOID"]
    words += [] if percent == 100 else ["--python-expr", smaller]
    words += ["-o", f"//../out/{scene}_", "-F", "PNG", "-x", "1", "-f", "1"]
    return [*words, "--", "--cardioid-samples", str(samples), "--cardioid-filter", "on", *MORE.get(scene, [])]


def render(scene: str, words: list[str], target: Path) -> float:
    """Runs the command with its output at `target`; CPU seconds. RuntimeError with the end of what Blender said."""
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        addons = Path(scratch) / "scripts" / "addons"
        addons.mkdir(parents=True)
        (addons / "cardioid").symlink_to(ADDON)
        stem = f"{scratch}/{scene}_"
        env = {"BLENDER_USER_SCRIPTS": str(addons.parent)}
        run = measure.run(
            [stem if word.startswith("//") else word for word in words], env=env, cwd=ROOT, timeout=6 * 3600
        )
        written = Path(f"{stem}0001.png")
        if not written.exists():
            said = "\n".join(text for _, text in run.lines[-12:])
            raise OSError(f"no picture of {scene}; Blender said:\n{said}")
        part = target.with_name(f".{target.name}.part")
        shutil.copyfile(written, part)
        os.replace(part, target)
    return run.cpu


def chosen(names: list[str] | None) -> list[str]:
    """The scenes to render, by name. ValueError for one that is not there."""
    there = scene_names()
    unknown = [name for name in names or [] if name not in there]
    if unknown:
        raise ValueError(f"no such scene: {', '.join(unknown)}; there are {', '.join(there)}")
    return names or there


def known(cache: Path) -> Result:
    """The result so far, or an empty one."""
    try:
        return read(folder(cache, DEMO))
    except ValueError:
        return Result(DEMO, "Demo pictures of the scenes", "./scripts/report --demo", reduced=False)


def render_all(cache: Path, names: list[str] | None, samples: int, percent: int) -> None:
    """Renders what is not there yet, or older than its scene, or made by another command; saved picture by picture."""
    if shutil.which("blender") is None:
        raise OSError("--demo needs blender on the PATH (./scripts/setup demo)")
    if not list(ADDON.glob("_core*.so")):
        raise OSError("--demo needs the engine's module: run ./scripts/demo once")
    for scene in chosen(names):
        words = command(scene, samples, percent)
        target = folder(cache, DEMO) / f"{scene}.png"
        found = known(cache)
        same = any(p.scene == scene and p.settings == shlex.join(words) for p in found.pictures)
        if same and target.exists() and target.stat().st_mtime > (ROOT / "scenes" / f"{scene}.blend").stat().st_mtime:
            continue
        print(f"{scene}: ", end="", flush=True)
        cpu = render(scene, words, target)
        print(f"{cpu:.0f} CPU seconds", flush=True)
        others = [p for p in found.pictures if p.scene != scene and p.scene in chosen(None)]
        found.pictures = [*others, Picture(scene, "Cardioid", target.name, shlex.join(words), cpu)]
        found.pictures.sort(key=lambda p: p.scene)
        found.reduced = any("resolution_percentage" in p.settings for p in found.pictures)
        found.settings[scene] = f"rendered at commit {commit()}"
        found.machine, found.commit, found.made = {}, "", ""
        save(found, cache)
