"""The carrier's course by (8) under given flywheel motions, its rest, and derivatives of both.

A state is y = (x, u): coordinates of the frame and the speeds of V = S u, two numbers for each freedom, with

    S^T K S u* = S^T (K V_r* - K (omega x C^T stream, 0)),    x' = J(x)^-1 u,

K V_r* the wrench on the carrier. What a hold blocks has no number and no equation.

A course is found by collocation at uniform nodes, blocks of four intervals (order 6), and Newton's method for all times
at once. On a block y_j = y_0 + d sum_k a_jk y'_k, j = 1..4, k = 0..4, with a_jk the integrals of the Lagrange
polynomials: all nodes are evaluated together, and only products of small matrices go from block to block. Sums over the
flywheels are computed for all times first, so that the cost does not grow with their number.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import cast

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Course
from mahovik.core.stand.model import State, Vec3, Vec6, rest_state
from mahovik.errors import CheckError, StateError
from mahovik.use.numeric.frame import Frame, Twists, in_E1, in_fluid
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.numeric.residual import (
    Drive,
    Linear,
    drive,
    flywheel_damping,
    linear,
    prescribed_at,
    slopes_of_residual,
)
from mahovik.use.numeric.se3 import Array, motor_cross


@dataclass(frozen=True, eq=False)
class Chart:
    """The equations of a stand in coordinates counted from one pose."""

    mechanics: Mechanics
    frame: Frame

    @staticmethod
    def at(mechanics: Mechanics, q: Array) -> Chart:
        """About the pose of coordinates q (6; of a held carrier m) of a required motion."""
        return Chart(mechanics, mechanics.frame.about(q))

    @property
    def count(self) -> int:
        """Freedoms: as many coordinates and as many speeds are in a state."""
        return len(self.frame.start)

    @cached_property
    def to_speeds(self) -> Array:
        """S^+ (m, 6): u of V = S u."""
        return np.asarray(np.linalg.pinv(self.frame.S))

    def of(self, course: Course) -> Array:
        """y (M, 2 m) of prescribed coordinates q, q' (M, m each)."""
        V = self.mechanics.frame.twists(course).V
        return np.hstack([self.frame.coordinates(course), V @ self.to_speeds.T])

    def twists(self, y: Array) -> Twists:
        """Pose and twists (M) of states y (M, 2 m); V_r* is for V* = 0."""
        x, u = np.hsplit(y, 2)
        V = u @ self.frame.S.T
        return in_fluid(self.mechanics.stand, *self.frame.pose(x), V, np.zeros_like(V))

    def state(self, y: Array, phi: Array, phi_dot: Array) -> State:
        """The state as `eval` takes it, of y (2 m) and flywheels at phi, phi' (N each)."""
        stand, at = self.mechanics.stand, self.twists(y[None])
        w, i, j, k = Rotation.from_matrix(at.C[0]).as_quat(scalar_first=True).tolist()
        return replace(
            rest_state(stand),
            position=cast(Vec3, tuple(at.O1[0].tolist())),
            quaternion=(w, i, j, k),
            V=cast(Vec6, tuple(at.V[0].tolist())),
            u=() if stand.hold is None else tuple(y[self.count :].tolist()),
            phi=tuple(phi.tolist()),
            phi_dot=tuple(phi_dot.tolist()),
        )

    def displacement(self, y: Array) -> Array:
        """(M, 6; m, rad): way of O1 on the axes of the pose at x = 0, and rotation vector, from that pose.

        Turns about one axis are counted: the rotation vector may be longer than half a turn.
        """
        x, S = y[:, : self.count], self.frame.S
        (C0, *_), (O0, *_) = self.frame.pose(np.zeros((1, self.count)))
        C, O1 = self.frame.pose(x)
        r = Rotation.from_matrix(C0.T @ C).as_rotvec() if np.linalg.matrix_rank(S[3:] @ S[3:].T) > 1 else x @ S[3:].T
        return np.hstack([(O1 - O0) @ C0, r])

    def displacement_change(self, y: Array, moved: Array) -> Array:
        """Change (M, 6, P) of the displacement by changes of the states (M, 2 m, P); of r in E1, which |r| needs."""
        C0 = self.frame.pose(np.zeros((1, self.count)))[0][0]
        C, _, J = self.frame.slopes(y[:, : self.count])
        twist = J @ moved[:, : self.count]
        return np.concatenate([C0.T @ C @ twist[:, :3], twist[:, 3:]], axis=1)

    def speed_rates(self, drive: Drive, y: Array) -> Array:
        """u* (M, m; m/s2, rad/s2) at states y (M, 2 m), with the flywheels' motion at the same M times."""
        at = self.twists(y)
        push = wrench(self.mechanics, drive, at)
        push -= ((drive.Theta + self.mechanics.base.K) @ at.V_r_dot[:, :, None])[:, :, 0]
        return np.asarray((drive.mobility @ push[:, :, None])[:, :, 0])

    def acceleration(self, drive: Drive, y: Array) -> Array:
        """V* (M, 6; m/s2, rad/s2)."""
        return np.asarray(self.speed_rates(drive, y) @ self.frame.S.T)

    def rate(self, drive: Drive, y: Array) -> Array:
        """y' (M, 2 m)."""
        x, u = np.hsplit(y, 2)
        moved = np.linalg.solve(self.to_speeds @ self.frame.slopes(x)[2], u[:, :, None])[:, :, 0]
        return np.hstack([moved, self.speed_rates(drive, y)])

    def jacobian(self, drive: Drive, y: Array) -> Array:
        """dy'/dy (M, 2 m, 2 m), exact; where a law has a kink, the mean of its two sides."""
        m, (x, u) = self.count, np.hsplit(y, 2)
        J = self.frame.slopes(x)[2]
        back = np.linalg.inv(self.to_speeds @ J)
        at = self.twists(y)
        at = at._replace(V_r_dot=at.V_r_dot + self.acceleration(drive, y))
        by = slopes_of_residual(self.mechanics, at, drive)
        result = np.zeros((len(y), 2 * m, 2 * m))
        result[:, :m, :m] = -back @ (self.to_speeds @ self.frame.turning(J, (back @ u[:, :, None])[:, :, 0]))
        result[:, :m, m:] = back
        result[:, m:, :m] = drive.mobility @ by.by_pose @ J
        result[:, m:, m:] = drive.mobility @ by.by_twist @ self.frame.S
        return result


