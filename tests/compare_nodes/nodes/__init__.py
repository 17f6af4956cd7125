# SPDX-License-Identifier: GPL-3.0-or-later
"""The cases, by kind of node. Each module registers its own when it is loaded."""

from __future__ import annotations

import importlib
import pkgutil


def load_all() -> None:
    for module in sorted(m.name for m in pkgutil.iter_modules(__path__)):
        importlib.import_module(f"{__name__}.{module}")
