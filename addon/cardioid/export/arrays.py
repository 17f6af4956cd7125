# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays out of Blender's collections: views of its memory where the layout is known, foreach_get elsewhere."""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np


def foreach(collection: Any, name: str, dtype: Any, channels: int = 1) -> np.ndarray:
    """A copy of one property of all elements: (n,) or (n, channels)."""
    data = np.empty(len(collection) * channels, dtype)
    collection.foreach_get(name, data)
    return data.reshape(-1, channels) if channels > 1 else data


def memory(collection: Any, dtype: np.dtype) -> np.ndarray | None:
    """Elements as they lie in memory, or None when they are not `dtype.itemsize` apart. Valid while the mesh is."""
    count = len(collection)
    if count < 2:
        return None
    first = collection[0].as_pointer()
    if (collection[1].as_pointer() - first != dtype.itemsize
            or collection[count - 1].as_pointer() - first != (count - 1) * dtype.itemsize):
        return None
    return np.frombuffer((ctypes.c_char * (count * dtype.itemsize)).from_address(first), dtype)
