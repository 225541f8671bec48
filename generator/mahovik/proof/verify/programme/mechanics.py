"""Mechanics of a motion and a programme, by the reference: states, scales of errors, item 1 (the residual of (12))."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import cast

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.motion.programme import Angles, Fourier, Programme
from mahovik.core.motion.required import Course, RequiredMotion
from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.state import State
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.bodies import Bodies, bodies_of
from mahovik.proof.reference.hold import twists
from mahovik.proof.reference.inverse import demand
from mahovik.proof.reference.rotation import kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.torque import torque
from mahovik.proof.verify.programme.finding import Finding, check_limit
from mahovik.proof.verify.programme.held import held_twist, held_twist_rate, pose, speeds


def pieces_at(stand: Stand, q: Array, V: Array, phi: Array, phi_dot: Array) -> Pieces:
    """Pieces of (1)-(11) at q (6; m, rad; of a held carrier the coordinates of its freedoms), V (6), phi, phi' (N)."""
    zeros = (0.0,) * len(phi)
    position, angles, quaternion = q[:3], q[3:], None
    if stand.hold is not None:
        position, C = pose(stand, q)
        x, y, z, w = Rotation.from_matrix(C).as_quat().tolist()
        quaternion = (w, x, y, z)
    state = State(
        position=cast(Vec3, tuple(position.tolist())),
        angles=None if quaternion is not None else cast(Vec3, tuple(angles.tolist())),
        quaternion=quaternion,
        V=cast(Vec6, tuple(V.tolist())),
        phi=tuple(phi.tolist()),
        phi_dot=tuple(phi_dot.tolist()),
        phi_ddot=zeros,
        V_dot=(0.0,) * 6,
        tau=zeros,
    )
    return reference.pieces(stand, state, _bodies(stand))


@lru_cache(maxsize=4)
def _bodies(stand: Stand) -> Bodies:
    """Bodies of a stand, made once for the thousands of its states."""
    return bodies_of(stand)


def twist(stand: Stand, q: Array, q_dot: Array) -> Array:
    """V = A q' (6) of (10)."""
    if stand.hold is not None:
        return held_twist(stand, q, q_dot)
    return kinematic_matrix(stand.angles, q[3:]) @ q_dot


def twist_rate(stand: Stand, q: Array, q_dot: Array, q_ddot: Array) -> Array:
    """V* = A q'' + D q' (6) of (10)."""
    if stand.hold is not None:
        return held_twist_rate(stand, q, q_dot, q_ddot)
    D = kinematic_matrix_rate(stand.angles, q[3:], q_dot[3:])
    return kinematic_matrix(stand.angles, q[3:]) @ q_ddot + D @ q_dot


def state_at(stand: Stand, q: Array, q_dot: Array) -> Array:
    """y = (q, V) (12) of a free carrier, (q, u) (2 m) of a held one."""
    V = twist(stand, q, q_dot)
    return np.concatenate([q, V if stand.hold is None else speeds(stand, V)])


@dataclass(frozen=True, eq=False)
class Instant:
    """The pieces at one time of the prescribed motion, with V* (6) and phi'' (N)."""

    at: Pieces
    V_dot: Array
    phi_ddot: Array

    def residual(self) -> Array:
        """Residual F - K V_r* - M V_r - J phi' - I phi'' (6; N, N m) of (12)."""
        return demand(self.at, self.V_dot) - self.at.I @ self.phi_ddot

    def torque(self) -> Array:
        """Drive torques tau (N, N m)."""
        return torque(self.at, self.V_dot, self.phi_ddot)


def instants(stand: Stand, course: Course, angles: Angles) -> Iterator[Instant]:
    """Instants, one for each row of the course and of the angles."""
    for q, q_dot, q_ddot, phi, phi_dot, phi_ddot in zip(*course, *angles, strict=True):
        at = pieces_at(stand, q, twist(stand, q, q_dot), phi, phi_dot)
        yield Instant(at, twist_rate(stand, q, q_dot, q_ddot), phi_ddot)


_PHASES = 2 * np.pi * np.arange(4) / 4
"""K and F are sums over the flywheels of harmonics up to the second: these four phases give their means exactly."""


@dataclass(frozen=True, eq=False)
class Scale:
    """Scales of a motion, in the norms of K0 (6x6), the mean of K over the phases.

    wrench             max of |K0^-1/2 (P - mean P)|
    amplitude, speed   max of |K0^1/2 x| for displacements from the mean pose and for twists along the motion
    S                  (6xm): freedoms of a held carrier, along which alone wrenches count
    """

    K0: Array
    wrench: float
    amplitude: float
    speed: float
    S: Array | None = None

    def wrench_share(self, R: Array) -> float:
        """|K0^-1/2 R| of a wrench (6), as a share."""
        return wrench_norm(self.K0, self.S, R) / self.wrench

    def displacement_share(self, x: Array) -> float:
        """|K0^1/2 x| of a small displacement (6; m, rad; in E1 about O1), as a share."""
        return norm(self.K0, x) / self.amplitude

    def twist_share(self, V: Array) -> float:
        """|K0^1/2 V| of a twist (6), as a share."""
        return norm(self.K0, V) / self.speed

    def lengths(self) -> tuple[float, float]:
        """Displacement in m and rotation in rad that each have the whole amplitude."""
        return self.amplitude / math.sqrt(self.K0[0, 0]), self.amplitude / math.sqrt(np.trace(self.K0[3:, 3:]) / 3)


