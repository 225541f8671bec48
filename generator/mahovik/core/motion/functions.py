"""Functions of time that files give, with exact derivatives: Fourier sums, tables with quintics between, splines."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import any_list, echo, list_item, rows, validator, vector
from mahovik.core.stand.tables import Context, Data, Problems, QuantityValidator
from mahovik.core.stand.units import PLAIN, TIME, Dimension, QuantityError, number

Array = NDArray[np.float64]

Motion = tuple[Array, Array, Array]
"""Value, first and second derivative at the times asked for; numbers of one time in a row where there are several."""

_PRESENT = 1e-9
"""Smallest harmonic of a spline that counts, as a part of the largest."""


# -- types of keys: one that depends on the stand finds the number of its flywheels in the context, as `flywheels` -----


def per_flywheel(
    dimension: Dimension, check: Callable[[float, Any], object] = lambda value, raw: None
) -> QuantityValidator:
    """A validator of one number for all flywheels, or a list with one for each.

    `check` takes a number in SI and as it stands in the file, and raises QuantityError.
    """

    def read(raw: Any, context: Context) -> tuple[float, ...]:
        N = context["flywheels"]
        if isinstance(raw, list) or (isinstance(raw, dict) and isinstance(raw.get("value"), list)):
            values = vector(raw, (N,), dimension)
            for i, value in enumerate(values):
                try:
                    check(value, list_item(raw, i))
                except QuantityError as error:
                    raise QuantityError(f"[{i}]: {error}") from None
            return values
        check(value := number(raw, dimension), raw)
        return (value,) * int(N)

    return QuantityValidator(read)


def bound_per_flywheel(dimension: Dimension, zero: bool = False) -> QuantityValidator:
    """A validator of a magnitude that is not exceeded, for all flywheels or for each; `zero`: it may be zero."""

    def check(value: float, raw: Any) -> None:
        if value < 0.0 or (value == 0.0 and not zero):
            written = echo(raw, value, dimension.si) or f"{value:g}"
            raise QuantityError(f"{written} is not above 0: a bound is a magnitude")

    return per_flywheel(dimension, check)


def numbers_of_flywheels(axes: int) -> QuantityValidator:
    """A validator of an array (N) of plain numbers, or with two axes (M, N)."""

    def read(raw: Any, context: Context) -> Any:
        lengths = (context["flywheels"],)
        if axes == 1:
            return np.array(vector(raw, lengths, PLAIN), dtype=np.float64)
        numbers = rows(raw, lambda row: vector(row, lengths, PLAIN))
        return np.array(numbers, dtype=np.float64).reshape(len(numbers), *lengths)

    return QuantityValidator(read)


def six_numbers() -> QuantityValidator:
    """A validator of an array (M, 6) of plain numbers."""
    return validator(lambda raw: np.array(rows(raw, lambda row: vector(row, (6,), PLAIN))).reshape(-1, 6))


def times() -> QuantityValidator:
    """A validator of an array (M) of times, s."""
    return validator(lambda raw: np.array(vector(raw, (len(any_list(raw)),), TIME)))


# -- functions ---------------------------------------------------------------------------------------------------------


class Course(NamedTuple):
    """q and its derivatives, each (M, 6): O1 in E0 (m), then psi, theta, phi (rad) in the stand's sequence."""

    q: Array
    q_dot: Array
    q_ddot: Array


class Angles(NamedTuple):
    """phi, phi', phi'' of the flywheels (M, N each; rad, s)."""

    phi: Array
    phi_dot: Array
    phi_ddot: Array


def fourier_sum(t: Array, period: float, k: Array, cos: Array, sin: Array) -> Motion:
    """sum_k cos_k cos(2 pi k t/T) + sin_k sin(2 pi k t/T) at the times t (M, s); k (H), cos and sin (H, columns)."""
    omega = 2 * np.pi * k / period
    angle = 2 * np.pi * ((t / period)[:, None] * k % 1.0)  # small angles: no digits lost at large t
    c, s = np.cos(angle), np.sin(angle)
    second = -((c * omega**2) @ cos + (s * omega**2) @ sin)
    return c @ cos + s @ sin, (c * omega) @ sin - (s * omega) @ cos, second


