"""One planning problem: a stand, a required motion, quantities computed once from both, and its periodic unknowns.

The unknowns are Fourier coefficients of the angles, and the free part of the bias:

phi_s(t) = 2 pi n_s t/T + mean_s + sum_k cos_sk cos(2 pi k t/T) + sin_sk sin(2 pi k t/T), k = 1..H.

As a vector: for each flywheel mean, cos_1 .. cos_H, sin_1 .. sin_H; then the free components of the bias.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mahovik.core.motion.functions import Angles, Course
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import Linear, Norm, PrescribedMotion, flywheel_wrenches, linear, prescribe, residual
from mahovik.use.numeric.se3 import Array


@dataclass(frozen=True, eq=False)
class Periodic:
    """A periodic flywheel motion with its bias: the unknowns of the search.

    period   T, s
    winding  (N,) turns per period
    waves    (N, 2H + 1): mean, cosines, sines of each flywheel, rad
    bias     (6; m, rad)
    """

    period: float
    winding: Array
    waves: Array
    bias: Array

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return len(self.waves)

    @property
    def H(self) -> int:
        """Highest harmonic."""
        return int(self.waves.shape[1]) // 2

    def with_harmonics(self, H: int) -> Periodic:
        """The same motion with H harmonics: new ones are zero, those above H are dropped."""
        wide = np.zeros((self.N, 2 * H + 1))
        kept = min(H, self.H)
        wide[:, : kept + 1] = self.waves[:, : kept + 1]
        wide[:, H + 1 : H + 1 + kept] = self.waves[:, self.H + 1 : self.H + 1 + kept]
        return replace(self, waves=wide)

    def step(self, step: Array, free: Array) -> Periodic:
        """The motion after a step of the unknowns; `free` (6, bool): which components of the bias are unknowns."""
        n = self.waves.size
        bias = self.bias.copy()
        bias[free] += step[n:]
        return replace(self, waves=self.waves + step[:n].reshape(self.waves.shape), bias=bias)

    def at(self, basis: Basis) -> Angles:
        """Angles at the times of the basis."""
        rate = 2.0 * np.pi / self.period * self.winding
        phi, phi_dot, phi_ddot = ((B @ self.waves.T) for B in basis.matrices)
        return Angles(phi + basis.t[:, None] * rate, phi_dot + rate, phi_ddot)

    @property
    def mean(self) -> Array:
        """Mean angles (N,), rad."""
        return self.waves[:, 0]

    @property
    def cos(self) -> Array:
        """Cosine amplitudes (H, N), rad, in the layout of the programme file."""
        return self.waves[:, 1 : self.H + 1].T

    @property
    def sin(self) -> Array:
        """Sine amplitudes (H, N), rad."""
        return self.waves[:, self.H + 1 :].T


@dataclass(frozen=True, eq=False)
class Basis:
    """1, cosines, sines of harmonics 1..H at M times, with two derivatives: (M, 2H + 1) each."""

    period: float
    t: Array
    value: Array
    first: Array
    second: Array

    @property
    def matrices(self) -> tuple[Array, Array, Array]:
        """Matrices from the waves of one flywheel to its phi, phi', phi''."""
        return self.value, self.first, self.second

    @property
    def orders(self) -> Array:
        """Harmonic of each unknown of a flywheel (2H + 1)."""
        H = self.value.shape[1] // 2
        return np.concatenate([[0.0], np.arange(1.0, H + 1), np.arange(1.0, H + 1)])

    @staticmethod
    def of(period: float, H: int, t: Array) -> Basis:
        """The basis of harmonics up to H at times t (M, s)."""
        k = np.arange(1, H + 1)
        Omega = 2.0 * np.pi / period * k
        c, s = np.cos(np.outer(t, Omega)), np.sin(np.outer(t, Omega))
        one, none = np.ones((len(t), 1)), np.zeros((len(t), 1))
        return Basis(
            period,
            t,
            np.hstack([one, c, s]),
            np.hstack([none, -s * Omega, c * Omega]),
            np.hstack([none, -c * Omega**2, -s * Omega**2]),
        )

    def chain(self, by_phi: Array, by_phi_dot: Array, by_phi_ddot: Array) -> Array:
        """Derivatives by the waves (R M, N (2H + 1)) of R rows per time, from derivatives (M, R, N) by the angles."""
        M, R, N = by_phi.shape
        local = np.stack([by_phi, by_phi_dot, by_phi_ddot], axis=-1).reshape(M, R * N, 3)
        result = local @ np.stack([self.value, self.first, self.second], axis=1)
        return result.reshape(M * R, N * self.value.shape[1])


def uniform(period: float, M: int, shift: float = 0.0) -> Array:
    """M times of one period; `shift` (in intervals) is the first one."""
    return np.asarray((np.arange(M) + shift) * (period / M))


EXACT = 1e-6
"""Relative residual up to which a programme is accepted."""
EXACT_WITH_KINKS = 1e-5
"""EXACT with |V| in the damping laws: their second derivative jumps, so Fourier coefficients fall slowly."""

_STEP = 1e-6
"""m, rad: step of the differences by the bias."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Uniform times of a period with the carrier's course and the basis of H harmonics at them."""

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

    def grid(self, M: int, H: int, shift: float = 0.0) -> Grid:
        """M uniform times, the first at `shift` intervals, with H harmonics; cached."""
        key = (M, H, shift)
        if key not in self._grids:
            t = uniform(self.motion.span, M, shift)
            self._grids[key] = Grid(t, self.motion.at(t), Basis.of(self.motion.span, H, t))
        return self._grids[key]

    def rows(self, grid: Grid, motion: Periodic) -> Array:
        """Relative residual (M, 6) of a flywheel motion at the times of a grid."""
        return self.scaled_residual(grid, motion.bias, motion.at(grid.basis))

    def scaled_residual(self, grid: Grid, bias: Array, angles: Angles) -> Array:
        """Relative residual (M, 6) at given angles and bias."""
        return self.norm.dimensionless(residual(prescribe(self.mechanics, grid.course, bias), *angles))

    def linear(self, grid: Grid, motion: Periodic) -> tuple[PrescribedMotion, Linear]:
        """R, tau and their derivatives at the times of a grid, unscaled."""
        at = prescribe(self.mechanics, grid.course, motion.bias)
        return at, linear(at, *motion.at(grid.basis))

    def bias_perturbations(self, course: Course, bias: Array) -> BiasPerturbations:
        """Prescribed coefficients on both sides of a bias, for differences by its free components."""
        moved = np.flatnonzero(self.free)
        one = np.eye(self.rows_count)[moved] * _STEP
        steps, M = np.vstack([one, -one]), len(course.q)
        tiled = Course(*(np.tile(x, (2 * len(moved), 1)) for x in course))
        at = prescribe(self.mechanics, tiled, bias + np.repeat(steps, M, axis=0))
        return BiasPerturbations(self, moved, at)

    def by_bias(self, grid: Grid, motion: Periodic) -> Array:
        """Derivatives (6 M, F) of the scaled residual by the free components of the bias."""
        R, _ = self.bias_perturbations(grid.course, motion.bias).rates(motion.at(grid.basis))
        return R[..., self.free].reshape(self.rows_count * len(grid.t), -1)

    def relative(self, motion: Periodic, times: int = 20) -> float:
        """Relative residual on a grid `times` finer than the motion's harmonics need, without repeated times."""
        M = times * (2 * motion.H + 2)
        grid = self.grid(M, motion.H, 0.381966)
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
