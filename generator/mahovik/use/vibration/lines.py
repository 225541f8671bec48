"""Lines of a vibration over a range of speeds, the three sums of them in a band, and requirements on these.

A line is Re(a exp(2 pi i f t)): one a wheel and order, one a frequency at which wheels combine. On each axis of what is
seen, with noise of root mean square s beside them,

    rms    root mean square over time at the given phases: lines of one frequency add up with their phases, those of a
           maker's table, whose phases nobody knows, and noise by their squares
    peak   largest value that these phases let happen: sum over frequencies of what adds up there, and 3 s
    worst  largest value at any phases, to first order in unbalance by wheel: sum of all amplitudes, and 3 s

The length of what is seen, as a vector, has the same three: rms is the root of the sum of their squares, peak and worst
are the largest length, which of one frequency is half the longest axis of its ellipse, not the root of that sum.

A wheel's first order is that of the linear equations. What the whole equations, solved at the given phases, have beside
it is a line as well, so that rms and peak are those of the whole equations, and worst is never below peak.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

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
    if not isinstance(value, str | Sequence):
        raise UsageError(f'{name} {value}: expected two frequencies, as "20..200Hz"')
    if not isinstance(value, str):
        return check_band(name, [read_frequency(name, edge) if isinstance(edge, str) else edge for edge in value])
    low, dots, high = value.partition("..")
    unit = re.sub(r"^[-+\d.eE\s]+", "", high)
    if not (dots and low.strip() and unit):
        raise UsageError(f'{name} {value}: expected two frequencies with their unit at the end, as "20..200Hz"')
    last = read_frequency(name, high)
    return check_band(name, [read_frequency(name, low if low.strip()[-1:].isalpha() else f"{low} {unit}"), last])


def read_frequency(name: str, text: str) -> float:
    """A frequency of an argument, Hz. Raises UsageError."""
    try:
        return number(text, FREQUENCY)
    except QuantityError:
        raise UsageError(f'{name} {text}: expected a frequency with its unit, as "35Hz"') from None


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
    part       what of the table: radial force, axial force, radial moment, axial moment, of one that turns against the
               wheel with "backward"; else empty
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
    """rms, peak, worst, (S, 3) each on the axes or (S) of the length; NaN where there is no steady motion."""

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
        """The sums on the axes in a band (Hz; None: all), with noise of this mean square (S, 3) there."""
        sizes = [np.abs(a) for a in (self.by_frequency(band)[1], self.inside(band))]
        peak, worst = (size.sum(axis=1) + SIGMAS * np.sqrt(noise) for size in sizes)
        square = np.einsum("slk,slk->sk", sizes[0], sizes[0])
        return Sums(np.sqrt(square / 2.0 + noise), peak, worst)

    def lengths(self, noise: Array, band: tuple[float, float] | None = None) -> Sums:
        """The sums (S) of the length, likewise."""
        most = SIGMAS * np.sqrt(noise.sum(axis=-1))
        peak, worst = (longest(a) + most for a in (self.by_frequency(band)[1], self.inside(band)))
        return Sums(np.linalg.norm(self.sums(noise, band).rms, axis=1), peak, worst)

    def inside(self, band: tuple[float, float] | None) -> Complex:
        """Amplitudes (S, L, 3), 0 outside of a band (Hz; None: all)."""
        inside = in_band(self.frequency, band or (0.0, np.inf)) | ~self.is_finite[:, None]
        return np.where(inside[:, :, None], self.amplitude, 0.0)

    def by_frequency(self, band: tuple[float, float] | None = None) -> tuple[Array, Complex]:
        """Frequencies (S, L) and amplitudes in a band, those of one frequency added up but for makers' lines."""
        tied = np.array([name.source != MAKER for name in self.names], dtype=bool)
        amplitude = self.inside(band)
        shared = coherent(self.frequency[:, tied], amplitude[:, tied])
        loose = self.frequency[:, ~tied], amplitude[:, ~tied]
        f, a = (np.concatenate(parts, axis=1) for parts in zip(shared, loose, strict=True))
        return f, a

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


DIRECTIONS = np.array([n for n in np.ndindex(3, 3, 3) if n > (1, 1, 1)]) - 1.0
"""The 13 axes of a cube, through its faces, edges and corners, from which the longest direction is sought."""

CLIMBS = 40
"""Steps of this search, which leave at most 1e-3 of the length."""


