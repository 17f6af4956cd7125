# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs pytest inside a Blender: `blender -b --python pytest_in_blender.py -- ARGS` or, in a bpy environment,
`python pytest_in_blender.py -- ARGS`. The add-on is importable and the repository's tests/ too.

The process leaves through os._exit: bpy 4.5 hangs at a normal exit while an add-on's classes are registered.
"""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    import bpy  # before anything of ours: Blender's own libraries are loaded first
    import pytest

    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "tests")]
    print(f"Blender {bpy.app.version_string}, Python {sys.version.split()[0]}", flush=True)
    options = ["-p", "no:cacheprovider", "-o", "faulthandler_timeout=90", f"--rootdir={ROOT}"]
    return int(pytest.main([*options, *arguments]))


if __name__ == "__main__":
    try:
        code = main()
    except BaseException as error:  # an import that fails must still leave through os._exit, and say so
        print(f"Error: {type(error).__name__}: {error}", flush=True)
        code = 3
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
