"""Function that the optimiser minimises, and its constraints, at one flywheel motion.

Minimised: half the mean square of objective rows, hinge rows of the bounds, and residual harmonics H + 1..2H times
TAIL. Zero: residual harmonics 0..H (Galerkin). Both with derivatives by the waves and the free bias.

Harmonics come from samples by FFT. For a real R(t) at M uniform times the rows are R_0, sqrt(2) Re R_j, sqrt(2) Im R_j,
for harmonics j of a range: the sum of their squares is the mean square of those harmonics. A wave cos or sin
(k Omega t) of a flywheel moves the harmonics j - k and j + k of dR/dphi, dR/dphi', dR/dphi'' to j: no product of
matrices is needed.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.core.motion.functions import Angles
from mahovik.use.numeric import Array, Complex, Linear, PrescribedMotion, flywheel_wrenches, linear, prescribe
from mahovik.use.plan.objective import Cost, Rows, bias_hinges, gauss_newton_sums, hinge_rows, utilisation
from mahovik.use.plan.problem import BiasPerturbations, Grid, Periodic, Problem


def harmonic_coefficients(R: Array, first: int, last: int) -> Array:
    """Rows of R (M, 6) for harmonics first..last; 2 last < M."""
    return harmonic_rows(np.fft.rfft(R, axis=0)[first : last + 1] / len(R), first)


def harmonic_rows(spectrum: Complex, first: int) -> Array:
    """Real rows of complex coefficients (J, 6, ...) of harmonics `first` and on; for the mean, the real part only."""
    double = np.sqrt(2.0)
    mean = 1 if first == 0 else 0
    parts = [spectrum[:mean].real, double * spectrum[mean:].real, double * spectrum[mean:].imag]
    return np.concatenate([x.reshape(-1, *spectrum.shape[2:]) for x in parts])


def harmonic_derivatives(
    by_phi: Array, by_phi_dot: Array, by_phi_ddot: Array, Omega: float, H: int, last: int
) -> Complex:
    """Harmonics 0..last (last + 1, 6, N (2H + 1)) of the change of R by each wave; by_... are (M, 6, N).

    Omega: 2 pi over the period, rad/s. Waves of a flywheel: mean, cosines 1..H, sines 1..H.
    """
    M, R, N = by_phi.shape
    A, B, C = (np.fft.fft(x, axis=0) / M for x in (by_phi, by_phi_dot, by_phi_ddot))
    j, k = np.arange(last + 1)[:, None], np.arange(H + 1)[None, :]
    rate = (Omega * np.arange(H + 1))[None, :, None, None]
    below, above = (j - k) % M, (j + k) % M
    up = A[below] + 1j * rate * B[below] - rate**2 * C[below]
    down = A[above] - 1j * rate * B[above] - rate**2 * C[above]  # (last + 1, H + 1, 6, N)
    found = np.empty((last + 1, R, N, 2 * H + 1), dtype=np.complex128)
    found[..., : H + 1] = np.moveaxis((up + down) / 2.0, 1, 3)
    found[..., H + 1 :] = np.moveaxis((up - down)[:, 1:] / 2j, 1, 3)
    return found.reshape(last + 1, R, N * (2 * H + 1))


@dataclass(frozen=True, eq=False)
class Stage:
    """Evaluation of a point: grid and harmonics, and weights of the rows.

    tail        weight of residual harmonics H + 1..2H
    objective   weight of the objective rows; small while bounds are exceeded
    wider       limits are this many times those of the bounds
    """

    problem: Problem
    cost: Cost
    grid: Grid
    H: int
    tail: float
    objective: float = 1.0
    wider: float = 1.0

    @property
    def Omega(self) -> float:
        """2 pi over the period, rad/s."""
        return 2.0 * np.pi / self.problem.motion.span

    def at(self, motion: Periodic) -> Point:
        """The point of a motion with H harmonics."""
        prescribed = prescribe(self.problem.mechanics, self.grid.course, motion.bias)
        return Point(self, motion, motion.at(self.grid.basis), prescribed)


@dataclass(frozen=True, eq=False)
class Model:
    """Linear and quadratic model at a point, n unknowns.

    c, A        constraints (6 (2H + 1)) and derivatives
    gradient, curvature   of the minimised function
    """

    c: Array
    A: Array
    gradient: Array
    curvature: Array


@dataclass(frozen=True, eq=False)
class Point:
    """A flywheel motion evaluated in a stage."""

    stage: Stage
    motion: Periodic
    angles: Angles
    prescribed: PrescribedMotion

    @cached_property
    def linear(self) -> Linear:
        """(12) and torques with derivatives."""
        return linear(self.prescribed, *self.angles)

    @cached_property
    def _wrenches(self) -> Array:
        return flywheel_wrenches(self.prescribed, *self.angles)

    @property
    def tau(self) -> Array:
        """Drive torques (M, N; N m)."""
        return np.asarray(self._wrenches[6])

    @property
    def swing(self) -> Array:
        """phi less its winding and its mean (M, N; rad)."""
        return np.asarray(self.stage.grid.basis.value[:, 1:] @ self.motion.waves[:, 1:].T)

    @cached_property
    def relative_residual(self) -> Array:
        """Relative residual (M, 6)."""
        return self.stage.problem.norm.dimensionless(self.prescribed.balance - self._wrenches[:6].sum(axis=2).T)

    @cached_property
    def c(self) -> Array:
        """Residual harmonics 0..H."""
        return harmonic_coefficients(self.relative_residual, 0, self.stage.H)

    @cached_property
    def tail(self) -> Array:
        """Residual harmonics H + 1..2H, weighted."""
        return self.stage.tail * harmonic_coefficients(self.relative_residual, self.stage.H + 1, 2 * self.stage.H)

    def _kinds(self, torque: Rows) -> list[Rows]:
        stage = self.stage
        speed = stage.Omega * self.motion.winding
        wanted = stage.cost.rows(self.angles, speed, torque).values() if stage.objective > 0.0 else ()
        bounds = stage.problem.motion.bounds
        kept = hinge_rows(bounds, self.angles, self.swing, torque, self.motion.winding, stage.wider).values()
        return [harmonic_rows.scale(stage.objective) for harmonic_rows in wanted] + [
            harmonic_rows for harmonic_rows in kept if harmonic_rows.value.any()
        ]

    @cached_property
    def value(self) -> float:
        """Half the sum of squares."""
        held, _ = bias_hinges(self.stage.problem.motion.bounds, self.motion.bias)
        whole = sum(harmonic_rows.mean_square for harmonic_rows in self._kinds(Rows.of(self.tau)))
        return (whole + float(held @ held) + float(self.tail @ self.tail)) / 2.0

    @cached_property
    def utilisation(self) -> float:
        """Largest use of any bound at the stage's times; 1 is the limit."""
        bounds = self.stage.problem.motion.bounds
        motion = self.motion
        return utilisation(bounds, self.angles, self.swing, self.tau, motion.bias, motion.winding)

    def model(self, around: BiasPerturbations) -> Model:
        """Derivatives at this point; those by the bias from differences `around` a nearby bias."""
        stage, H = self.stage, self.stage.H
        problem = stage.problem
        free = problem.free
        root = problem.norm.root / problem.norm.demand
        found = self.linear
        a, b, c = (root @ x for x in (found.by_phi, found.by_phi_dot, found.by_phi_ddot))
        spectrum = harmonic_derivatives(a, b, c, stage.Omega, H, 2 * H)
        R_by_bias, tau_by_bias = around.rates(self.angles)
        own = np.fft.rfft(R_by_bias, axis=0)[: 2 * H + 1] / len(self.relative_residual)
        whole = np.concatenate([spectrum, own[..., free]], axis=2)
        A, T = harmonic_rows(whole[: H + 1], 0), stage.tail * harmonic_rows(whole[H + 1 :], H + 1)
        total = gauss_newton_sums(self._kinds(Rows.torque(found, tau_by_bias)), stage.grid.basis, problem.N, free)
        held, slope = bias_hinges(problem.motion.bounds, self.motion.bias)
        gradient = total.gradient + T.T @ self.tail
        curvature = total.curvature + T.T @ T
        n = problem.N * (2 * H + 1)
        gradient[n:] += (held * slope)[free]
        curvature[n:, n:] += np.diag((slope**2)[free])
        return Model(self.c, A, gradient, curvature)
