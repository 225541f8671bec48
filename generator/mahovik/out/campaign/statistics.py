"""Statistics of a signal in time: sums over chunks, one number for each sample at the end."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mahovik.out.campaign.pose import Array, square
from mahovik.use.vibration.band import in_band


class Statistic(Protocol):
    """Takes values chunk by chunk.

    turned  whether it needs a vector on its axes; otherwise only its length counts
    stored  whether it keeps all values until the end
    """

    turned: bool
    stored: bool

    def add(self, t: Array, values: Array) -> None:
        """Take values (K, c, n) at times (K), s."""

    def result(self) -> Array:
        """The number of each sample (n)."""


class Peak:
    """Largest magnitude."""

    turned = stored = False

    def __init__(self, n: int) -> None:
        self._square = np.zeros(n)

    def add(self, t: Array, values: Array) -> None:
        """See Statistic."""
        np.maximum(self._square, square(values).max(axis=0, initial=0.0), out=self._square)

    def result(self) -> Array:
        """See Statistic."""
        return np.sqrt(self._square)


class Rms:
    """Root mean square over all times of output."""

    turned = stored = False

    def __init__(self, n: int) -> None:
        self._sum, self._count = np.zeros(n), 0

    def add(self, t: Array, values: Array) -> None:
        """See Statistic."""
        for row in square(values):  # in this order, however the chunks are cut
            self._sum += row
        self._count += len(t)

    def result(self) -> Array:
        """See Statistic."""
        return np.sqrt(self._sum / max(self._count, 1))


class Mean:
    """Mean over all times of output; of a vector without an axis, of its length."""

    turned = stored = False

    def __init__(self, n: int) -> None:
        self._sum, self._count = np.zeros(n), 0

    def add(self, t: Array, values: Array) -> None:
        """See Statistic."""
        for row in _size(values):  # in this order, however the chunks are cut
            self._sum += row
        self._count += len(t)

    def result(self) -> Array:
        """See Statistic."""
        return self._sum / max(self._count, 1)


class Least:
    """Smallest value; of a vector without an axis, of its length."""

    turned = stored = False

    def __init__(self, n: int) -> None:
        self._least = np.full(n, np.inf)

    def add(self, t: Array, values: Array) -> None:
        """See Statistic."""
        np.minimum(self._least, _size(values).min(axis=0, initial=np.inf), out=self._least)

    def result(self) -> Array:
        """See Statistic."""
        return self._least


class End:
    """The last value; of a vector without an axis, its length."""

    turned = stored = False

    def __init__(self, n: int) -> None:
        self._last = np.full(n, np.nan)

    def add(self, t: Array, values: Array) -> None:
        """See Statistic."""
        if len(t):
            self._last = _size(values[-1:])[0].copy()

    def result(self) -> Array:
        """See Statistic."""
        return self._last


class _Stored:
    """Keeps all values."""

    turned = stored = True

    def __init__(self) -> None:
        self._times: list[Array] = []
        self._values: list[Array] = []

    def add(self, t: Array, values: Array) -> None:
        """See Statistic."""
        self._times.append(t.copy())
        self._values.append(values.copy())

    def collect(self) -> tuple[Array, Array]:
        """All times (T), and values (n, c, T): each sample by itself, so that its sums do not depend on the others."""
        values = np.concatenate(self._values)
        return np.concatenate(self._times), np.ascontiguousarray(values.transpose(2, 1, 0))


class BandRms(_Stored):
    """Root mean square of the part within a band of frequencies (Hz), by the spectrum of the whole run.

    The mean is subtracted and a Hann window is put on, so that what has no whole number of periods does not spill over
    the spectrum; the sum is divided by the mean square of the window.
    """

    def __init__(self, band: tuple[float, float]) -> None:
        super().__init__()
        self._band = band

    def result(self) -> Array:
        """See Statistic."""
        t, values = self.collect()
        every = t[1] - t[0]
        even = int(np.count_nonzero(np.abs(np.diff(t) - every) <= 1e-6 * every)) + 1
        values = np.ascontiguousarray(values[..., :even])  # a last time of output may be nearer
        window = 0.5 - 0.5 * np.cos(2.0 * np.pi * (np.arange(even) + 0.5) / even)
        spectrum = np.fft.rfft((values - values.mean(axis=-1, keepdims=True)) * window)
        power = np.abs(spectrum) ** 2
        power[..., 1 : (even + 1) // 2] *= 2.0
        inside = in_band(np.fft.rfftfreq(even, every), self._band)
        each = np.ascontiguousarray(power[..., inside]).sum(axis=-1)
        return np.asarray(np.sqrt(sum(each.T) / even / (window**2).sum()))


class Settling(_Stored):
    """Time (s) from the first one on until the signal stays within a tolerance of its mean over the last tenth.

    Where it does not, the whole time.
    """

    def __init__(self, within: float) -> None:
        super().__init__()
        self._within = within

    def result(self) -> Array:
        """See Statistic."""
        t, values = self.collect()
        last = max(1, len(t) // 10)
        aside = values - np.ascontiguousarray(values[..., -last:]).mean(axis=-1, keepdims=True)
        outside = sum(part**2 for part in aside.transpose(1, 0, 2)) > self._within**2  # (n, T)
        until = len(t) - np.argmax(outside[:, ::-1], axis=1)  # number of times up to the last one outside
        until = np.where(outside.any(axis=1), until, 0)
        return np.asarray(t[np.minimum(until, len(t) - 1)] - t[0])


def _size(values: Array) -> Array:
    """The value where there is one component, else the length, (K, n)."""
    return values[:, 0] if values.shape[1] == 1 else np.sqrt(square(values))
