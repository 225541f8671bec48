"""Information that an experiment gives on free numbers, and their covariance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.programme.regime import programme_regime
from mahovik.core.stand.state import State
from mahovik.out.api.stands import Stand
from mahovik.out.identify.channels import Channel
from mahovik.out.identify.deviations import Deviations
from mahovik.out.identify.estimate import PRIOR, PRIOR_START
from mahovik.out.identify.free import Free
from mahovik.out.identify.jacobian import slopes
from mahovik.out.identify.predict import Predictor

Array = NDArray[np.float64]

Criterion = Literal["A", "D"]
"""A: least mean variance. D: least volume of the ellipsoid of confidence."""

PER_TURN = 8.0
"""Least number of samples per turn of the fastest flywheel in the search."""


@dataclass(frozen=True, eq=False)
class Quality:
    """Accuracy of theta from one experiment: its information (k, k), in natural sizes.

    Initial states and constant offsets of the channels are unknown too; the priors are those of the estimation.
    """

    information: Array
    scale: Array

    @cached_property
    def _inverse(self) -> Array:
        return np.asarray(np.linalg.inv(self.information))

    @property
    def covariance(self) -> Array:
        """Covariance of theta (k, k), SI."""
        return np.asarray(self.scale[:, None] * self._inverse * self.scale)

    @property
    def mean_variance(self) -> float:
        """Mean of the variances of theta in natural sizes."""
        return float(np.trace(self._inverse)) / len(self.scale)

    @property
    def volume(self) -> float:
        """Geometric mean of the variances along the axes of the ellipsoid of confidence, in natural sizes."""
        return math.exp(-float(np.linalg.slogdet(self.information)[1]) / len(self.scale))

    def value(self, criterion: Criterion) -> float:
        """The value that a search makes small; see Criterion."""
        return self.mean_variance if criterion == "A" else self.volume

    @property
    def unseen(self) -> NDArray[np.bool_]:
        """Numbers (k) that the experiment hardly shows."""
        return np.asarray(np.sqrt(np.diag(self._inverse)) > 0.5 * PRIOR)


def quality_of(jacobian: Array, starts: Array, free: Free, weight: float) -> Quality:
    """Quality by derivatives (T, C, k) and (T, C, D) in units of the noise; `weight`: true samples per row."""
    k = jacobian.shape[2]
    scale = Deviations(free.stand).scale
    J = np.concatenate([jacobian * free.scale, starts * scale], axis=2)
    J = (J - J.mean(axis=0)).reshape(-1, k + len(scale))
    whole = weight * (J.T @ J)
    whole += np.diag(np.repeat([PRIOR**-2, PRIOR_START**-2], [k, len(scale)]))
    nuisance = np.linalg.solve(whole[k:, k:], whole[k:, :k])
    return Quality(whole[:k, :k] - whole[:k, k:] @ nuisance, free.scale)


@dataclass(frozen=True, eq=False)
class Experiment:
    """Sensors that are read while the flywheels follow a programme once.

    channels, noise   channels that are read (C), and the standard deviation of each sample, SI
    rate              samples per second
    fastest           largest speed of a flywheel, rad/s
    start             nominal state of the carrier
    """

    stand: Stand
    free: Free
    channels: Sequence[Channel]
    noise: Array
    rate: float
    fastest: float
    start: State | None = None

    def quality(self, programme: Programme, fine: bool = False) -> Quality:
        """Accuracy of theta by the programme. `fine`: from every sample, else from fewer rows of the same weight."""
        every = 1.0 / self.rate
        if not fine:
            every = max(every, 2.0 * math.pi / self.fastest / PER_TURN)
        count = max(math.ceil(programme.span / every), 2)
        every = programme.span / count
        regime = programme_regime(programme)
        predictor = Predictor(self.stand, regime, self.channels, 0.0, every, count, self.start)
        found = slopes(predictor, self.free, self.free.nominal, np.zeros(predictor.deviations.count))
        noise = self.noise[:, None]
        return quality_of(found.by_theta / noise, found.by_start / noise, self.free, every * self.rate)
