# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures side by side, each with a word or two above it."""

from __future__ import annotations

import matplotlib.font_manager as fonts
import numpy as np
from PIL import Image, ImageDraw, ImageFont

GAP, BAR = 6, 30  # pixels
GROUND, INK = (255, 255, 255), (43, 34, 48)


def strip(panels: list[tuple[str, np.ndarray]], columns: int = 0) -> np.ndarray:
    """Panels of equal size in rows of `columns` (0: all in one)."""
    columns = columns or len(panels)
    height, width = panels[0][1].shape[:2]
    rows = -(-len(panels) // columns)
    sheet = Image.new("RGB", (columns * (width + GAP) - GAP, rows * (height + BAR + GAP) - GAP), GROUND)
    pen = ImageDraw.Draw(sheet)
    font = ImageFont.truetype(fonts.findfont("DejaVu Sans"), 16)
    for i, (title, pixels) in enumerate(panels):
        x, y = i % columns * (width + GAP), i // columns * (height + BAR + GAP)
        pen.text((x + 2, y + 6), title, fill=INK, font=font)
        sheet.paste(Image.fromarray(pixels), (x, y + BAR))
    return np.asarray(sheet)
