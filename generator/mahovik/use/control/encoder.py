"""What encoders read: angles of some time ago, in whole counts; speeds as differences of them."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.use.plan.array import Array


class Sensors(Protocol):
    """Angles that a servo gets to know."""

    latency: Array

    def read(self, phi: Array) -> Array:
        """Angles (N, rad) as measured, of true angles counted through."""


class Ideal:
    """Exact, and at once."""

    def __init__(self, stand: Stand) -> None:
        self.latency = np.zeros(len(stand.flywheels))

    def read(self, phi: Array) -> Array:
        """See Sensors."""
        return phi


class Encoders:
    """Of the stand file: the count that the angle has reached, as the angle in the middle of this count.

    A flywheel without an encoder is measured exactly and at once. `latency`: (N, s).
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
