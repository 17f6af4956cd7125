# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of a picture against a reference, on linear pixels."""

from __future__ import annotations

import numpy as np

EPSILON = 1e-2
TRIM = 0.001


def relative_squares(image: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """(y - r)² / (r² + 0.01) per pixel, on the mean of the channels."""
    y, r = image[..., :3].mean(-1), reference[..., :3].mean(-1)
    return (y - r) ** 2 / (r * r + EPSILON)


def trimmed(values: np.ndarray) -> float:
    """The mean without the 0.1 % largest."""
    ordered = np.sort(values.ravel())
    return float(ordered[: max(1, int(len(ordered) * (1.0 - TRIM)))].mean())


def evaluate(image: np.ndarray, reference: np.ndarray, mask: np.ndarray | None = None) -> dict[str, float]:
    """relmse, relmse_trim, rmse and energy (the ratio of the means) over the mask's pixels."""
    image, reference = image[..., :3].astype(np.float64), reference[..., :3].astype(np.float64)
    chosen = np.ones(reference.shape[:2], bool) if mask is None else mask
    relative = relative_squares(image, reference)[chosen]
    squares = ((image - reference) ** 2).mean(-1)[chosen]
    return {
        "relmse": float(relative.mean()),
        "relmse_trim": trimmed(relative),
        "rmse": float(np.sqrt(squares.mean())),
        "energy": float(image[chosen].mean() / max(reference[chosen].mean(), 1e-12)),
    }


def reference_error(replicates: np.ndarray, mask: np.ndarray | None = None) -> dict[str, float]:
    """The expected relmse and rmse² of the mean of independent replicates (n, h, w, 3) itself."""
    mean = replicates.mean(0)
    chosen = np.ones(mean.shape[:2], bool) if mask is None else mask
    variance = replicates[..., :3].mean(-1).var(0, ddof=1) / len(replicates)
    channels = replicates[..., :3].var(0, ddof=1).mean(-1) / len(replicates)
    r = mean[..., :3].mean(-1)
    return {
        "relmse": float((variance / (r * r + EPSILON))[chosen].mean()),
        "mse": float(channels[chosen].mean()),
    }


def tone_map(linear: np.ndarray, scale: float) -> np.ndarray:
    return (np.clip(linear * scale, 0.0, 1.0) ** (1 / 2.2)).astype(np.float32)


def flip(image: np.ndarray, reference: np.ndarray, mask: np.ndarray | None = None) -> float | None:
    """Mean LDR FLIP at an exposure that puts the reference's 90 % quantile at 0.8; None without flip-evaluator."""
    try:
        import flip_evaluator
    except ImportError:
        return None
    scale = 0.8 / max(float(np.quantile(reference[..., :3].mean(-1), 0.9)), 1e-9)
    a, b = tone_map(reference[..., :3], scale), tone_map(image[..., :3], scale)
    errors = np.asarray(flip_evaluator.evaluate(a, b, "LDR", inputsRGB=True, applyMagma=False)[0])
    errors = errors.reshape(*reference.shape[:2], -1).mean(-1)
    return float(errors.mean() if mask is None else errors[mask].mean())


def median_with_range(values: list[float]) -> tuple[float, float, float]:
    """Median, and the quartiles as its spread."""
    return tuple(float(x) for x in np.quantile(values, (0.5, 0.25, 0.75)))  # type: ignore[return-value]