def wrench(mechanics: Mechanics, drive: Drive, at: Twists) -> Array:
    """F - M V_r - I phi'' - J phi' (M, 6), which is K V_r* of a free carrier. StateError: a law is undefined."""
    balance = mechanics.base.balance(at._replace(V_r_dot=np.zeros_like(at.V)))
    column = at.V_r[:, :, None]
    momentum = drive.Theta @ column + drive.h[:, :, None]
    balance -= (motor_cross(at.V_r) @ momentum + drive.Theta_dot @ column)[:, :, 0] + drive.push
    if any(mechanics.stand.gravity):
        balance += (drive.weight @ in_E1(at.C, mechanics.stand.gravity)[:, :, None])[:, :, 0]
    for s in range(mechanics.N):
        damped = flywheel_damping(mechanics, s, at.V_r, drive.phi[:, s], drive.phi_dot[:, s])
        if damped is not None:
            balance += damped[0][:6].T
    return balance


INTERVALS = 4
"""Intervals per block."""


def _integrals() -> Array:
    """a (4, 5): integral from 0 to j of the Lagrange polynomial of node k, spacing 1."""
    nodes = np.arange(INTERVALS + 1.0)
    powers = np.vander(nodes, increasing=True)  # rows: node; columns: power
    integrals = powers[1:] * nodes[1:, None] / (nodes + 1.0)
    return np.asarray(integrals @ np.linalg.inv(powers))


WEIGHTS = _integrals()


def split_blocks(values: Array) -> Array:
    """Values (B, 5, ...) of each block, first node included, from values at 4 B + 1 nodes."""
    B = (len(values) - 1) // INTERVALS
    first = values[:-1].reshape(B, INTERVALS, *values.shape[1:])
    return np.concatenate([first, values[INTERVALS::INTERVALS][:, None]], axis=1)


