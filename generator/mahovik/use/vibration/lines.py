"""Lines of a jitter spectrum over a range of speeds: wheel, order, frequency, amplitude, and their sums.

A line is Re(a exp(i 2 pi f t)). Lines of unbalance have known phases; those of a maker's table have none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from mahovik.use.numeric import Array, Complex
from mahovik.use.vibration.band import in_band
from mahovik.use.vibration.torus import Flags

SAME = 1e-9
"""Relative difference of frequencies below which two lines are one: a beat lasts years."""

UNBALANCE, TABLE, COMBINATION = "unbalance", "table", "combination"


class LineName(NamedTuple):
    """Where a line comes from.

    wheel    name of the flywheel; of a combination all, as "rw1 + 2 rw2 - rw3"
    order    frequency over the flywheel's speed; of a combination the sum of |k_s|
    source   unbalance, combination: from (8); table: from a maker's harmonics, of phase unknown
    part     what of the table: radial force, axial force, radial moment, axial moment; else empty
    tolerance   of the amplitude, relative: of a table
    """

    wheel: str
    order: float
    source: str = UNBALANCE
    part: str = ""
    tolerance: float = 0.0

    @property
    def text(self) -> str:
        """Name in tables and pictures: `1 x rw1`."""
        return self.wheel if self.source == COMBINATION else f"{self.order:g} x {self.wheel}"


CONSTANT = LineName("", 0.0, COMBINATION)
"""The constant part."""


@dataclass(frozen=True, eq=False)
class Lines:
    """L lines at S speeds: frequency (S, L; Hz, >= 0), amplitude (S, L, 3) complex. Frequency 0: a constant."""

    names: tuple[LineName, ...]
    frequency: Array
    amplitude: Complex

    @property
    def sizes(self) -> Array:
        """Magnitudes (S, L, 3), zero for constants; NaN where there is no steady motion."""
        return np.where(self.frequency[:, :, None] == 0.0, 0.0, np.abs(self.amplitude))

    @property
    def is_finite(self) -> Flags:
        """(S): whether every line of a speed has a finite amplitude."""
        return np.asarray(np.isfinite(self.amplitude).all(axis=(1, 2)) & np.isfinite(self.frequency).all(axis=1))

    def worst(self) -> Array:
        """(S, 3): sum of all amplitudes: the largest value if all lines meet, whatever the phases."""
        return np.asarray(self.sizes.sum(axis=1))

    def rss(self) -> Array:
        """(S, 3): root mean square over time and over all phases of the flywheels: root of half the sum of squares."""
        return np.asarray(np.sqrt((self.sizes**2).sum(axis=1) / 2.0))

    def rms(self) -> Array:
        """(S, 3): root mean square over time with the phases as they are; lines of one frequency add up.

        NaN where a line has no finite amplitude.
        """
        known = np.array([name.source != TABLE for name in self.names], dtype=bool)
        loose = (self.sizes[:, ~known] ** 2).sum(axis=1)
        tied = [
            (np.abs(coherent(self.frequency[i, known], self.amplitude[i, known])[1]) ** 2).sum(axis=0)
            for i in range(len(self.frequency))
        ]
        found = np.sqrt((loose + np.array(tied).reshape(-1, 3)) / 2.0)
        return np.where(self.is_finite[:, None], found, np.nan)

    def of_band(self, band: tuple[float, float]) -> Lines:
        """These lines, 0 outside a band (Hz); NaN at speeds without a steady motion."""
        inside = in_band(self.frequency, band) | ~self.is_finite[:, None]
        return Lines(self.names, self.frequency, np.where(inside[:, :, None], self.amplitude, 0.0))

    def clear(self, which: Sequence[int]) -> Lines:
        """These lines, NaN at some of the speeds."""
        amplitude = self.amplitude.copy()
        amplitude[list(which)] = np.nan
        return Lines(self.names, self.frequency, amplitude)

    def with_tolerances(self) -> Lines:
        """These lines with the largest amplitudes that the tolerances of the tables allow."""
        factor = 1.0 + np.array([name.tolerance for name in self.names])
        return Lines(self.names, self.frequency, self.amplitude * factor[:, None])

    def join(self, other: Lines) -> Lines:
        """These lines and others at the same speeds."""
        return Lines(
            self.names + other.names,
            np.concatenate([self.frequency, other.frequency], axis=1),
            np.concatenate([self.amplitude, other.amplitude], axis=1),
        )

    def select(self, which: Flags) -> Lines:
        """Some of the lines: `which` (L) of bool."""
        names = tuple(name for name, keep in zip(self.names, which, strict=True) if keep)
        return Lines(names, self.frequency[:, which], self.amplitude[:, which])


def coherent(frequency: Array, amplitude: Complex) -> tuple[Array, Complex]:
    """Frequencies (m, ascending, above 0) and sums of amplitudes (m, 3) of lines (L), (L, 3) that share one."""
    order = np.argsort(frequency, kind="stable")
    order = order[frequency[order] > 0.0]
    f, a = frequency[order], amplitude[order]
    if len(f) == 0:
        return f, a
    first = np.concatenate([[True], np.diff(f) > SAME * f[1:]])
    return f[first], np.add.reduceat(a, np.flatnonzero(first), axis=0)
