"""One planning problem: a stand, a required motion, and quantities computed once from both."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mahovik.core.motion.required import Course, RequiredMotion
from mahovik.core.stand.model import Damping, Stand
from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Angles, Basis, Periodic, uniform
from mahovik.use.plan.residual import Linear, Mechanics, Norm, Prescribed, linear, prescribe, residual

EXACT = 1e-6
"""Relative residual up to which a programme is accepted."""
KINKED = 1e-5
"""The same with |V| in the damping laws: their second derivative jumps, so Fourier coefficients fall slowly."""

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

    free       (6, bool): components of the bias that are unknowns
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
            KINKED if any(has_magnitude(body.damping) for body in stand.bodies) else EXACT,
        )

    @property
    def N(self) -> int:
        """Number of flywheels."""
        return self.mechanics.N

    @property
    def kinked(self) -> bool:
        """Whether forces have kinks, so that sums over few nodes alias."""
        return self.tolerance == KINKED

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
        return self.norm.scaled(residual(prescribe(self.mechanics, grid.course, bias), *angles))

    def linear(self, grid: Grid, motion: Periodic) -> tuple[Prescribed, Linear]:
        """R, tau and their derivatives at the times of a grid, unscaled."""
        at = prescribe(self.mechanics, grid.course, motion.bias)
        return at, linear(at, *motion.at(grid.basis))

    def by_bias(self, grid: Grid, motion: Periodic) -> Array:
        """Derivatives (6 M, F) of the scaled residual by the free components of the bias: central differences."""
        F = int(self.free.sum())
        M = len(grid.t)
        steps = np.zeros((2 * F, 6))
        steps[np.arange(F), np.flatnonzero(self.free)] = _STEP
        steps[np.arange(F, 2 * F), np.flatnonzero(self.free)] = -_STEP
        course = Course(*(np.tile(x, (2 * F, 1)) for x in grid.course))
        at = prescribe(self.mechanics, course, motion.bias + np.repeat(steps, M, axis=0))
        angles = (np.tile(x, (2 * F, 1)) for x in motion.at(grid.basis))
        R = self.norm.scaled(residual(at, *angles)).reshape(2 * F, 6 * M)
        return np.asarray((R[:F] - R[F:]).T / (2 * _STEP))

    def relative(self, motion: Periodic, times: int = 20) -> float:
        """Relative residual on a grid `times` finer than the motion's harmonics need, without repeated times."""
        M = times * (2 * motion.H + 2)
        grid = self.grid(M, motion.H, 0.381966)
        return float(np.linalg.norm(self.rows(grid, motion), axis=1).max())


def has_magnitude(damping: Damping | None) -> bool:
    """Whether a damping law contains a magnitude."""
    if damping is None:
        return False
    return damping.quadratic is not None or any(a.absolute for term in damping.terms for a in term.of)
