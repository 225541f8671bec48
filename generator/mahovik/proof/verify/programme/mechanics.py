"""Mechanics of a carrier, free or held, in its coordinates q, by the literal reference: residual, simulation, rest.

V = A q', V* = A q'' + D q': of a free carrier (10), of a held one by the motions of its freedoms one after the other,
H = H_0 exp(S_1^ q_1) exp(S_2^ q_2) .., S^ = [[<omega>, v], [0, 0]], which takes points of E1 to E0; V^ = H^-1 H'.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from mahovik.core.motion.functions import Angles, Course
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.model import Stand, rest_state
from mahovik.errors import StateError
from mahovik.proof import reference
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.algebra import Array, attitude, cross, rotation_vector, twists, vector
from mahovik.proof.reference.coordinates import check_attitude, kinematic_matrix, kinematic_matrix_rate
from mahovik.proof.reference.inverse import demand
from mahovik.proof.reference.motion import forward, torque
from mahovik.proof.reference.pieces import bodies_of


def largest(values: Array) -> float:
    """Largest magnitude; 0 if there are no values."""
    return float(np.abs(values).max(initial=0.0))


class Carrier(NamedTuple):
    """O1 (3) in E0, C (3x3), and of V = A q', V* = A q'' + drift: A (6xm), drift (6)."""

    O1: Array
    C: Array
    A: Array
    drift: Array


def carrier_at(stand: Stand, q: Array, q_dot: Array) -> Carrier:
    """The carrier at coordinates q and rates q' (m each; m, rad, s)."""
    from scipy.linalg import expm

    if stand.hold is None:
        D = kinematic_matrix_rate(stand.angles, q[3:], q_dot[3:])
        return Carrier(q[:3], attitude(stand.angles, *q[3:]), kinematic_matrix(stand.angles, q[3:]), D @ q_dot)
    H, motions = _freedoms(stand)
    columns, drift = np.zeros((len(q), 4, 4)), np.zeros((4, 4))
    for k, S in motions:
        onward, back = expm(S * q[k]), expm(-S * q[k])
        columns, drift, H = back @ columns @ onward, back @ drift @ onward, H @ onward
        rate = np.tensordot(q_dot, columns, 1)
        drift += (rate @ S - S @ rate) * q_dot[k]
        columns[k] = S
    return Carrier(H[:3, 3], H[:3, :3], _twist(columns).T, _twist(drift))


@lru_cache(maxsize=4)
def _freedoms(stand: Stand) -> tuple[Array, tuple[tuple[int, Array], ...]]:
    """H_0, and S^ of each freedom with its number, in the order of the coordinates."""
    hold = stand.hold
    assert hold is not None
    home, S, order = np.eye(4), twists(hold), coordinates_of(stand).order
    home[:3, :3], home[:3, 3] = attitude(stand.angles, *hold.angles), vector(hold.position)
    motions = [(k, np.vstack([np.column_stack([cross(S[3:, k]), S[:3, k]]), np.zeros(4)])) for k in order]
    return home, tuple(motions)


def _twist(rate: Array) -> Array:
    """(v; omega) of matrices [[<omega>, v], [0, 0]]."""
    return np.concatenate([rate[..., :3, 3], rate[..., (2, 0, 1), (1, 2, 0)]], axis=-1)


def twist(stand: Stand, q: Array, q_dot: Array) -> Array:
    """V = A q' (6)."""
    return carrier_at(stand, q, q_dot).A @ q_dot


def displacement(stand: Stand, q: Array, mean: Array) -> tuple[float, float]:
    """Way of O1 (m) and angle of E1 (rad) from the pose of coordinates `mean` (m) to that of q (m).

    Turns about one axis are counted; otherwise the angle is at most half a turn.
    """
    now, start = (carrier_at(stand, coordinates, np.zeros_like(q)) for coordinates in (q, mean))
    turned = rotation_vector(start.C.T @ now.C)
    if np.linalg.matrix_rank(start.A[3:]) <= 1:
        turned = start.A[3:] @ (q - mean)
    return float(np.linalg.norm(now.O1 - start.O1)), float(np.linalg.norm(turned))