@dataclass(frozen=True, eq=False)
class Fourier(Data):
    """Periodic part of phi, rad: `mean` (N), `cos`, `sin` (H, N), row k - 1 of harmonic k."""

    mean: Annotated[Array, numbers_of_flywheels(1)]
    cos: Annotated[Array, numbers_of_flywheels(2)]
    sin: Annotated[Array, numbers_of_flywheels(2)]

    def at(self, t: Array, period: float) -> Angles:
        """The mean with the harmonics of the period at the times t (M, s), without the winding."""
        phi, phi_dot, phi_ddot = fourier_sum(t, period, np.arange(1.0, len(self.cos) + 1.0), self.cos, self.sin)
        return Angles(self.mean + phi, phi_dot, phi_ddot)


@dataclass(frozen=True, eq=False)
class Harmonics:
    """Harmonics of a course over `period` (s): `k` (H,) whole numbers; `cos`, `sin` (H, 6), m and rad."""

    period: float
    k: tuple[int, ...]
    cos: Array
    sin: Array

    def at(self, t: Array) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s)."""
        return Course(*fourier_sum(t, self.period, np.array(self.k, dtype=np.float64), self.cos, self.sin))

    @property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers of the harmonics with an amplitude, rising."""
        there = np.any(self.cos != 0.0, axis=1) | np.any(self.sin != 0.0, axis=1)
        return tuple(sorted(k for k, yes in zip(self.k, there, strict=True) if yes))


@dataclass(frozen=True, eq=False)
class _QuinticTable(Data):
    """A table of a function and its derivatives at times, quintic Hermite between; its ends hold beyond it."""

    t: Annotated[Array, times()]

    @property
    def columns(self) -> dict[str, Array]:
        """The function and its derivatives (M, components each), by the keys of the file."""
        return {field.name: getattr(self, field.name) for field in fields(self)[1:]}

    @cached_property
    def _pieces(self) -> tuple[Any, Any, Any]:
        """Each interval beside its first row at constant speed: angles of many turns would cost digits of phi''."""
        from scipy.interpolate import BPoly

        x, x_dot, x_ddot = self.columns.values()
        h, speed = np.diff(self.t)[:, None], x_dot[:-1]
        end, gained = np.diff(x, axis=0) - speed * h, np.diff(x_dot, axis=0)
        first, last = h**2 / 20.0 * x_ddot[:-1], h**2 / 20.0 * x_ddot[1:]
        none = np.zeros_like(end)
        bernstein = [none, none, first, end - 0.4 * h * gained + last, end - 0.2 * h * gained, end]
        piece = BPoly(np.array(bernstein), self.t)
        return piece, piece.derivative(1), piece.derivative(2)

    def _motion(self, t: Array) -> Motion:
        """The function and its derivatives at the times t (M, s)."""
        x, x_dot, _ = self.columns.values()
        inside = np.clip(t, self.t[0], self.t[-1])
        k = np.clip(np.searchsorted(self.t, inside, side="right") - 1, 0, len(self.t) - 2)
        aside, faster, acceleration = (piece(inside) for piece in self._pieces)
        return x[k] + x_dot[k] * (inside - self.t[k])[:, None] + aside, x_dot[k] + faster, acceleration

    def check(self, problems: Problems, span: float, periodic: bool, *path: str) -> None:
        """Note what is wrong with a table of a file over a period or a duration, `span` s."""
        for key, column in self.columns.items():
            if len(column) != len(self.t):
                problems.add(*path, key, f"{len(column)} rows, but t has {len(self.t)} numbers")
                return
        t, end = self.t, span * 1e-9
        back = np.flatnonzero(np.diff(t) <= 0.0)
        covers = f"covers {t[0]:.9g} to {t[-1]:.9g} s, expected 0 to" if len(t) else ""
        if len(t) < 2:
            problems.add(*path, "t", f"{len(t)} numbers, expected at least 2")
        elif len(back):
            i = int(back[0]) + 1
            problems.add(*path, "t", f"[{i}]: {t[i]:.9g} s is not after {t[i - 1]:.9g} s")
        elif periodic and (t[0] < 0.0 or t[-1] - t[0] > span - end):
            problems.add(*path, "t", f"{covers} less than a period, {span:g} s: t = T is left out")
        elif not periodic and (t[0] != 0.0 or abs(t[-1] - span) > end):
            problems.add(*path, "t", f"{covers} the duration, {span:g} s")