def norm(K0: Array, x: Array) -> float:
    """|K0^1/2 x|."""
    return math.sqrt(max(float(x @ K0 @ x), 0.0))


def wrench_norm(K0: Array, S: Array | None, R: Array) -> float:
    """|K0^-1/2 R| of a wrench (6); of a held carrier |(S^T K0 S)^-1/2 S^T R|."""
    if S is not None:
        K0, R = S.T @ K0 @ S, S.T @ R
    return math.sqrt(max(float(R @ np.linalg.solve(K0, R)), 0.0))


def scale_of(stand: Stand, motion: RequiredMotion, programme: Programme) -> Scale:
    """The scales of a required motion. For a carrier held still they are those of the flywheels' own unbalance."""
    fastest = max(motion.harmonics, default=1) if motion.periodic else 12
    M = min(max(32, 16 * fastest), 512)
    t = motion.span * np.arange(M) / M
    course = motion.at(t, programme.bias)
    mean = course.q.mean(axis=0)
    N = len(stand.flywheels)
    locked = [pieces_at(stand, mean, np.zeros(6), np.full(N, phase), np.zeros(N)) for phase in _PHASES]
    K0 = np.mean([at.K for at in locked], axis=0)
    S = None if stand.hold is None else twists(stand.hold)
    still = not np.any(course.q_dot)
    if still:
        I = np.mean([np.abs(at.I) for at in locked], axis=0)
        omega = 2 * math.pi * max(1, *(abs(n) for n in programme.winding)) / motion.span
        if S is not None:
            wrench = sum(wrench_norm(K0, S, each) for each in I.T) * omega**2
            return Scale(K0, wrench, wrench / omega**2, wrench / omega, S)
        m = math.sqrt(K0[0, 0])
        first_moments = sum(s.mass * math.hypot(*s.center_of_mass[1:]) for s in stand.flywheels)
        wrench = first_moments * omega**2 / m or max(norm(np.linalg.inv(K0), each) for each in I.T) * omega**2
        return Scale(K0, wrench, wrench / omega**2, wrench / omega)
    P = []
    amplitude = speed = 0.0
    for q, q_dot, q_ddot in zip(*course, strict=True):
        V, V_dot = twist(stand, q, q_dot), twist_rate(stand, q, q_dot, q_ddot)
        needed = [pieces_at(stand, q, V, np.full(N, phase), np.zeros(N)) for phase in _PHASES]
        P.append(np.mean([demand(at, V_dot) for at in needed], axis=0))
        amplitude = max(amplitude, norm(K0, twist(stand, q, q - mean)))
        speed = max(speed, norm(K0, V))
    wrench = max(wrench_norm(K0, S, each) for each in np.array(P) - np.mean(P, axis=0))
    return Scale(K0, wrench, amplitude, speed, S)


FINER = 20
"""Points of the grid for each node of the programme."""

OFFSET = 0.382
"""The grid begins this share of a step after a node of the programme, so that no node is a point of the grid."""


@dataclass(frozen=True, eq=False)
class Residuals:
    """Residual of (12) along a programme: t (M, s), residual (M) and its mean as shares; tau (M, N; N m)."""

    t: Array
    residual: Array
    mean: float
    tau: Array


def nodes(programme: Programme, motion: RequiredMotion) -> int:
    """Points of the grid in a span; no fewer than the fastest of flywheels and motion needs."""
    own = 2 * len(programme.course.cos) + 1 if isinstance(programme.course, Fourier) else len(programme.course.t)
    fastest = max([*motion.harmonics, *(abs(n) for n in programme.winding), 1])
    return max(own, 2 * fastest + 1)


def residuals(
    stand: Stand, motion: RequiredMotion, programme: Programme, scale: Scale, times: int | None = None
) -> Residuals:
    """Residuals over the whole span, beside every node: at a number of `times`, by default 20 to a node."""
    M = times or FINER * nodes(programme, motion)
    t = programme.span * (np.arange(M) + OFFSET) / M
    R, tau = [], []
    for instant in instants(stand, motion.at(t, programme.bias), programme.at(t)):
        R.append(instant.residual())
        tau.append(instant.torque())
    shares = np.array([scale.wrench_share(each) for each in R])
    return Residuals(t, shares, scale.wrench_share(np.mean(R, axis=0)), np.array(tau))


def residual_finding(found: Residuals, limit: float) -> Finding:
    """The largest residual of (12), relative."""
    i = int(np.argmax(found.residual))
    value = float(found.residual[i])
    words = f"of (12), at {len(found.t)} times; largest at t = {found.t[i]:.6g} s"
    if found.mean > 0.5 * value and value > 0.1 * limit:
        words += f"; mean {found.mean:.2g}, which nothing balances: the carrier drifts"
    return check_limit("residual", value, limit, words)
