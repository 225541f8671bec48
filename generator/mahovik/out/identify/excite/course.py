"""Programmes of an experiment: whole turns in its duration plus slow harmonics of the speed, always inside bounds.

A programme is decoded from numbers in 0..1, one row per flywheel: the first chooses the mean speed, two per harmonic
its modulation. Whatever the numbers are, speed and acceleration are inside their bounds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.programme import Fourier, Programme
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import is_closed
from mahovik.core.stand.identity import identities
from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.model import Stand
from mahovik.out.identify.excite.bounds import Bounds

Array = NDArray[np.float64]

NAME = "excite"
"""In place of a required motion's name."""


@dataclass(frozen=True, eq=False)
class Courses:
    """Programmes of `duration` s inside bounds, with a number of harmonics of the speed from 1/duration on."""

    stand: Stand
    bounds: Bounds
    duration: float
    harmonics: int

    @property
    def width(self) -> int:
        """Numbers of one flywheel."""
        return 1 + 2 * self.harmonics

    @cached_property
    def base(self) -> float:
        """Speed of one turn in the duration, rad/s."""
        return 2.0 * math.pi / self.duration

    @cached_property
    def windings(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Least and most whole turns of each flywheel."""
        low = np.maximum(np.ceil(self.bounds.speed_min / self.base * (1 - 1e-12)), 1.0)
        return low.astype(np.int64), np.floor(self.bounds.speed / self.base * (1 + 1e-12)).astype(np.int64)

    @cached_property
    def _acceleration(self) -> Array:
        """Largest acceleration of each flywheel by its bound and about by its torque, rad/s2."""
        found = self.bounds.acceleration.copy()
        for s, wheel in enumerate(self.stand.flywheels):
            torque = self.bounds.torque[s]
            if wheel.motor is not None and wheel.motor.torque is not None:
                torque = min(torque, wheel.motor.torque)
            found[s] = min(found[s], torque / float(inertia_about_origin(wheel)[0, 0]))
        return found

    def even(self) -> Array:
        """Numbers (N, width) of distinct constant speeds that are spread evenly, the last at its bound.

        They begin at the least speed; without one at a share 1/N of the largest.
        """
        N = len(self.stand.flywheels)
        found = np.full((N, self.width), 0.5)
        low = np.where(self.bounds.speed_min > 0.0, self.bounds.speed_min, self.bounds.speed / N)
        share = np.arange(N) / (N - 1) if N > 1 else np.ones(1)
        found[:, 0] = self.share_of(low + share * (self.bounds.speed - low))
        return found

    def pack_speeds(self, gap: float, order: NDArray[np.int64]) -> Array:
        """Numbers of constant speeds below the bounds, `gap` (rad/s) apart in the order of the flywheels."""
        found = np.full((len(order), self.width), 0.5)
        found[:, 0] = self.share_of(self.bounds.speed - gap * order)
        return found

    def share_of(self, speed: Array) -> Array:
        """First number of each flywheel that gives the speed (N, rad/s), or the nearest that makes whole turns."""
        low, high = self.windings
        turns = np.clip(np.round(speed / self.base), low, high)
        return np.asarray((turns - low + 0.5) / (high - low + 1))

    def programme(self, numbers: Array, share: float = 1.0) -> Programme:
        """The programme of numbers (N, width) in 0..1; modulations of this share."""
        low, high = self.windings
        N, H = len(numbers), self.harmonics
        turns = np.minimum(low + np.floor(numbers[:, 0] * (high - low + 1)).astype(np.int64), high)
        mean = turns * self.base
        room = np.minimum(mean - self.bounds.speed_min, self.bounds.speed - mean).clip(min=0.0)
        k = np.arange(1.0, H + 1.0) * self.base
        wave = (2.0 * numbers[:, 1:] - 1.0).reshape(N, H, 2) * room[:, None, None]
        size = np.hypot(wave[:, :, 0], wave[:, :, 1])
        fastest, steepest = size.sum(axis=1), (size * k).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            fits = np.nanmin([np.ones(N), room / fastest, self._acceleration / steepest], axis=0)
        wave *= share * fits[:, None, None]
        # phi' = a cos + b sin is phi = a/k sin - b/k cos
        course = Fourier(np.zeros(N), -(wave[:, :, 1] / k).T, (wave[:, :, 0] / k).T)
        whose, names = identities(self.stand), _coordinate_names(self.stand)
        return Programme(
            stand=self.stand.name, structure=whose.structure, physics=whose.physics, motion=NAME,
            flywheels=tuple(wheel.name for wheel in self.stand.flywheels), periodic=True, span=self.duration,
            bias=np.zeros(len(names) or 6), winding=tuple(turns.tolist()), course=course, coordinates=names,
        )  # fmt: skip


def _coordinate_names(stand: Stand) -> tuple[str, ...]:
    """Names of the coordinates of a held carrier, which a programme file keeps; none where it has none, or is free."""
    hold = stand.hold
    return coordinates_of(stand).names if hold is not None and hold.freedoms and is_closed(hold) else ()