@dataclass(frozen=True, eq=False)
class Samples(_QuinticTable):
    """phi, phi', phi'' (M, N each; rad, s) at t (M, s), which rise. A periodic table omits t = T."""

    phi: Annotated[Array, numbers_of_flywheels(2)]
    phi_dot: Annotated[Array, numbers_of_flywheels(2)]
    phi_ddot: Annotated[Array, numbers_of_flywheels(2)]

    def at(self, t: Array) -> Angles:
        """phi, phi', phi'' (M, N each) at the times t (M, s)."""
        return Angles(*self._motion(t))

    def over_whole_period(self, period: float, turn: Array) -> Samples:
        """The table with its first row repeated one period later, `turn` (N, rad) further on."""
        phi, *rates = (np.vstack([column, column[:1]]) for column in self.columns.values())
        phi[-1] += turn
        return Samples(np.append(self.t, self.t[0] + period), phi, *rates)


@dataclass(frozen=True, eq=False)
class PlannedCourse(_QuinticTable):
    """A course that a planner found, as a programme keeps it: q, q', q'' (M, 6 each) at t (M, s), which rise from 0."""

    q: Annotated[Array, six_numbers()]
    q_dot: Annotated[Array, six_numbers()]
    q_ddot: Annotated[Array, six_numbers()]

    harmonics: ClassVar[tuple[int, ...]] = ()
    """None: the course is finite."""

    def at(self, t: Array) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s)."""
        return Course(*self._motion(t))


@dataclass(frozen=True, eq=False)
class SampledCourse:
    """Quintic spline through samples q (M, 6) at t (M, s) over `span` s: periodic, or from rest to rest.

    Rest: q' = q'' = 0 at both ends of a finite course; outside it nothing moves. groups: columns of one unit each.
    """

    span: float
    periodic: bool
    t: Array
    q: Array
    groups: tuple[tuple[int, ...], ...] = ((0, 1, 2), (3, 4, 5))

    @cached_property
    def _splines(self) -> tuple[Any, Any, Any]:
        spline = quintic_spline(self.t, self.q, self.span if self.periodic else None)
        return spline, spline.derivative(1), spline.derivative(2)

    def at(self, t: Array) -> Course:
        """q, q', q'' (M, 6 each) at the times t (M, s)."""
        if self.periodic:
            inside = self.t[0] + (t - self.t[0]) % self.span
            return Course(*(spline(inside) for spline in self._splines))
        inside = np.clip(t, 0.0, self.span)
        moving = ((t >= 0.0) & (t <= self.span))[:, None]
        q, q_dot, q_ddot = (spline(inside) for spline in self._splines)
        return Course(q, np.where(moving, q_dot, 0.0), np.where(moving, q_ddot, 0.0))

    @cached_property
    def harmonics(self) -> tuple[int, ...]:
        """Numbers of the harmonics above 1e-9 of the largest in metres or in radians; none for a finite course.

        Below half the number of samples: beyond it are images that the spline makes of lower ones.
        """
        if not self.periodic:
            return ()
        M = 16 * len(self.t)
        amplitudes = np.abs(np.fft.rfft(self.at(self.span * np.arange(M) / M).q, axis=0))[1 : (len(self.t) + 1) // 2]
        there = np.zeros(len(amplitudes), dtype=bool)
        for kind in (amplitudes[:, list(group)] for group in self.groups):
            there |= np.any(kind > _PRESENT * kind.max(), axis=1) if kind.any() else False
        return tuple((np.flatnonzero(there) + 1).tolist())


def quintic_spline(t: Array, q: Array, period: float | None) -> Any:
    """SciPy's quintic spline through samples: periodic, of samples without t = T; or at rest at both ends."""
    from scipy.interpolate import make_interp_spline

    if period is None:
        zero = np.zeros(q.shape[1])
        rest = [(1, zero), (2, zero)]
        return make_interp_spline(t, q, k=5, bc_type=(rest, rest))
    return make_interp_spline(np.append(t, t[0] + period), np.vstack([q, q[:1]]), k=5, bc_type="periodic")
