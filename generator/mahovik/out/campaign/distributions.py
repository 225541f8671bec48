"""Distributions of one number: value by probability.

Every distribution is its quantile function, so that any design of samples, which spreads probabilities evenly over
0..1, draws from it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

Array = NDArray[np.float64]


class Distribution(Protocol):
    """Distribution of one number, SI."""

    @property
    def support(self) -> tuple[float, float]:
        """Least and largest value; infinite where there is none."""

    def quantile(self, p: Array) -> Array:
        """Values at probabilities (n,): each is exceeded with probability 1 - p."""

    def probability(self, x: float) -> float:
        """Probability of a value of at most `x`."""


@dataclass(frozen=True)
class Fixed:
    """Always the same number."""

    value: float

    @property
    def support(self) -> tuple[float, float]:
        return self.value, self.value

    def quantile(self, p: Array) -> Array:
        return np.full(np.shape(p), self.value)

    def probability(self, x: float) -> float:
        return float(x >= self.value)


@dataclass(frozen=True)
class Normal:
    """Normal distribution with a mean and a standard deviation."""

    mean: float
    sigma: float

    @property
    def support(self) -> tuple[float, float]:
        return -math.inf, math.inf

    def quantile(self, p: Array) -> Array:
        found: Array = self.mean + self.sigma * ndtri(p)
        return found

    def probability(self, x: float) -> float:
        return float(ndtr((x - self.mean) / self.sigma))


@dataclass(frozen=True)
class Uniform:
    """All values from `low` to `high` are equally likely."""

    low: float
    high: float

    @property
    def support(self) -> tuple[float, float]:
        return self.low, self.high

    def quantile(self, p: Array) -> Array:
        return np.clip(self.low + (self.high - self.low) * p, self.low, self.high)

    def probability(self, x: float) -> float:
        return min(1.0, max(0.0, (x - self.low) / (self.high - self.low)))


@dataclass(frozen=True)
class Triangular:
    """Density that rises linearly from `low` to `mode` and falls linearly to `high`."""

    low: float
    mode: float
    high: float

    @property
    def support(self) -> tuple[float, float]:
        return self.low, self.high

    def quantile(self, p: Array) -> Array:
        width, rise, fall = self.high - self.low, self.mode - self.low, self.high - self.mode
        below = self.low + np.sqrt(p * width * rise)
        above = self.high - np.sqrt((1.0 - p) * width * fall)
        return np.clip(np.where(p * width < rise, below, above), self.low, self.high)

    def probability(self, x: float) -> float:
        if x <= self.low or x >= self.high:
            return float(x >= self.high)
        width = self.high - self.low
        if x < self.mode:
            return (x - self.low) ** 2 / (width * (self.mode - self.low))
        return 1.0 - (self.high - x) ** 2 / (width * (self.high - self.mode))


@dataclass(frozen=True)
class Lognormal:
    """Positive values whose natural logarithm is normal, with standard deviation `sigma`, about that of `median`."""

    median: float
    sigma: float

    @property
    def support(self) -> tuple[float, float]:
        return 0.0, math.inf

    def quantile(self, p: Array) -> Array:
        found: Array = self.median * np.exp(self.sigma * ndtri(p))
        return found

    def probability(self, x: float) -> float:
        return float(ndtr(math.log(x / self.median) / self.sigma)) if x > 0.0 else 0.0


@dataclass(frozen=True)
class Discrete:
    """Some values with their probabilities, in the order given: those of a table share rows with its other columns."""

    values: tuple[float, ...]
    weights: tuple[float, ...]

    @property
    def support(self) -> tuple[float, float]:
        possible = [x for x, weight in zip(self.values, self.weights, strict=True) if weight > 0.0]
        return min(possible), max(possible)

    def quantile(self, p: Array) -> Array:
        ends = np.cumsum(self.weights) / math.fsum(self.weights)
        last = max(i for i, weight in enumerate(self.weights) if weight > 0.0)
        rows = np.minimum(np.searchsorted(ends, p, side="right"), last)
        return np.array(self.values)[rows]

    def probability(self, x: float) -> float:
        below = math.fsum(weight for value, weight in zip(self.values, self.weights, strict=True) if value <= x)
        return below / math.fsum(self.weights)


@dataclass(frozen=True)
class Truncated:
    """Another distribution, of which only values from `low` to `high` occur; their ratios are kept."""

    whole: Distribution
    low: float
    high: float

    @property
    def support(self) -> tuple[float, float]:
        low, high = self.whole.support
        return max(low, self.low), min(high, self.high)

    @property
    def kept_share(self) -> float:
        """Share of the whole distribution that is kept."""
        return self._ends[1] - self._ends[0]

    @property
    def _ends(self) -> tuple[float, float]:
        return self.whole.probability(self.low), self.whole.probability(self.high)

    def quantile(self, p: Array) -> Array:
        first, last = self._ends
        low, high = self.support
        return np.clip(self.whole.quantile(first + (last - first) * p), low, high)

    def probability(self, x: float) -> float:
        first, last = self._ends
        return min(1.0, max(0.0, (self.whole.probability(x) - first) / (last - first)))


@dataclass(frozen=True)
class Scaled:
    """Another distribution times a positive number."""

    whole: Distribution
    scale: float

    @property
    def support(self) -> tuple[float, float]:
        low, high = self.whole.support
        return low * self.scale, high * self.scale

    def quantile(self, p: Array) -> Array:
        return self.whole.quantile(p) * self.scale

    def probability(self, x: float) -> float:
        return self.whole.probability(x / self.scale)
