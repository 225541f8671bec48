"""A band of frequencies: which lines belong to it, and the root mean square of those that do."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.errors import UsageError
from mahovik.use.numeric import Array, Complex

EDGE = 1e-9
"""Part of an end of a band by which a line may be beyond it: a line on an end is within, however it is rounded."""


def in_band(frequency: NDArray[np.floating[Any]] | float, band: tuple[float, float]) -> NDArray[np.bool_]:
    """Whether lines of these frequencies belong to a band (both Hz): within it, or within EDGE of its ends."""
    low, high = band
    return np.asarray((frequency >= low * (1.0 - EDGE)) & (frequency <= high * (1.0 + EDGE)))


def check_band(name: str, band: tuple[float, float]) -> None:
    """Raise UsageError unless an argument is two frequencies (Hz) of at least 0, the lower first."""
    if not (len(band) == 2 and 0.0 <= band[0] < band[1] < math.inf):
        raise UsageError(f"{name} {'..'.join(f'{f:g}' for f in band)} Hz: expected two frequencies, the lower first")


def rms(amplitudes: Complex, frequencies: Array, band: tuple[float, float] | None = None) -> Array:
    """Root of the mean square (3) of harmonics (H + 1, 3) above zero, or of those in a band (Hz)."""
    kept = in_band(frequencies, band or (0.0, np.inf)) & (frequencies > 0.0)
    return np.asarray(np.sqrt((np.abs(amplitudes[kept]) ** 2).sum(axis=0) / 2.0))
