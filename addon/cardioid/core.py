# SPDX-License-Identifier: GPL-3.0-or-later
"""The one place that imports the compiled engine.

The add-on must register even where the engine cannot be loaded (wrong Python, a library that is missing or clashes), so
the import is tried once, on first use, and its failure is kept as one sentence for the panel and for messages.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType

k_fallback_integrators = ("PT",)

_engine: ModuleType | None = None
_problem = ""


def load() -> ModuleType | None:
    """The module `_core`, or None; `problem()` then says why. Tries again after a failure only through `forget`."""
    global _engine, _problem
    if _engine is None and not _problem:
        try:
            _engine = importlib.import_module("._core", __package__)
        except ImportError as error:
            _problem = _explain(error)
        except Exception as error:  # a static initialiser of a library may raise anything
            _problem = f"The Cardioid engine failed to start: {error}"
    return _engine


def problem() -> str:
    """Why the engine is not there, in one sentence; empty when it is."""
    load()
    return _problem


def forget() -> None:
    """Drops what `load` remembers, so that the next use imports again (add-on reload)."""
    global _engine, _problem
    _engine, _problem = None, ""


def integrators() -> tuple[str, ...]:
    """Names of the integrators that this engine has, best first."""
    engine = load()
    listed = getattr(engine, "integrators", None)
    return tuple(listed()) if listed else k_fallback_integrators


def versions() -> dict[str, str]:
    """Versions of the engine and its libraries; empty without an engine."""
    engine = load()
    return {key: str(value) for key, value in engine.version().items()} if engine else {}


def _explain(error: ImportError) -> str:
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    if isinstance(error, ModuleNotFoundError) and (error.name or "").endswith("_core"):
        return f"The Cardioid engine is not installed for this Blender (no _core module for Python {python})"
    return f"The Cardioid engine could not be loaded: {error}"