def integrate(rates: Array, spacing: float) -> Array:
    """Integrals (B, 4, ...) of rates at 4 B + 1 nodes (M, ...), from the first node of each block to the others."""
    return np.asarray(spacing * np.einsum("jk,bk...->bj...", WEIGHTS, split_blocks(rates)))


@dataclass(frozen=True, eq=False)
class BlockElimination:
    """x' = A x + g at 4 B + 1 nodes, eliminated block by block, for any g and start.

    inverse    (B, 4 n, 4 n): inverse of each block's equations
    transition (B, 4 n, n): nodes of a block as functions of its first node
    """

    spacing: float
    inverse: Array
    transition: Array

    @staticmethod
    def of(A: Array, spacing: float) -> BlockElimination:
        """Eliminate A (4 B + 1, n, n; 1/s) at nodes `spacing` (s) apart."""
        at = split_blocks(A)
        B, n = len(at), A.shape[1]
        block = -spacing * np.einsum("jk,bkmn->bjmkn", WEIGHTS[:, 1:], at[:, 1:]).reshape(
            B, INTERVALS * n, INTERVALS * n
        )
        block[:, range(INTERVALS * n), range(INTERVALS * n)] += 1.0
        inverse = np.linalg.inv(block)
        first = spacing * np.einsum("j,bmn->bjmn", WEIGHTS[:, 0], at[:, 0]) + np.eye(n)
        return BlockElimination(spacing, inverse, inverse @ first.reshape(B, INTERVALS * n, n))

    def solve(self, defects: Array, start: Array) -> Array:
        """x (4 B + 1, n, P) from `start` (n, P); `defects` (B, 4, n, P) are the right sides of the block equations."""
        B, n, P = len(self.inverse), *start.shape
        particular = self.inverse @ defects.reshape(B, INTERVALS * n, P)
        result = [start[None]]
        for carried, inner in zip(self.transition, particular, strict=True):
            result.append((carried @ result[-1][-1] + inner).reshape(INTERVALS, n, P))
        return np.concatenate(result)


_MOST = 24
"""Most corrections; a few are usual."""
_SLOW = 0.3
"""If a correction leaves more than this part of the error, the equations are linearised again."""


@dataclass(frozen=True, eq=False)
class CarrierCourse:
    """y (M, 2 m) at uniform nodes, and the linear equations near it."""

    y: Array
    near: BlockElimination


def course(
    chart: Chart, drive: Drive, spacing: float, start: Array, guess: Array, near: BlockElimination | None
) -> CarrierCourse:
    """The course from `start` (2 m) under the flywheels' motion at 4 B + 1 nodes `spacing` (s) apart.

    guess   (M, 2 m): a nearby course; `near`: its linear equations. The collocation equations are solved to rounding.
    Raises StateError if the carrier moves so violently that no course is found.
    """
    y = guess.copy()
    before = np.inf
    for _ in range(_MOST):
        if not np.all(np.isfinite(y)) or chart.frame.is_lost(y[:, : chart.count]):
            break
        if near is None:
            near = linearise(chart, drive, spacing, y)
        at = split_blocks(y)
        defects = at[:, :1] - at[:, 1:] + integrate(chart.rate(drive, y), spacing)
        step = near.solve(defects[..., None], (start - y[0])[:, None])[:, :, 0]
        y = y + step
        size = float(np.abs(step).max() / max(np.abs(y).max(), 1e-300))
        if size < 1e-11:
            return CarrierCourse(y, near)
        if size > _SLOW * before and size > 1e-10:
            near, before = None, np.inf
        else:
            before = size
    raise StateError("the carrier moves too violently: its course cannot be computed")


def linearise(chart: Chart, drive: Drive, spacing: float, y: Array) -> BlockElimination:
    """Linear equations near a course y (M, 2 m)."""
    return BlockElimination.of(chart.jacobian(drive, y), spacing)


