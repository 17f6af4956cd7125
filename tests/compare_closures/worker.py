# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders sheets in one Blender: the worker of tests/render with the sheets of this folder as its cases."""

from __future__ import annotations

import hashlib
import importlib.util
import json
import os
import sys
import types
from pathlib import Path

import bpy  # first: in a wheel its libraries must load before the engine's

HERE = Path(__file__).resolve().parent
RENDER = HERE.parent / "render"
sys.path[:0] = [str(HERE), str(RENDER), str(HERE.parents[1] / "scenes")]
sys.modules["cases"] = types.ModuleType("cases")

import kit  # noqa: E402
import stage  # noqa: E402

SAMPLES = 32


def register() -> None:
    for name in stage.SHEETS:

        def build(scene, name=name) -> None:
            stage.build(name, scene)

        kit.CASES[name] = kit.Case(name, build, SAMPLES, True, (3, 4))


def listing() -> dict:
    """The sheets that have balls here, their labels, and a fingerprint of all that their pictures depend on."""
    files = [HERE / "sheets.py", HERE / "stage.py", RENDER / "kit.py", HERE.parents[1] / "scenes" / "common.py"]
    digest = hashlib.sha256(b"".join(f.read_bytes() for f in files) + str(SAMPLES).encode()).hexdigest()[:16]
    found = {}
    for name in stage.SHEETS:
        labels = stage.build(name, kit.start(SAMPLES))
        if labels:
            found[f"closures_{name}"] = {"about": name, "hash": digest, "labels": labels}
    return {"version": bpy.app.version_string, "cases": found, "cell": stage.CELL, "ball": stage.BALL}


def main() -> None:
    spec = importlib.util.spec_from_file_location("render_worker", RENDER / "worker.py")
    worker = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(worker)
    if "CARDIOID_ADDON" in os.environ:
        sys.path.insert(0, os.environ["CARDIOID_ADDON"])
    register()
    kit.CASES.update({f"closures_{name}": case for name, case in list(kit.CASES.items())})
    worker.main()


if __name__ == "__main__":
    if sys.argv[-1] == "--list":
        print("CASES " + json.dumps(listing()), flush=True)
        os._exit(0)
    main()
