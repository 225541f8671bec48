"""One planning problem: a stand, a required motion, quantities computed once from both, and its unknowns.

The unknowns are coefficients of the angles, of harmonics of a period or of modes of splines over a duration, and the
free part of the bias:

phi_s(t) = 2 pi n_s t/T + mean_s + sum_k cos_sk cos(2 pi k t/T) + sin_sk sin(2 pi k t/T), k = 1..H.

As a vector: for each flywheel mean, cos_1, sin_1, cos_2, ..; then the free components of the bias.

The q'' of a finite motion has kinks of its third derivative at the samples; phi'' needs the same kinks, so phi is four
times differentiable there and a polynomial between. Modes are those of a free beam in that space: the first is
constant, and each has a frequency; the search damps by it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline
from scipy.linalg import eigh, null_space

from mahovik.core.motion.functions import Angles, Course, SampledCourse, Samples
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Linear, Norm, PrescribedMotion, flywheel_wrenches, linear, prescribe, residual
from mahovik.use.numeric.se3 import Array

Kind = Literal["spin", "rock", "mixed", "given", "finite", "followed"]
"""Kinds of starts: windings of a periodic motion; of a finite one drawn angles, or motions that follow (12) in time."""

_SMOOTH = 4
"""Derivatives that are continuous at the breaks."""
PINNED_ORDER = 1e12
"""Order of a mode that must not move."""


@dataclass(frozen=True, eq=False)
class Basis:
    """n functions at M times t (s), with two derivatives: (M, n) each; the first function is 1.

    orders  (n): waves of each function in the period or duration
    """

    t: Array
    value: Array
    first: Array
    second: Array
    orders: Array

    @property
    def matrices(self) -> tuple[Array, Array, Array]:
        """Matrices from the waves of one flywheel to its phi, phi', phi''."""
        return self.value, self.first, self.second

    def chain(self, by_phi: Array, by_phi_dot: Array, by_phi_ddot: Array) -> Array:
        """Derivatives by the waves (R M, N n) of R rows per time, from derivatives (M, R, N) by the angles."""
        M, R, N = by_phi.shape
        local = np.stack([by_phi, by_phi_dot, by_phi_ddot], axis=-1).reshape(M, R * N, 3)
        result = local @ np.stack(self.matrices, axis=1)
        return result.reshape(M * R, N * len(self.orders))


