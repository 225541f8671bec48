"""Filters without delay, for measured and modelled signals alike: applied to both, they change no comparison.

lowpass    Butterworth, forwards and backwards (scipy.signal.sosfiltfilt): gain |H|^2, -6 dB at the cutoff
bandpass   the same between two frequencies
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.signal import butter, sosfiltfilt

from mahovik.errors import InputError
from mahovik.use.measured.recording import Array

SHORTEST = 32
"""Samples of a stretch from which on it is filtered; shorter ones become NaN."""


@dataclass(frozen=True)
class Filter:
    """A filter without delay. low, high: Hz, passed between them; 0 for a low-pass. order: of one direction."""

    high: float
    low: float = 0.0
    order: int = 4

    def apply(self, values: Array, step: float, stretches: Iterable[slice] = (slice(None),)) -> Array:
        """(T, ...) Filtered values, stretch by stretch; step: s between samples.

        A stretch with NaN is filtered between them, so that the same call on a model of the same shape with the same
        NaN has the same ends. Raises InputError: the frequencies do not fit the step.
        """
        half = 0.5 / step
        if not 0.0 <= self.low < self.high < half:
            raise InputError(f"filter from {self.low:g} to {self.high:g} Hz: expected 0 <= low < high < {half:g} Hz")
        edges = self.high if self.low == 0.0 else (self.low, self.high)
        sections = butter(self.order, edges, "lowpass" if self.low == 0.0 else "bandpass", fs=1.0 / step, output="sos")
        found = np.full(values.shape, np.nan)
        for stretch in stretches:
            rows = np.arange(len(values))[stretch]
            good = np.isfinite(values[rows]).reshape(len(rows), -1).all(axis=1)
            for part in np.split(rows, np.flatnonzero(np.diff(good.astype(int))) + 1):
                if len(part) >= SHORTEST and np.isfinite(values[part]).all():
                    found[part] = sosfiltfilt(sections, values[part], axis=0)
        return found