class Moment(NamedTuple):
    """The carrier and the pieces of (1)-(11) at one time."""

    stand: Stand
    carrier: Carrier
    at: Pieces

    def V_dot(self, q_ddot: Array) -> Array:
        """V* (6) in E1."""
        return self.carrier.A @ q_ddot + self.carrier.drift

    def q_ddot(self, phi_ddot: Array) -> Array:
        """q'' (m; m, rad, s) by (8) under accelerations of the flywheels (N)."""
        moved = forward(self.at, phi_ddot) - self.carrier.drift
        return np.asarray(np.linalg.lstsq(self.carrier.A, moved, rcond=None)[0])

    def torque(self, q_ddot: Array, phi_ddot: Array) -> Array:
        """Drive torques tau (N, N m)."""
        return torque(self.at, self.V_dot(q_ddot), phi_ddot)


def moment(stand: Stand, q: Array, q_dot: Array, phi: Array, phi_dot: Array) -> Moment:
    """Everything at coordinates q, q' (m each), angles phi and speeds phi' of the flywheels (N each)."""
    from scipy.spatial.transform import Rotation

    if not (np.isfinite(q).all() and np.isfinite(q_dot).all()):
        raise StateError("the carrier is thrown off: its coordinates are not finite")
    carrier = carrier_at(stand, q, q_dot)
    pose: dict[str, Any] = {"angles": tuple(q[3:])}
    if stand.hold is not None:
        pose = {"quaternion": tuple(np.roll(Rotation.from_matrix(carrier.C).as_quat(), 1))}
    pose |= {"position": tuple(carrier.O1), "V": tuple(carrier.A @ q_dot), "phi": tuple(phi), "phi_dot": tuple(phi_dot)}
    return Moment(stand, carrier, reference.pieces(stand, replace(rest_state(stand), **pose), _bodies(stand)))


_bodies = lru_cache(maxsize=4)(bodies_of)
"""Bodies of a stand, made once for the thousands of its states."""


def free_acceleration(stand: Stand, q: Array, q_dot: Array, phi: Array, phi_dot: Array, phi_ddot: Array) -> Array:
    """q'' (m; m, rad, s) of a carrier that nothing prescribes, (8). StateError at a singular attitude."""
    if stand.hold is None and np.isfinite(q).all():
        check_attitude(stand.angles, q[3:])
    return moment(stand, q, q_dot, phi, phi_dot).q_ddot(phi_ddot)


def residual_and_torque(stand: Stand, course: Course, angles: Angles) -> tuple[Array, Array]:
    """F - K V_r* - M V_r - J phi' - I phi'' (M, 6; N, N m) of (12) and drive torques (M, N; N m) along a course of the
    carrier and of flywheels.
    """
    R, tau = [], []
    for q, q_dot, q_ddot, phi, phi_dot, phi_ddot in zip(*course, *angles, strict=True):
        now = moment(stand, q, q_dot, phi, phi_dot)
        R.append(demand(now.at, now.V_dot(q_ddot)) - now.at.I @ phi_ddot)
        tau.append(now.torque(q_ddot, phi_ddot))
    return np.array(R), np.array(tau)


def torques_along(stand: Stand, y: Array, angles: Angles) -> Array:
    """Drive torques (M, N; N m) along states y = (q, q') (M, 2 m) of a carrier that nothing prescribes."""
    rows = zip(*np.hsplit(y, 2), *angles, strict=True)
    moments = [(moment(stand, *row), phi_ddot) for *row, phi_ddot in rows]
    return np.array([now.torque(now.q_ddot(phi_ddot), phi_ddot) for now, phi_ddot in moments])


_PHASES = 2 * np.pi * np.arange(4) / 4
"""K and F are sums over the flywheels of harmonics up to the second: these four phases give their means exactly."""