def linearise_along(chart: Chart, drive: Drive, y: Array, phi_ddot: Array) -> Linear:
    """R = 0, tau and their exact derivatives by phi, phi', phi'' along states y (M, 2 m); phi'' (M, N)."""
    at = chart.twists(y)
    moving = prescribed_at(chart.mechanics, at._replace(V_r_dot=at.V_r_dot + chart.acceleration(drive, y)))
    return linear(moving, drive.phi, drive.phi_dot, phi_ddot)


def forced_defects(drive: Drive, linear: Linear, basis: Array, spacing: float) -> Array:
    """Defects (B, 4, 2 m, N P) that additions to the flywheels' motion make, for `BlockElimination.solve`.

    basis  (3, M, P): functions that each flywheel may add, with two derivatives, at the nodes
    """
    slopes = (linear.by_phi, linear.by_phi_dot, linear.by_phi_ddot)
    rates = sum((drive.mobility @ by)[:, :, :, None] * x[:, None, None, :] for by, x in zip(slopes, basis, strict=True))
    M, m, N, P = np.shape(rates)
    return integrate(np.concatenate([np.zeros((M, m, N * P)), np.reshape(rates, (M, m, N * P))], axis=1), spacing)


FREE_AT_REST = 1e-6
"""A direction with less than this part of the largest stiffness (relative to inertia) is free: the pose stays there."""
_ITERATIONS, _LONGEST, _LAST = 50, 0.3, 1e-11
_REST_ACCELERATION = 1e-6
"""m/s2: an acceleration without stiffness to balance it that still counts as rest."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """y (2 m) at rest, u = 0, and its derivatives by the flywheels' angles (2 m, N).

    projection   (2 m, 2 m): projection that removes displacements in directions free at rest from state differences
    """

    y: Array
    by_phi: Array
    projection: Array


def equilibrium(chart: Chart, phi: Array, near: Array | None = None) -> Equilibrium:
    """Equilibrium at angles phi (N), by Newton's method from the pose of `near` (2 m), or from the chart's own.

    Steps are smallest in the inertia's norm, zero in free directions. Raises CheckError: there is no equilibrium.
    """
    still, m = np.zeros((1, len(phi))), chart.count
    driven, S = drive(chart.mechanics, phi[None], still, still), chart.frame.S
    root = np.linalg.cholesky(S.T @ (driven.Theta[0] + chart.mechanics.base.K) @ S).T  # x^T K x = |root x|^2
    inverse = np.linalg.inv(root)
    y = np.zeros((1, 2 * m))
    if near is not None:
        y[0, :m] = near[:m]
    for _ in range(_ITERATIONS):
        U, sigma, Vt = np.linalg.svd(-root @ chart.jacobian(driven, y)[0, m:, :m] @ inverse)
        kept = sigma > FREE_AT_REST * max(float(sigma[0]), 1e-9)
        back = inverse @ (Vt[kept].T / sigma[kept]) @ U[:, kept].T @ root  # displacement by acceleration
        step = back @ chart.speed_rates(driven, y)[0]
        y[0, :m] += step * min(1.0, _LONGEST / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < _LAST:
            break
    stand, free = chart.mechanics.stand, inverse @ Vt[~kept].T
    size = float(np.linalg.norm(root @ chart.speed_rates(driven, y)[0])) / float(root[0, 0])
    if not size <= _REST_ACCELERATION * max(1.0, float(np.linalg.norm(stand.gravity))):
        why = "nothing holds it there" if free.size else "there is no equilibrium near the mean pose"
        unit = "m/s2" if np.any(S[:3, 0]) and not np.any(S[3:, 0]) else "rad/s2"
        raise CheckError(
            f"{stand.name}: no rest to run up from: with the flywheels stopped the carrier accelerates by {size:.3g} "
            f"{unit}; {why}"
        )
    by_phi = back @ driven.mobility[0] @ linearise_along(chart, driven, y, still).by_phi[0]
    held = np.eye(2 * m)
    held[:m, :m] -= free @ free.T @ root.T @ root
    return Equilibrium(y[0], np.vstack([by_phi, np.zeros_like(by_phi)]), held)
