# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/radius-shrink.svg: the radius over the samples for some values of Radius Shrink (photon/radius.h)."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from style import FAINT, save

SAMPLES = 4096


def radii(alpha: float) -> np.ndarray:
    """Radius of samples 0 … SAMPLES-1 over that of the first: r² falls by (j + alpha) / (j + 1)."""
    j = np.arange(1, SAMPLES)
    return np.sqrt(np.concatenate([[1.0], np.cumprod((j + alpha) / (j + 1))]))


def draw() -> None:
    figure, axes = plt.subplots(figsize=(7, 3.3))
    for alpha, color in ((1.0, FAINT), (0.8, "#0f766e"), (2 / 3, "#be123c"), (0.5, "#2563eb")):
        name = "⅔ (default)" if 0.6 < alpha < 0.7 else f"{alpha:g}"
        axes.plot(
            np.arange(1, SAMPLES + 1), radii(alpha), color=color, lw=2.6 if "default" in name else 1.6, label=name
        )
    axes.set_xscale("log", base=2)
    axes.set(xlabel="samples", ylabel="radius, pixels", ylim=(0, 1.05), xlim=(1, SAMPLES))
    axes.set_xticks([1, 4, 16, 64, 256, 1024, 4096], ["1", "4", "16", "64", "256", "1024", "4096"])
    axes.legend(title="Radius Shrink", frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, "radius-shrink")