class Scale(NamedTuple):
    """Scales of a motion, in the norms of K0 (6x6), the mean of K over the phases.

    S                  (6xm): freedoms, along which alone wrenches count; of a free carrier the unit matrix
    wrench             max of |(S^T K0 S)^-1/2 S^T (P - mean P)|
    amplitude, speed   max of |K0^1/2 x| for displacements from the mean pose and for twists along the motion
    """

    stand: Stand
    K0: Array
    S: Array
    wrench: float
    amplitude: float
    speed: float

    def wrench_share(self, R: Array) -> Array:
        """Wrenches R (.., 6), as shares."""
        return wrench_norm(self.K0, self.S, R) / self.wrench

    def displacement_share(self, x: Array) -> Array:
        """Small displacements x (.., 6; m, rad; in E1 about O1), as shares."""
        return norm(self.K0, x) / self.amplitude

    def twist_share(self, V: Array) -> Array:
        """Twists (.., 6), as shares."""
        return norm(self.K0, V) / self.speed

    def lengths(self) -> Array:
        """Displacement along each coordinate (m; m, rad) that has the whole amplitude."""
        if self.stand.hold is not None:
            return self.amplitude / norm(self.K0, self.S.T)
        masses = np.repeat([self.K0[0, 0], np.trace(self.K0[3:, 3:]) / 3], 3)
        return np.asarray(self.amplitude / np.sqrt(masses))


def norm(K0: Array, x: Array) -> Array:
    """|K0^1/2 x| of x (.., 6)."""
    return np.asarray(np.linalg.norm(x @ np.linalg.cholesky(K0), axis=-1))


def wrench_norm(K0: Array, S: Array, R: Array) -> Array:
    """|(S^T K0 S)^-1/2 S^T R| of wrenches R (.., 6)."""
    return np.asarray(np.linalg.norm(R @ S @ np.linalg.inv(np.linalg.cholesky(S.T @ K0 @ S)).T, axis=-1))


def scale_of(stand: Stand, motion: RequiredMotion, programme: Programme) -> Scale:
    """The scales of a required motion. For a carrier held still they are those of the flywheels' own unbalance."""
    fastest = max(motion.harmonics, default=1) if motion.periodic else 12
    M, N = min(max(32, 16 * fastest), 512), len(stand.flywheels)
    course = motion.at(motion.span * np.arange(M) / M, programme.bias)
    mean = course.q.mean(axis=0)

    def locked(q: Array, q_dot: Array) -> list[Moment]:
        return [moment(stand, q, q_dot, np.full(N, phase), np.zeros(N)) for phase in _PHASES]

    still = [now.at for now in locked(mean, np.zeros_like(mean))]
    K0 = np.mean([at.K for at in still], axis=0)
    S = twists(stand.hold)
    if not np.any(course.q_dot):
        omega = 2 * math.pi * max(1, *(abs(n) for n in programme.winding)) / motion.span
        forces = wrench_norm(K0, S, np.mean([np.abs(at.I) for at in still], axis=0).T)
        first_moments = sum(s.mass * math.hypot(*s.center_of_mass[1:]) for s in stand.flywheels)
        unbalance = float(first_moments / math.sqrt(K0[0, 0]) or largest(forces))
        if stand.hold is not None:
            unbalance = float(forces.sum())
        return Scale(stand, K0, S, unbalance * omega**2, unbalance, unbalance * omega)
    rows = []
    for q, q_dot, q_ddot in zip(*course, strict=True):
        needed = locked(q, q_dot)
        P = np.mean([demand(now.at, now.V_dot(q_ddot)) for now in needed], axis=0)
        rows.append((P, needed[0].carrier.A @ (q - mean), needed[0].at.V))
    P, away, V = (np.array(column) for column in zip(*rows, strict=True))
    wrench = wrench_norm(K0, S, P - np.mean(P, axis=0))
    return Scale(stand, K0, S, *(float(np.max(x)) for x in (wrench, norm(K0, away), norm(K0, V))))


