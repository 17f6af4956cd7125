# SPDX-License-Identifier: GPL-3.0-or-later
"""What the drawings share: colours, sizes, and how they are saved (the same bytes for the same code)."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

IMAGES = Path(__file__).resolve().parents[1] / "images"

INK = "#2b2230"
FAINT = "#8d8592"
FLOOR = "#6b5d52"
GLASS = "#7cc4e8"
LAMP = "#f2b632"
CLASSES = {"D1": "#d97706", "D2": "#2563eb", "D3": "#0f766e", "C1": "#be123c", "C2": "#7c3aed"}

plt.rcParams.update(
    {
        "font.family": "DejaVu Sans",
        "font.size": 10,
        "axes.edgecolor": FAINT,
        "axes.labelcolor": INK,
        "axes.titlesize": 11,
        "text.color": INK,
        "xtick.color": INK,
        "ytick.color": INK,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "svg.hashsalt": "cardioid",
        "figure.constrained_layout.use": True,
    }
)


def save(figure: plt.Figure, name: str) -> Path:
    """Writes docs/images/<name>.svg on white."""
    path = IMAGES / f"{name}.svg"
    figure.savefig(path, facecolor="white", metadata={"Date": None})
    plt.close(figure)
    return path
