"""One planning problem: a stand, a required motion, quantities computed once from both, and its unknowns.

The unknowns are coefficients of the angles, of harmonics of a period or of modes of splines over a duration, and the
free part of the bias:

phi_s(t) = 2 pi n_s t/T + mean_s + sum_k cos_sk cos(2 pi k t/T) + sin_sk sin(2 pi k t/T), k = 1..H.

As a vector: for each flywheel mean, cos_1, sin_1, cos_2, ..; then the free components of the bias.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Angles, Course, SampledCourse
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Linear, Norm, PrescribedMotion, flywheel_wrenches, linear, prescribe, residual
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.basis import Basis, SplineSpace, harmonics


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
