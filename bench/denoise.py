# SPDX-License-Identifier: GPL-3.0-or-later
"""Intel Open Image Denoise through PyPI's pyoidn, as Cycles uses it: HDR colour with albedo and normal."""

from __future__ import annotations

import time

import numpy as np

from . import regions


def problem() -> str:
    try:
        import pyoidn  # noqa: F401
    except (ImportError, OSError) as error:
        return f"OIDN is left out: {error}"
    return ""


def oidn(picture: np.ndarray, surface: regions.Surface) -> tuple[np.ndarray, float]:
    """The denoised picture and its CPU seconds. The guides have little noise, so OIDN is told that they are clean."""
    import pyoidn

    color = np.ascontiguousarray(picture[..., :3], dtype=np.float32)
    albedo = np.ascontiguousarray(np.clip(surface.albedo, 0.0, 1.0), dtype=np.float32)
    normal = np.ascontiguousarray(np.clip(surface.normal, -1.0, 1.0), dtype=np.float32)
    start = time.process_time()
    out = pyoidn.denoise(color, albedo=albedo, normal=normal, hdr=True, clean_aux=True)
    return np.asarray(out), time.process_time() - start
