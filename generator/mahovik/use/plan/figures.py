"""Figures of a periodic programme for its report: residual, peaks, smallest singular value."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import Angles, Periodic
from mahovik.use.plan.problem import Grid, Problem
from mahovik.use.plan.residual import Mechanics, prescribe, torques
from mahovik.use.plan.residual.flywheels import waves


@dataclass(frozen=True, eq=False)
class Figures:
    """Figures of a motion. residual: largest relative one between the nodes. speed, acceleration, torque: peaks (N).

    \n    sigma         least singular value of K^-1/2 I Theta_ff^-1/2 along the way
        sign_changes  of det I in a period; None unless there are six flywheels
    """

    residual: float
    speed: Array
    acceleration: Array
    torque: Array
    sigma: float
    sign_changes: int | None


def figures(problem: Problem, motion: Periodic) -> Figures:
    """Figures on a grid 20 times finer than the motion's harmonics need."""
    grid = problem.grid(20 * (2 * motion.H + 2), motion.H, 0.5)
    angles = motion.at(grid.basis)
    sigma, determinants = singular_values(problem.mechanics, angles.phi)
    return Figures(
        problem.relative(motion),
        np.abs(angles.phi_dot).max(axis=0),
        np.abs(angles.phi_ddot).max(axis=0),
        np.abs(torques_on(problem, grid, motion, angles)).max(axis=0),
        float(sigma.min()) if sigma.size else 0.0,
        None if determinants is None else int(np.sum(determinants * np.roll(determinants, 1) < 0.0)),
    )


def torques_on(problem: Problem, grid: Grid, motion: Periodic, angles: Angles) -> Array:
    """Drive torques (M, N; N m) at the times of a grid."""
    return torques(prescribe(problem.mechanics, grid.course, motion.bias), *angles)


def singular_values(own: Mechanics, phi: Array) -> tuple[Array, Array | None]:
    """min(6, N) singular values of K^-1/2 I Theta_ff^-1/2 (M, .) at angles (M, N), and its determinant where N = 6.

    The determinant is of G^-1 I Theta_ff^-1/2 with K = G G^T: its sign is that of det I.
    """
    K, I = mass_and_coupling(own, phi)
    scaled = np.linalg.solve(np.linalg.cholesky(K), I / np.sqrt(own.tables.Theta_ff))
    determinants = np.linalg.det(scaled) if own.N == 6 else None
    return np.linalg.svd(scaled, compute_uv=False), determinants


def mass_and_coupling(own: Mechanics, phi: Array) -> tuple[Array, Array]:
    """K of (2) (M, 6, 6) and I of (9) (M, 6, N) at angles (M, N; rad), in E1 about O1."""
    h, _ = waves(phi)
    K = own.housing.K + np.einsum("hmn,hnij->mij", h, own.tables.Theta)
    return K, np.einsum("hmn,hni->min", h, own.tables.coupling)