def longest_direction(amplitude: Complex) -> Array:
    """Directions (..., 3) in which vectors Re(a exp(i p)) with amplitudes (..., 3) are longest over p."""
    turn = np.exp(-0.5j * np.angle((amplitude * amplitude).sum(axis=-1, keepdims=True)))
    return np.asarray((amplitude * turn).real)


def size_of(amplitude: Complex) -> Array:
    """Largest length (...) of vectors Re(a exp(i p)) with amplitudes (..., 3): half the longest axis of the ellipse."""
    return np.asarray(np.linalg.norm(longest_direction(amplitude), axis=-1))


def longest(amplitude: Complex) -> Array:
    """Largest length (S) of the sum of lines (S, L, 3) at any phases.

    It is the largest sum of what the lines have along one direction. Of the axes of a cube and of the largest line the
    best direction is turned to the sum of the lines, each at its phase of the largest part along it.
    """
    rows, lines, _ = amplitude.shape
    if not lines:
        return np.zeros(rows)
    a = np.nan_to_num(amplitude)
    largest = np.take_along_axis(a, size_of(a).argmax(axis=1)[:, None, None], axis=1)
    starts = np.concatenate([np.broadcast_to(DIRECTIONS, (rows, 13, 3)), longest_direction(largest)], axis=1)
    starts /= np.maximum(np.linalg.norm(starts, axis=2, keepdims=True), 1e-300)
    best = np.abs(a @ starts.swapaxes(1, 2)).sum(axis=1).argmax(axis=1)
    n = np.take_along_axis(starts, best[:, None, None], axis=1)[:, 0]
    for _ in range(CLIMBS if lines > 1 else 0):
        along = np.einsum("slk,sk->sl", a, n)
        n = np.einsum("slk,sl->sk", a, np.exp(-1j * np.angle(along))).real
        n /= np.maximum(np.linalg.norm(n, axis=1, keepdims=True), 1e-300)
    length = np.abs(np.einsum("slk,sk->sl", a, n)).sum(axis=1)
    return np.where(np.isfinite(amplitude).all(axis=(1, 2)), length, np.nan)


WORDS = {
    "rad": "an angle",
    "rad/s": "an angular speed",
    "m": "a length",
    "m/s": "a velocity",
    "m/s2": "an acceleration",
    "rad/s2": "an angular acceleration",
    "N": "a force",
    "N m": "a moment",
}

_TEXT = re.compile(r"\s*(\w+)\s+([-+\d.eE]+)\s*([^\d\s.eE+-].*?)(?:\s+([\d.eE+-]+)\s*\.\.\s*([\d.eE+-]+)\s*Hz)?\s*")


@dataclass(frozen=True)
class Requirement:
    """A limit (SI) of a sum, rms, peak or worst, on every axis and at every speed.

    band  Hz; None: all
    unit  that of the text, and its size in SI
    """

    text: str
    sum: str
    limit: float
    band: tuple[float, float] | None = None
    unit: tuple[str, float] = ("", 1.0)


def read_requirements(texts: Sequence[str], name: str, unit: str) -> tuple[Requirement, ...]:
    """Requirements from texts, as "rms 0.1 arcsec" or "worst 2 um 10..200Hz", on what is seen. Raises UsageError."""
    if texts and unit not in WORDS:
        raise UsageError(f"require: {name} of a basis has no unit; expected another freedom, a point or a load")
    return tuple(_read(text, Dimension(WORDS[unit], unit.replace("s2", "s^2"))) for text in texts)


def _read(text: str, dimension: Dimension) -> Requirement:
    parts = _TEXT.fullmatch(text)
    if parts is None or parts[1].lower() not in Sums._fields:
        raise UsageError(
            f'require {text}: expected rms, peak or worst and a limit with a unit, as "rms 0.1 arcsec 10..200Hz"'
        )
    if ".." in parts[3]:
        raise UsageError(f'require {text}: expected a band with its unit at the end, as "10..200Hz"')
    try:
        limit = number(f"{parts[2]} {parts[3]}", dimension)
        band = (float(parts[4]), float(parts[5])) if parts[4] else None
    except (QuantityError, ValueError) as error:
        raise UsageError(f"require {text}: {error}") from None
    if not (limit > 0.0 and (band is None or 0.0 <= band[0] < band[1] < np.inf)):
        raise UsageError(f"require {text}: expected a limit above 0, and the lower frequency first")
    return Requirement(" ".join(text.split()), parts[1].lower(), limit, band, (parts[3], limit / float(parts[2])))