RTOL = 1e-12
STEP_ERROR = 1e-9
"""Error of a step, over the amplitude."""


def simulate(
    stand: Stand,
    angles: Callable[[Array], Angles],
    start: Array,
    t: Array,
    scale: Scale,
    longest: float,
    *,
    error: float = STEP_ERROR,
    furthest: float = np.inf,
    rows: bool = False,
) -> Array:
    """y = (q, q') (M, 2 m) at the times t (M, s) by (8), from `start` at the first; no step longer than `longest` (s).

    `error`: of a step, share of the amplitude. `rows`: no step goes over one of the times, because the third derivative
    of the angles jumps there. StateError where the motion cannot be followed, or is `furthest` amplitudes from the
    start.
    """
    from scipy.integrate import DOP853

    def rates(now: float, y: Array) -> Array:
        q, q_dot = np.split(y, 2)
        phi, phi_dot, phi_ddot = (row[0] for row in angles(np.array([now])))
        return np.concatenate([q_dot, free_acceleration(stand, q, q_dot, phi, phi_dot, phi_ddot)])

    lengths = scale.lengths()
    atol = error * np.concatenate([lengths, lengths * scale.speed / scale.amplitude])
    solver = DOP853(
        rates, t[0], start, t[-1], rtol=RTOL, atol=atol, max_step=longest, first_step=min(longest, t[1] - t[0])
    )
    states = [start]
    for stop in t[1:] if rows else t[-1:]:
        solver.t_bound, solver.status = stop, "running"
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise StateError(f"the simulation stops at t = {solver.t:.6g} s: {message}")
            if np.any(np.abs(solver.y - start)[: len(lengths)] > furthest * lengths):
                raise StateError(f"{furthest:g} amplitudes from the required motion at t = {solver.t:.6g} s")
            passed = t[(t > solver.t_old) & (t < solver.t)]
            states += [*solver.dense_output()(passed).T] if len(passed) else []
            states += [solver.y] if solver.t in t else []
    return np.array(states)


DIFFERENCE = 1e-6
"""Step of a difference, m, rad."""

FREE = 1e-6
"""Part of the largest stiffness below which the stand is free to move in a direction."""

TURN = 1e-10
"""Length of the last step, rad and m."""


def rest_near(stand: Stand, phi: Array, q: Array, K0: Array) -> tuple[Array, Array]:
    """The equilibrium q (m) for phases phi (N) that Newton's steps, least in K0, find from q, and directions (6, n).

    In these the carrier is free: displacements in E1, orthogonal in K0. StateError: there is no equilibrium.
    """
    still, none = np.zeros_like(phi), np.zeros_like(q)

    def pull_at(q: Array) -> Array:
        return free_acceleration(stand, q, none, phi, still, still)

    for _ in range(50):
        A = carrier_at(stand, q, none).A
        root = np.linalg.cholesky(A.T @ K0 @ A).T  # x^T A^T K0 A x = |root x|^2
        pull = root @ pull_at(q)
        slope = np.array([pull_at(q + x) - pull_at(q - x) for x in DIFFERENCE * np.eye(len(q))]).T / (2 * DIFFERENCE)
        U, sigma, Vt = np.linalg.svd(root @ slope @ np.linalg.inv(root))
        kept = sigma > FREE * max(sigma[0], 1e-9)
        step = np.linalg.solve(root, -(Vt[kept].T @ ((U[:, kept].T @ pull) / sigma[kept])))
        q = q + step * min(1.0, 0.3 / max(float(np.abs(step).max()), 1e-300))
        if np.abs(step).max() < TURN:
            left = float(np.linalg.norm(U[:, ~kept].T @ pull))
            if left > 1e-6 * max(float(np.linalg.norm(stand.gravity)), 1.0) * root[0, 0]:
                break
            return q, A @ np.linalg.solve(root, Vt[~kept].T)
    raise StateError("no equilibrium to start from: with the flywheels at rest the carrier accelerates everywhere")
