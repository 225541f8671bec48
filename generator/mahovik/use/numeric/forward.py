"""The carrier's course by (8) under given flywheel motions, its rest, and derivatives of both.

A state is 12 numbers about one pose: y = (x, r, V): O1 = O1_0 + C_0 x (m), C = C_0 exp<r> (rad), V = (v, omega) in E1.
No attitude within half a turn of C_0 is singular. That of a held carrier has two numbers for each freedom (held_chart).

A course is found by collocation at uniform nodes, blocks of four intervals (order 6), and Newton's method for all times
at once. On a block y_j = y_0 + d sum_k a_jk y'_k, j = 1..4, k = 0..4, with a_jk the integrals of the Lagrange
polynomials: all nodes are evaluated together, and only products of small matrices go from block to block.

Sums over the flywheels are computed for all times first. With them the carrier's acceleration needs 6-vectors only, for
any number of flywheels:

    K V* = F - Theta' V - push - Phi(V) (Theta V + h) + weight,    K = Theta + K of carrier and instruments.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.functions import Course
from mahovik.errors import CheckError, StateError
from mahovik.use.numeric.array import Array
from mahovik.use.numeric.evaluate import Linear, flywheel_damping, linear
from mahovik.use.numeric.flywheels import waves
from mahovik.use.numeric.kinematics import Twists, in_E1, twists
from mahovik.use.numeric.prescribed_motion import Mechanics, prescribed_at
from mahovik.use.numeric.se3 import motor_cross
from mahovik.use.numeric.stream import uniform_stream


@dataclass(frozen=True, eq=False)
class Drive:
    """Sums over the flywheels at times of any shape (...), in E1 about O1.

    inverse     (..., 6, 6): K^-1 of (2)
    mobility    (..., m, 6): rates of the speeds by a wrench, (S^T K S)^-1 S^T; of a free carrier K^-1
    Theta, Theta_dot   (..., 6, 6): sum Ls Theta_s Ls^T and its derivative
    h           (..., 6): sum I_s phi_s'
    push        (..., 6): sum I_s phi_s'' + I_s,phi (phi_s')^2
    weight      (..., 6, 3): wrench of the net weight by gravity in E1
    phi, phi_dot   (..., N): for flywheels with damping
    """

    inverse: Array
    mobility: Array
    Theta: Array
    Theta_dot: Array
    h: Array
    push: Array
    weight: Array
    phi: Array
    phi_dot: Array

    def __getitem__(self, index: object) -> Drive:
        return Drive(*(x[index] for x in vars(self).values()))


def drive(mechanics: Mechanics, phi: Array, phi_dot: Array, phi_ddot: Array) -> Drive:
    """Sums of the motions phi, phi', phi'' (..., N each; rad, s)."""
    tables, shape = mechanics.tables, phi.shape[:-1]
    N = mechanics.N
    h, slopes = (np.moveaxis(x, 0, -2).reshape(-1, 5 * N) for x in waves(phi))  # (moments, 5 N)
    speed, acceleration = (np.tile(x.reshape(-1, N), (1, 5)) for x in (phi_dot, phi_ddot))
    Theta_of, weight_of, coupling = (
        x.reshape(5 * N, -1) for x in (tables.Theta, tables.weight, tables.coupling)
    )  # fmt: skip
    Theta = (h @ Theta_of).reshape(*shape, 6, 6)
    K, S = Theta + mechanics.base.K, mechanics.freedoms
    inverse = np.asarray(np.linalg.inv(K))
    return Drive(
        inverse=inverse,
        mobility=inverse if mechanics.stand.hold is None else np.linalg.inv(S.T @ K @ S) @ S.T,
        Theta=Theta,
        Theta_dot=((slopes * speed) @ Theta_of).reshape(*shape, 6, 6),
        h=((h * speed) @ coupling).reshape(*shape, 6),
        push=((h * acceleration + slopes * speed**2) @ coupling).reshape(*shape, 6),
        weight=(h @ weight_of).reshape(*shape, 6, 3),
        phi=phi,
        phi_dot=phi_dot,
    )


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
        own = -spacing * np.einsum("jk,bkmn->bjmkn", WEIGHTS[:, 1:], at[:, 1:]).reshape(B, INTERVALS * n, INTERVALS * n)
        own[:, range(INTERVALS * n), range(INTERVALS * n)] += 1.0
        inverse = np.linalg.inv(own)
        first = spacing * np.einsum("j,bmn->bjmn", WEIGHTS[:, 0], at[:, 0]) + np.eye(n)
        return BlockElimination(spacing, inverse, inverse @ first.reshape(B, INTERVALS * n, n))

    def solve(self, defects: Array, start: Array) -> Array:
        """x (4 B + 1, n, P) from `start` (n, P); `defects` (B, 4, n, P) are the right sides of the block equations."""
        B, n, P = len(self.inverse), *start.shape
        particular = self.inverse @ defects.reshape(B, INTERVALS * n, P)
        found = [start[None]]
        for carried, own in zip(self.transition, particular, strict=True):
            found.append((carried @ found[-1][-1] + own).reshape(INTERVALS, n, P))
        return np.concatenate(found)


_SMALL = 1e-2
"""rad: below it the series is more accurate."""


@dataclass(frozen=True, eq=False)
class Chart:
    """The equations of a stand about the pose O1_0 (3; m), C_0 (3, 3)."""

    mechanics: Mechanics
    O1: Array
    C: Array

    @staticmethod
    def at_pose(mechanics: Mechanics, course: Course) -> Chart:
        """Chart about the single pose of `course` (M = 1)."""
        at = twists(mechanics.stand, course)
        return Chart(mechanics, at.O1[0], at.C[0])

    @property
    def count(self) -> int:
        """Speeds in a state, which has as many numbers of the pose before them."""
        return 6

    def of(self, course: Course) -> Array:
        """y (M, 12) of prescribed coordinates q, q' (M, 6 each)."""
        at = twists(self.mechanics.stand, course)
        r = Rotation.from_matrix(self.C.T @ at.C).as_rotvec()
        return np.hstack([(at.O1 - self.O1) @ self.C, r, at.V])

    def twists(self, y: Array) -> Twists:
        """Attitude, position and twists (M) of states y (M, 12); V_r* is for V* = 0."""
        C = self.C @ Rotation.from_rotvec(y[:, 3:6]).as_matrix()
        return self._in_fluid(C, self.O1 + y[:, :3] @ self.C.T, y[:, 6:])

    def _in_fluid(self, C: Array, O1: Array, V: Array) -> Twists:
        """With the twists relative to the fluid, for V* = 0."""
        V_r, rate = V, np.zeros_like(V)
        stream = uniform_stream(self.mechanics.stand)
        if any(stream):
            u = in_E1(C, np.broadcast_to(stream, (len(V), 3)))
            none = np.zeros_like(u)
            V_r, rate = V - np.hstack([u, none]), np.hstack([np.cross(V[:, 3:], u), none])
        return Twists(C, O1, V, V_r, rate)

    def displacement(self, y: Array) -> Array:
        """(M, 6; m, rad): way of O1 on the axes of the chart's pose, and rotation vector, from that pose."""
        return y[:, :6]

    def displacement_change(self, y: Array, moved: Array) -> Array:
        """Change (M, 6, P) of the displacement by changes of the states (M, 12, P)."""
        return moved[:, :6]

    def is_lost(self, y: Array) -> bool:
        """Whether a state is near the edge of the chart."""
        return bool(np.abs(y[:, 3:6]).max() > _TOO_FAR)

    def speed_rates(self, given: Drive, y: Array) -> Array:
        """Rates of the speeds in a state (M, 6; m/s2, rad/s2): V*; u* of a held carrier."""
        return self.acceleration(given, y)

    def acceleration(self, given: Drive, y: Array) -> Array:
        """V* (M, 6; m/s2, rad/s2) by (8) at states y (M, 12), with the flywheels' motion at the same M times."""
        at = self.twists(y)
        return np.asarray((given.inverse @ self.wrench(given, at))[:, :, 0] - at.V_r_dot)

    def wrench(self, given: Drive, at: Twists) -> Array:
        """F - M V_r - I phi'' - J phi' (M, 6, 1; N, N m), which is K V_r* of a free carrier."""
        own = self.mechanics
        column = at.V_r[:, :, None]
        wrench = own.base.balance(at._replace(V_r_dot=np.zeros_like(at.V)))[:, :, None]
        momentum = given.Theta @ column
        momentum[:, :, 0] += given.h
        wrench -= motor_cross(at.V_r) @ momentum
        wrench -= given.Theta_dot @ column
        wrench[:, :, 0] -= given.push
        if any(own.stand.gravity):
            g = in_E1(at.C, np.broadcast_to(own.stand.gravity, at.O1.shape))
            wrench += given.weight @ g[:, :, None]
        for s, damping in enumerate(own.tables.damping):
            if damping is not None:
                damped = flywheel_damping(own.tables, s, at.V_r, given.phi[:, s], given.phi_dot[:, s])[0]
                wrench[:, :, 0] += damped[:6].T
        return np.asarray(wrench)

    def rate(self, given: Drive, y: Array) -> Array:
        """y' (M, 12)."""
        r, v, omega = y[:, 3:6], y[:, 6:9], y[:, 9:]
        x_dot = Rotation.from_rotvec(r).apply(v)
        angle = np.linalg.norm(r, axis=1)[:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            k = (1.0 - angle / 2.0 / np.tan(angle / 2.0)) / angle**2
        k = np.where(angle < _SMALL, 1.0 / 12.0 + angle**2 / 720.0, k)
        turned = np.cross(r, omega)
        r_dot = omega + 0.5 * turned + k * np.cross(r, turned)
        return np.hstack([x_dot, r_dot, self.acceleration(given, y)])


_STEPS = (1e-6, 1e-5)
"""Steps of central differences: of the pose (m, rad), of speeds (m/s, rad/s)."""
_MOST = 24
"""Most corrections; a few are usual."""
_SLOW = 0.3
"""If a correction leaves more than this part of the error, the equations are linearised again."""
_TOO_FAR = 2.0
"""rad: a carrier that turns further is lost, near the edge of its chart."""


@dataclass(frozen=True, eq=False)
class CarrierCourse:
    """y (M, 12) at uniform nodes, and the linear equations near it."""

    y: Array
    near: BlockElimination


def course(
    chart: Chart, given: Drive, spacing: float, start: Array, guess: Array, near: BlockElimination | None
) -> CarrierCourse:
    """The course from `start` (12) under the flywheels' motion at 4 B + 1 nodes `spacing` (s) apart.

    guess   (M, 12): a nearby course; `near`: its linear equations. The collocation equations are solved to rounding.
    Raises StateError if the carrier moves so violently that no course is found.
    """
    y = guess.copy()
    before = np.inf
    for _ in range(_MOST):
        if not np.all(np.isfinite(y)) or chart.is_lost(y):
            break
        if near is None:
            near = linearise(chart, given, spacing, y)
        at = split_blocks(y)
        defects = at[:, :1] - at[:, 1:] + integrate(chart.rate(given, y), spacing)
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


def linearise(chart: Chart, given: Drive, spacing: float, y: Array) -> BlockElimination:
    """Linear equations near a course y (M, 12; held M, 2 m), by central differences at all nodes."""
    columns = []
    for i, step in enumerate(np.repeat(_STEPS, chart.count)):
        aside = np.zeros(2 * chart.count)
        aside[i] = step
        columns.append((chart.rate(given, y + aside) - chart.rate(given, y - aside)) / (2.0 * step))
    return BlockElimination.of(np.stack(columns, axis=2), spacing)


def linearise_along(chart: Chart, given: Drive, y: Array, phi_ddot: Array) -> Linear:
    """R = 0, tau and their exact derivatives by phi, phi', phi'' along states y (M, 12); phi'' (M, N)."""
    at = chart.twists(y)
    V_r_dot = at.V_r_dot + chart.acceleration(given, y)
    moving = prescribed_at(chart.mechanics, at._replace(V_r_dot=V_r_dot))
    return linear(moving, given.phi, given.phi_dot, phi_ddot)


def acceleration_rates(given: Drive, found: Linear) -> tuple[Array, Array, Array]:
    """Change of the speeds' rates by phi, phi', phi'' of each flywheel (M, 6, N each; held M, m, N), state fixed."""
    return given.mobility @ found.by_phi, given.mobility @ found.by_phi_dot, given.mobility @ found.by_phi_ddot


FREE_AT_REST = 1e-6
"""A direction with less than this part of the largest stiffness (relative to inertia) is free: the pose stays there."""

_STEP = 1e-6
"""Step of central differences: m, rad."""
_ITERATIONS, _LONGEST, _LAST = 50, 0.3, 1e-11
_REST_ACCELERATION = 1e-6
"""m/s2: an acceleration without stiffness to balance it that still counts as rest."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """y (12; held 2 m) at rest, V = 0, and its derivatives by the flywheels' angles (12, N).

    projection   (12, 12): projection that removes displacements in directions free at rest from state differences
    """

    y: Array
    by_phi: Array
    projection: Array


def equilibrium(chart: Chart, phi: Array, near: Array | None = None) -> Equilibrium:
    """Equilibrium at angles phi (N), by Newton's method from the pose of `near` (12), or from the chart's own.

    Steps are smallest in the inertia's norm, zero in free directions. Raises CheckError: there is no equilibrium.
    """
    still, m = np.zeros((1, len(phi))), chart.count
    given, S = drive(chart.mechanics, phi[None], still, still), chart.mechanics.freedoms
    root = np.linalg.cholesky(S.T @ (given.Theta[0] + chart.mechanics.base.K) @ S).T  # x^T K x = |root x|^2
    y = np.zeros((1, 2 * m))
    if near is not None:
        y[0, :m] = near[:m]
    for _ in range(_ITERATIONS):
        back, free = _compliance(chart, given, y, root)
        step = back @ chart.speed_rates(given, y)[0]
        y[0, :m] += step * min(1.0, _LONGEST / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < _LAST:
            break
    stand = chart.mechanics.stand
    left = root @ chart.speed_rates(given, y)[0]
    size = float(np.linalg.norm(left)) / float(root[0, 0])
    if not size <= _REST_ACCELERATION * max(1.0, float(np.linalg.norm(stand.gravity))):
        why = "nothing holds it there" if free.size else "there is no equilibrium near the mean pose"
        unit = "m/s2" if np.any(S[:3, 0]) and not np.any(S[3:, 0]) else "rad/s2"
        raise CheckError(
            f"{stand.name}: no rest to run up from: with the flywheels stopped the carrier accelerates by {size:.3g} "
            f"{unit}; {why}"
        )
    by_phi = back @ given.mobility[0] @ linearise_along(chart, given, y, still).by_phi[0]
    held = np.eye(2 * m)
    held[:m, :m] -= free @ free.T @ root.T @ root
    return Equilibrium(y[0], np.vstack([by_phi, np.zeros_like(by_phi)]), held)


def _compliance(chart: Chart, given: Drive, y: Array, root: Array) -> tuple[Array, Array]:
    """Displacement (6, 6) that balances an acceleration, zero in free directions; these (6, n), orthonormal in K."""
    m = chart.count
    aside = np.zeros((2 * m, 2 * m))
    aside[range(2 * m), [*range(m), *range(m)]] = [_STEP] * m + [-_STEP] * m
    moved = chart.speed_rates(given[np.zeros(2 * m, dtype=int)], y + aside)
    slopes = (moved[:m] - moved[m:]).T / (2.0 * _STEP)
    U, sigma, Vt = np.linalg.svd(-root @ slopes @ np.linalg.inv(root))
    kept = sigma > FREE_AT_REST * max(float(sigma[0]), 1e-9)
    inverse = (Vt[kept].T / sigma[kept]) @ U[:, kept].T
    back = np.linalg.inv(root)
    return back @ inverse @ root, np.asarray(back @ Vt[~kept].T)
