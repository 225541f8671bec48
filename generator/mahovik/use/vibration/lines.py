"""Lines of a vibration over a range of speeds, and the three sums of them: the one definition for every question.

A line is Re(a exp(2 pi i f t)): one a wheel and order, one a frequency at which wheels combine. On each axis of what is
seen, with noise of root mean square s beside them,

    rms    root mean square over time at the given phases: lines of one frequency add up with their phases, those of a
           maker's table, whose phases nobody knows, and noise by their squares
    peak   largest value that these phases let happen: sum over frequencies of what adds up there, and 3 s
    worst  largest value at any phases, to first order in unbalance by wheel: sum of all amplitudes, and 3 s

A wheel's first order is that of the linear equations. What the whole equations, solved at the given phases, have beside
it is a line as well, so that rms and peak are those of the whole equations, and worst is never below peak.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.vibration.band import in_band

SAME = 1e-9
"""Relative difference of frequencies below which two lines are one: a beat lasts years."""

NEGLIGIBLE = 1e-9
"""Part of the largest amplitude below which what the whole equations have beside the linear ones is no line."""

UNBALANCE, MAKER, COMBINATION = "unbalance", "maker", "combination"

SIGMAS = 3.0
"""Peak of noise by its root mean square."""


class LineName(NamedTuple):
    """Where a line comes from.

    wheel      name of the flywheel; of several their names, as "rw1, rw2", or the combination, as "rw1 - 2 rw2"
    order      frequency over the flywheel's speed; of a combination the sum of its whole numbers
    source     UNBALANCE or COMBINATION: from (8); MAKER: from a table of harmonics, of unknown phase
    part       what of the table: radial force, axial force, radial moment, axial moment; else empty
    tolerance  of the amplitude, relative: of a table
    """

    wheel: str
    order: float
    source: str = UNBALANCE
    part: str = ""
    tolerance: float = 0.0

    @property
    def text(self) -> str:
        """Name in tables and pictures: `1 x rw1`."""
        return f"{self.wheel if self.source == COMBINATION else f'{self.order:g} x {self.wheel}'} {self.part}".strip()


class Sums(NamedTuple):
    """rms, peak, worst (S, 3 each); NaN where there is no steady motion."""

    rms: Array
    peak: Array
    worst: Array


class Spectrum(NamedTuple):
    """Lines of the whole equations at one set of speeds and phases.

    frequency (m, Hz, ascending), each once; amplitude (m, 3)
    left_out  (3): sum of the amplitudes of lines that the solution leaves out; NaN: not known
    residual  part of the largest acceleration that (8) is off by at random phases
    method    in words
    hold      (6; N, N m): constant wrench on the carrier in E1 that keeps its mean place along free directions
    unstable  whether deviations grow; known where the speeds have a common period
    """

    names: tuple[LineName, ...]
    frequency: Array
    amplitude: Complex
    left_out: Array
    residual: float
    method: str
    hold: Array
    unstable: bool


@dataclass(frozen=True, eq=False)
class Lines:
    """L lines at S speeds: frequency (S, L; Hz, 0 where a line has none), amplitude (S, L, 3) complex."""

    names: tuple[LineName, ...]
    frequency: Array
    amplitude: Complex

    @staticmethod
    def none(count: int) -> Lines:
        """No lines at so many speeds."""
        return Lines((), np.zeros((count, 0)), np.zeros((count, 0, 3), dtype=np.complex128))

    @property
    def sizes(self) -> Array:
        """Magnitudes (S, L, 3); NaN where there is no steady motion."""
        return np.abs(self.amplitude)

    @property
    def is_finite(self) -> NDArray[np.bool_]:
        """(S): whether every line of a speed has a finite amplitude."""
        return np.asarray(np.isfinite(self.amplitude).all(axis=(1, 2)))

    def sums(self, noise: Array | float = 0.0, band: tuple[float, float] | None = None) -> Sums:
        """The sums within a band (Hz; None: all), with noise of this mean square (S, 3) there."""
        inside = in_band(self.frequency, band or (0.0, np.inf)) | ~self.is_finite[:, None]
        amplitude = np.where(inside[:, :, None], self.amplitude, 0.0)
        tied = np.array([name.source != MAKER for name in self.names], dtype=bool)
        shared = np.abs(coherent(self.frequency[:, tied], amplitude[:, tied])[1])
        sizes = np.abs(amplitude)
        loose, most = sizes[:, ~tied], SIGMAS * np.sqrt(noise)
        square = np.einsum("slk,slk->sk", shared, shared) + np.einsum("slk,slk->sk", loose, loose)
        peak = shared.sum(axis=1) + loose.sum(axis=1)
        return Sums(np.sqrt(square / 2.0 + noise), peak + most, sizes.sum(axis=1) + most)

    def with_tolerances(self) -> Lines:
        """These lines with the largest amplitudes that the tolerances of the tables allow."""
        factor = 1.0 + np.array([name.tolerance for name in self.names])
        return replace(self, amplitude=self.amplitude * factor[:, None])

    def join(self, other: Lines) -> Lines:
        """These lines and others at the same speeds."""
        return Lines(
            self.names + other.names,
            np.concatenate([self.frequency, other.frequency], axis=1),
            np.concatenate([self.amplitude, other.amplitude], axis=1),
        )

    def below(self, other: Lines) -> Lines:
        """The same lines at other speeds, then at these."""
        frequency = np.concatenate([other.frequency, self.frequency])
        return Lines(self.names, frequency, np.concatenate([other.amplitude, self.amplitude]))

    def at(self, steps: NDArray[np.int_] | list[int]) -> Lines:
        """These lines at some of the speeds."""
        return Lines(self.names, self.frequency[steps], self.amplitude[steps])

    def select(self, which: NDArray[np.bool_]) -> Lines:
        """Some of the lines: `which` (L) of bool."""
        names = tuple(name for name, keep in zip(self.names, which, strict=True) if keep)
        return Lines(names, self.frequency[:, which], self.amplitude[:, which])

    def with_whole(self, solved: Mapping[int, Spectrum]) -> Lines:
        """These lines of the linear equations, with what the whole ones have beside them at some of the speeds.

        The line of a wheel that has its frequency alone is that of the whole equations; beside several it is one more.
        """
        amplitude, more = self.amplitude.copy(), dict[LineName, dict[int, tuple[float, Complex]]]()
        for i, spectrum in solved.items():
            largest = float(np.abs(spectrum.amplitude).max(initial=0.0))
            for name, f, a in zip(spectrum.names, spectrum.frequency, spectrum.amplitude, strict=True):
                near = np.flatnonzero(np.abs(self.frequency[i] - f) <= SAME * f)
                left = a - amplitude[i, near].sum(axis=0)
                if len(near) == 1:
                    amplitude[i, near[0]] = a
                elif not np.abs(left).max() <= NEGLIGIBLE * largest:
                    more.setdefault(name, {})[i] = f, left
        added = Lines.none(len(amplitude)) if not more else Lines(
            tuple(more), np.zeros((len(amplitude), len(more))), np.zeros((len(amplitude), len(more), 3), np.complex128)
        )  # fmt: skip
        for column, rows in enumerate(more.values()):
            for i, (f, a) in rows.items():
                added.frequency[i, column], added.amplitude[i, column] = f, a
        return replace(self, amplitude=amplitude).join(added)


def coherent(frequency: Array, amplitude: Complex) -> tuple[Array, Complex]:
    """Frequencies (S, L), ascending, and amplitudes (S, L, 3) of lines with those of one frequency added up.

    The sum is at the first of them; at the others, and at a frequency of 0, the amplitude is 0.
    """
    order = np.argsort(frequency, axis=1, kind="stable")
    f, a = np.take_along_axis(frequency, order, axis=1), np.take_along_axis(amplitude, order[..., None], axis=1)
    total = np.zeros_like(a)
    if f.size:
        first = np.diff(f, axis=1, prepend=-1.0) > SAME * f
        total[first] = np.add.reduceat(a.reshape(-1, 3), np.flatnonzero(first))
    return f, np.where((f > 0.0)[..., None], total, 0.0)
