"""RMS of a sampled motion in a band, and its amplitude at a frequency, by one window with little leakage."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.use.study.quiet.options import Interval

Array = NDArray[np.float64]

LOBE = 4.0
"""Half width of the window's main lobe, in 1/T; leakage beside it is 92 dB lower."""

_TERMS = (0.35875, 0.48829, 0.14128, 0.01168)  # Blackman-Harris (1978), four terms


def window(n: int) -> Array:
    """n samples of the window."""
    angle = 2.0 * np.pi * np.arange(n) / n
    return np.asarray(sum((-1.0) ** k * a * np.cos(k * angle) for k, a in enumerate(_TERMS)))


def band_rms(x: Array, every: float, band: Interval, integrals: int) -> float:
    """RMS (root of the sum over columns) in the band (Hz) of x (times x axes), `integrals` times integrated."""
    n = len(x)
    w = window(n)
    X = np.fft.rfft(w[:, None] * _level(x, w), axis=0)
    f = np.fft.rfftfreq(n, every)
    inside = (f >= band[0]) & (f <= band[1]) & (f > 0.0)
    power = np.sum(np.abs(X[inside]) ** 2, axis=1) / (2.0 * np.pi * f[inside]) ** (2 * integrals)
    return float(np.sqrt(2.0 * power.sum() / (n * np.sum(w**2))))


def line_amplitude(x: Array, every: float, frequency: float, integrals: int) -> float:
    """Amplitude (root of the sum of squares over columns) of the line at a frequency (Hz)."""
    w = window(len(x))
    turn = np.exp(-2j * np.pi * frequency * every * np.arange(len(x)))
    value = 2.0 * ((w * turn) @ _level(x, w)) / w.sum()
    return float(np.linalg.norm(value)) / (2.0 * np.pi * frequency) ** integrals


def _level(x: Array, w: Array) -> Array:
    """The samples without their weighted mean and slope."""
    t = np.linspace(-1.0, 1.0, len(x))
    basis = np.column_stack([np.ones_like(t), t])
    fit = np.linalg.lstsq(w[:, None] * basis, w[:, None] * x, rcond=None)[0]
    return np.asarray(x - basis @ fit)