def harmonics(period: float, n: int, t: Array) -> Basis:
    """The first n of 1, cos, sin, cos 2, sin 2, ... of a period (s), at times t (M, s)."""
    k = np.arange(1, n // 2 + 1)
    Omega = 2.0 * np.pi / period * k
    c, s = np.cos(np.outer(t, Omega)), np.sin(np.outer(t, Omega))

    def columns(mean: float, cos: Array, sin: Array) -> Array:
        return np.hstack([np.full((len(t), 1), mean), np.stack([cos, sin], axis=2).reshape(len(t), -1)])

    value, first = columns(1.0, c, s), columns(0.0, -s * Omega, c * Omega)
    second = columns(0.0, -c * Omega**2, -s * Omega**2)
    return Basis(t, value, first, second, np.concatenate([[0.0], np.repeat(k.astype(np.float64), 2)]))


@dataclass(frozen=True, eq=False)
class SplineSpace:
    """Splines of a degree on [0, span] with breaks (m + 1, s). Slope 0 at time 0; with `pinned` also value 0.

    The first mode is the constant 1 (if pinned, it is fixed); its coefficient is the mean angle of a motion.
    """

    span: float
    breaks: Array
    degree: int
    pinned: bool

    @cached_property
    def _spline(self) -> BSpline:
        p, inner = self.degree, np.repeat(self.breaks[1:-1], self.degree - _SMOOTH)
        knots = np.concatenate([np.full(p + 1, 0.0), inner, np.full(p + 1, self.span)])
        return BSpline(knots, np.eye(len(knots) - p - 1), p)

    def nodes(self, count: int, at_ends: int = 0) -> tuple[Array, Array]:
        """`count` Gauss points in every interval, `at_ends` more in the first and the last; and their weights (s)."""
        t, weights = [], []
        for k, (a, b) in enumerate(zip(self.breaks[:-1], self.breaks[1:], strict=True)):
            x, w = np.polynomial.legendre.leggauss(count + (at_ends if k in (0, len(self.breaks) - 2) else 0))
            t.append(a + (b - a) / 2.0 * (1.0 + x))
            weights.append((b - a) / 2.0 * w)
        return np.concatenate(t), np.concatenate(weights)

    def even_times(self, count: int, first: float = 0.0) -> Array:
        """`count` times in every interval, the first at this part of a step."""
        inside = (np.arange(count) + first) / count
        return np.asarray((self.breaks[:-1, None] + np.diff(self.breaks)[:, None] * inside).ravel())

    @cached_property
    def _modes(self) -> tuple[Array, Array]:
        """Coefficients (n splines, modes) and order of each mode."""
        t, weight = self.nodes(self.degree + 1)
        value, second = self._spline(t), self._spline(t, 2)
        ends = [self._spline(0.0, 1)] + ([self._spline(0.0)] if self.pinned else [])
        allowed = null_space(np.array(ends))
        value, second = value @ allowed, second @ allowed
        mass, stiff = (x.T @ (weight[:, None] * x) for x in (value, second))
        squares, vectors = eigh(stiff, mass)
        order = np.maximum(squares, 0.0) ** 0.25 * self.span / (2.0 * np.pi)
        modes = allowed @ vectors * np.sqrt(self.span / 2.0)
        constant = np.ones((len(allowed), 1))
        if self.pinned:
            return np.hstack([constant, modes]), np.concatenate([[PINNED_ORDER], order])
        return np.hstack([constant, modes[:, 1:]]), np.concatenate([[0.0], order[1:]])

    @property
    def size(self) -> int:
        """Number of modes."""
        return len(self._modes[1])

    def modes(self, t: Array, n: int | None = None) -> Basis:
        """The first n modes (default all) at times t (M, s) in [0, span]."""
        coefficients, orders = self._modes
        B = [np.asarray(self._spline(t, m) @ coefficients[:, :n]) for m in range(3)]
        return Basis(t, B[0], B[1], B[2], orders[:n])

    def convert(self, waves: Array, other: SplineSpace) -> Array:
        """Coefficients (N, size) here of the function with `waves` (N, n) in a space of lower degree or fewer modes."""
        t, _ = self.nodes(self.degree + 1)
        return self._fit(other.modes(t, waves.shape[1]).value @ waves.T, waves[:, :1])

    def fit(self, table: Samples) -> Array:
        """Coefficients (N, size) nearest to the angles of a table, less its start speed."""
        t, _ = self.nodes(self.degree + 1)
        angles = table.at(t).phi - t[:, None] * table.phi_dot[0]
        return self._fit(angles, table.phi[0][:, None] if self.pinned else None)

    def _fit(self, angles: Array, first: Array | None) -> Array:
        """Coefficients of angles at the nodes; `first` (N, 1): that of the first mode, where it is known."""
        t, weight = self.nodes(self.degree + 1)
        root, value, known = np.sqrt(weight)[:, None], self.modes(t).value, 0
        if first is not None:
            angles, known = angles - first.T, 1
        rest = np.linalg.lstsq(root * value[:, known:], root * angles, rcond=None)[0].T
        return np.asarray(rest if first is None else np.hstack([first, rest]))


@dataclass(frozen=True, eq=False)
class FlywheelMotion:
    """A motion of the flywheels with its bias: the unknowns of the search.

    span     period or duration, s
    winding  (N,) turns per period; of a finite motion the speed at its beginning, in turns per duration
    waves    (N, n): coefficients of the functions of a `Basis`, rad; periodic: mean, cosine, sine, cosine 2, ...
    bias     (6; m, rad)
    """

    span: float
    winding: Array
    waves: Array
    bias: Array

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return len(self.waves)

    @property
    def mean(self) -> Array:
        """Mean angles (N,), rad."""
        return self.waves[:, 0]

    @property
    def H(self) -> int:
        """Highest harmonic of a periodic motion."""
        return int(self.waves.shape[1]) // 2

    def with_waves(self, n: int) -> FlywheelMotion:
        """The same motion with n functions: new coefficients are zero, those beyond n are dropped."""
        return replace(self, waves=np.pad(self.waves[:, :n], ((0, 0), (0, max(0, n - self.waves.shape[1])))))

    def with_harmonics(self, H: int) -> FlywheelMotion:
        """The same periodic motion with H harmonics."""
        return self.with_waves(2 * H + 1)

    def step(self, step: Array, free: Array) -> FlywheelMotion:
        """The motion after a step of the unknowns; `free` (6, bool): which components of the bias are unknowns."""
        n = self.waves.size
        bias = self.bias.copy()
        bias[free] += step[n:]
        return replace(self, waves=self.waves + step[:n].reshape(self.waves.shape), bias=bias)

    def at(self, basis: Basis) -> Angles:
        """Angles at the times of the basis."""
        rate = 2.0 * np.pi / self.span * self.winding
        phi, phi_dot, phi_ddot = ((B @ self.waves.T) for B in basis.matrices)
        return Angles(phi + basis.t[:, None] * rate, phi_dot + rate, phi_ddot)


def uniform(period: float, M: int, shift: float = 0.0) -> Array:
    """M times of one period; `shift` (in intervals) is the first one."""
    return np.asarray((np.arange(M) + shift) * (period / M))


EXACT = 1e-6
"""Relative residual up to which a programme is accepted."""
EXACT_WITH_KINKS = 1e-5
"""EXACT with |V| in the damping laws: their second derivative jumps, so Fourier coefficients fall slowly."""

_STEP = 1e-6
"""m, rad: step of the differences by the bias."""
DEGREES = (5, 7, 9, 11, 13)
"""Spline degrees of finite motions, in the order tried."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Times with the carrier's course and the functions of the flywheels at them."""

    t: Array
    course: Course
    basis: Basis


@dataclass(frozen=True, eq=False)
class Problem:
    """Data of a search.

    free       (6, bool): components of the bias that are unknowns; of a held carrier m, as are all rows
    tolerance  relative residual below which a programme is accepted
    """

    stand: Stand
    motion: RequiredMotion
    mechanics: Mechanics
    norm: Norm
    free: Array
    tolerance: float
    _grids: dict[tuple[int, int, float], Grid] = field(default_factory=dict)
    _spaces: dict[tuple[int, int], SplineSpace] = field(default_factory=dict)

    @staticmethod
    def of(stand: Stand, motion: RequiredMotion) -> Problem:
        """The problem of a stand and a motion. StateError: a law is undefined on the way."""
        mechanics = Mechanics.of(stand)
        M = max(256, 16 * max(motion.harmonics, default=1))
        demanded = prescribe(mechanics, motion.at(uniform(motion.span, M)))
        free = np.array(motion.free_mean, dtype=bool)
        if motion.bounds.bias is not None:
            free &= np.array(motion.bounds.bias) > 0.0
        return Problem(
            stand,
            motion,
            mechanics,
            Norm.of(demanded, motion.span),
            free,
            EXACT_WITH_KINKS if stand.has_kinks else EXACT,
        )

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return self.mechanics.N

    @property
    def rows_count(self) -> int:
        """Rows of the residual: six, or as many as a held carrier has freedoms; the bias has as many components."""
        return len(self.norm.root)

    @property
    def has_kinks(self) -> bool:
        """Whether forces have kinks, so that sums over few nodes alias."""
        return self.tolerance == EXACT_WITH_KINKS

    @property
    def highest(self) -> int:
        """Highest harmonic of the motion, at least 1."""
        return max(self.motion.harmonics, default=1)

    def grid(self, M: int, n: int, shift: float = 0.0) -> Grid:
        """M uniform times, the first at `shift` intervals, with n functions; cached.

        Of a finite motion with modes of the lowest degree, in the middle of the intervals without a shift.
        """
        key = (M, n, shift)
        if key not in self._grids:
            span, periodic = self.motion.span, self.motion.periodic
            t = uniform(span, M, shift if periodic else shift or 0.5)
            basis = harmonics(span, n, t) if periodic else self.splines(DEGREES[0]).modes(t, n)
            self._grids[key] = Grid(t, self.motion.at(t), basis)
        return self._grids[key]

    def splines(self, degree: int, parts: int = 1) -> SplineSpace:
        """Splines of a degree, with breaks at the samples of a finite motion and `parts` intervals between two."""
        if (degree, parts) not in self._spaces:
            course = self.motion.course
            breaks = course.t if isinstance(course, SampledCourse) else np.linspace(0.0, self.motion.span, 13)
            rows = np.arange(len(breaks))
            breaks = np.interp(np.arange(parts * rows[-1] + 1) / parts, rows, breaks) if parts > 1 else breaks
            pinned = self.motion.bounds.start.phi is not None
            self._spaces[degree, parts] = SplineSpace(self.motion.span, breaks, degree, pinned)
        return self._spaces[degree, parts]

    def grid_of(self, space: SplineSpace, t: Array) -> Grid:
        """All modes of a space at given times."""
        return Grid(t, self.motion.at(t), space.modes(t))

    def rows(self, grid: Grid, motion: FlywheelMotion) -> Array:
        """Relative residual (M, 6) of a flywheel motion at the times of a grid."""
        return self.scaled_residual(grid, motion.bias, motion.at(grid.basis))

    def scaled_residual(self, grid: Grid, bias: Array, angles: Angles) -> Array:
        """Relative residual (M, 6) at given angles and bias."""
        return self.norm.dimensionless(residual(prescribe(self.mechanics, grid.course, bias), *angles))

    def linear(self, grid: Grid, motion: FlywheelMotion) -> Linear:
        """R, tau and their derivatives at the times of a grid, unscaled."""
        return linear(prescribe(self.mechanics, grid.course, motion.bias), *motion.at(grid.basis))

    def bias_perturbations(self, course: Course, bias: Array) -> BiasPerturbations:
        """Prescribed coefficients on both sides of a bias, for differences by its free components."""
        moved = np.flatnonzero(self.free)
        one = np.eye(self.rows_count)[moved] * _STEP
        steps, M = np.vstack([one, -one]), len(course.q)
        tiled = Course(*(np.tile(x, (2 * len(moved), 1)) for x in course))
        at = prescribe(self.mechanics, tiled, bias + np.repeat(steps, M, axis=0))
        return BiasPerturbations(self, moved, at)

    def by_bias(self, grid: Grid, motion: FlywheelMotion) -> Array:
        """Derivatives (6 M, F) of the scaled residual by the free components of the bias."""
        R, _ = self.bias_perturbations(grid.course, motion.bias).rates(motion.at(grid.basis))
        return R[..., self.free].reshape(self.rows_count * len(grid.t), -1)

    def relative(self, motion: FlywheelMotion, times: int = 20) -> float:
        """Relative residual on a grid `times` finer than the motion's harmonics need, without repeated times."""
        return self.largest(self.grid(times * (2 * motion.H + 2), 2 * motion.H + 1, 0.381966), motion)

    def largest(self, grid: Grid, motion: FlywheelMotion) -> float:
        """Largest relative residual at the times of a grid."""
        return float(np.linalg.norm(self.rows(grid, motion), axis=1).max())


class BiasPerturbations(NamedTuple):
    """Prescribed at 2 F shifts of the bias, first forth and then back, of its F free `components`."""

    problem: Problem
    components: NDArray[np.intp]
    at: PrescribedMotion

    def rates(self, angles: Angles) -> tuple[Array, Array]:
        """Derivatives of the relative residual (M, 6, 6) and of tau (M, N, 6) by the bias; fixed components: 0."""
        F, (M, N), m = len(self.components), angles.phi.shape, self.problem.rows_count
        R, tau = np.zeros((M, m, m)), np.zeros((M, N, m))
        if F == 0:
            return R, tau
        W = flywheel_wrenches(self.at, *(np.tile(x, (2 * F, 1)) for x in angles))
        sides = self.problem.norm.dimensionless(self.at.balance - W[:6].sum(axis=2).T).reshape(2, F, M, m)
        R[..., self.components] = np.moveaxis((sides[0] - sides[1]) / (2 * _STEP), 0, 2)
        torque = W[6].reshape(2, F, M, N)
        tau[..., self.components] = np.moveaxis((torque[0] - torque[1]) / (2 * _STEP), 0, 2)
        return R, tau
