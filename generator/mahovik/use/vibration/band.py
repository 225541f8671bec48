"""A band of frequencies: how it is given, which lines belong to it, and the root mean square of those that do."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.units import Dimension, QuantityError, number
from mahovik.errors import UsageError
from mahovik.use.numeric.se3 import Array, Complex

EDGE = 1e-9
"""Part of an end of a band by which a line may be beyond it: a line on an end is within, however it is rounded."""

FREQUENCY = Dimension("a frequency", "Hz")


def in_band(frequency: NDArray[np.floating[Any]] | float, band: tuple[float, float]) -> NDArray[np.bool_]:
    """Whether lines of these frequencies belong to a band (both Hz): within it, or within EDGE of its ends."""
    low, high = band
    return np.asarray((frequency >= low * (1.0 - EDGE)) & (frequency <= high * (1.0 + EDGE)))


def check_band(name: str, band: Sequence[float]) -> tuple[float, float]:
    """An argument that must be two frequencies (Hz) of at least 0, the lower first. Raises UsageError."""
    if not (len(band) == 2 and 0.0 <= band[0] < band[1] < math.inf):
        raise UsageError(f"{name} {'..'.join(f'{f:g}' for f in band)} Hz: expected two frequencies, the lower first")
    return float(band[0]), float(band[1])


def read_band(name: str, value: Sequence[float | str] | str) -> tuple[float, float]:
    """An argument that is a band, in Hz: two frequencies, or a text as "20..200Hz". Raises UsageError."""
    if not isinstance(value, str):
        return check_band(name, [read_frequency(name, edge) if isinstance(edge, str) else edge for edge in value])
    low, dots, high = value.partition("..")
    unit = re.sub(r"^[-+\d.eE\s]+", "", high)
    if not (dots and low.strip() and unit):
        raise UsageError(f'{name} {value}: expected two frequencies with their unit at the end, as "20..200Hz"')
    return check_band(
        name, [read_frequency(name, low if low.strip()[-1:].isalpha() else f"{low} {unit}"), read_frequency(name, high)]
    )


def read_frequency(name: str, text: str) -> float:
    """A frequency of an argument, Hz. Raises UsageError."""
    try:
        return number(text, FREQUENCY)
    except QuantityError:
        raise UsageError(f'{name} {text}: expected a frequency with its unit, as "35Hz"') from None


def rms(amplitudes: Complex, frequencies: Array, band: tuple[float, float] | None = None) -> Array:
    """Root of the mean square (3) of harmonics (H + 1, 3) above zero, or of those in a band (Hz)."""
    kept = in_band(frequencies, band or (0.0, np.inf)) & (frequencies > 0.0)
    return np.asarray(np.sqrt((np.abs(amplitudes[kept]) ** 2).sum(axis=0) / 2.0))
