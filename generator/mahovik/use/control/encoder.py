"""Readings of encoders: delayed angles in whole counts; speeds are differences of them."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array


class Sensors(Protocol):
    """Angles as a servo reads them."""

    latency: Array

    def read(self, phi: Array) -> Array:
        """Angles (N, rad) as measured; true angles are not wrapped."""


class Ideal:
    """Exact sensors without delay."""

    def __init__(self, stand: Stand) -> None:
        self.latency = np.zeros(len(stand.flywheels))

    def read(self, phi: Array) -> Array:
        """See Sensors."""
        return phi


class Encoders:
    """Encoders of the stand file: a reading is the middle of the count reached.

    A flywheel without an encoder is measured exactly and without delay. `latency`: (N, s).
    """

    def __init__(self, stand: Stand) -> None:
        own = [s.encoder for s in stand.flywheels]
        self.latency = np.array([0.0 if e is None else e.latency for e in own])
        self._exact = np.array([e is None for e in own])
        self._counts = np.array([1 if e is None else e.counts for e in own]) / (2.0 * np.pi)
        self._zero = np.array([0.0 if e is None else e.zero for e in own])

    def read(self, phi: Array) -> Array:
        """See Sensors."""
        counted = (np.floor(self._counts * phi + self._zero) + 0.5 - self._zero) / self._counts
        return np.where(self._exact, phi, counted)
