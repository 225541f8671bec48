"""The inverse problem, (12), and tasks: flywheel accelerations, or torques, for a prescribed motion; free or held.

A held carrier has the rows S^T of (8), a free one all six: S = E. Without units the demand is W y = r, solved by
singular values; weights and damping are the options of the emitted C; (13) has the flywheels in two parts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.functions import inverse_fault
from mahovik.core.stand.model import COMPONENTS, Motor, Stand, State, Task
from mahovik.errors import StateError
from mahovik.proof.reference.algebra import E6, Array, Values, cross, solve, solve_symmetric, vector
from mahovik.proof.reference.motion import (
    coupled,
    forward,
    full_mass_matrix,
    point_transfers,
    spin_up_torque,
    torque,
)
from mahovik.proof.reference.pieces import Pieces


@dataclass(frozen=True)
class Cuts:
    """Thresholds of rank and status, for double.

    rank           of the first singular value: those below are taken as zero
    near_singular  of the first singular value: a smallest kept one below this is NEAR_SINGULAR
    reached        scaled residual over scaled demand above this is UNREACHABLE
    """

    rank: float = 1e-9
    near_singular: float = 1e-6
    reached: float = 1e-9


CUTS = Cuts()
"""Thresholds for double."""


@dataclass(frozen=True, eq=False)
class Inverse:
    """phi_ddot (N, rad/s2), status (names joined by |), residual (m; N, N m), sigma (min(m, N)), rank."""

    phi_ddot: Array
    status: str
    residual: Array
    sigma: Array
    rank: int


@dataclass(frozen=True, eq=False)
class ScaledDemand:
    """A phi'' = c, A (mxN), c (m), as W y = r without units: W = root A Theta_ff^-1/2, y = Theta_ff^1/2 phi''.

    `root` (mxm) scales what is left over: (S^T K S)^-1/2 of a wrench, G^-1/2 of a task's error. So the singular values
    of W are the same for any units, origin and axes. `to_phi_ddot` (N): the diagonal of Theta_ff^-1/2.
    """

    A: Array
    c: Array
    root: Array
    to_phi_ddot: Array

    @property
    def W(self) -> Array:
        """The scaled matrix (mxN)."""
        return self.root @ self.A * self.to_phi_ddot

    @property
    def r(self) -> Array:
        """The scaled demand (m)."""
        return self.root @ self.c

    def phi_ddot(self, y: Array) -> Array:
        """phi'' (N, rad/s2) of a scaled answer."""
        return self.to_phi_ddot * y


def inverse_root(S: Array) -> Array:
    """S^-1/2 of a symmetric positive definite S: G^-1 of S = G G^T.

    Any such factor gives the same singular values, norms and answer; this one loses no digits to mixed units.
    """
    return np.asarray(np.linalg.inv(np.linalg.cholesky(S)))


def demand(at: Pieces, V_dot: Array) -> Array:
    """I phi'' of (12): F - K V* - M V - J phi' (6; N, N m), for V_dot (6) relative to E0."""
    return at.F - at.K @ V_dot - at.bias


def scaled_demand(at: Pieces, V_dot: Array) -> ScaledDemand:
    """S^T I phi'' = S^T (F - K V* - M V - J phi') for V_dot (6) relative to E0, in the norm of (S^T K S)^-1."""
    S = at.S
    return ScaledDemand(
        S.T @ at.I, S.T @ demand(at, V_dot), inverse_root(S.T @ at.K @ S), 1.0 / np.sqrt(np.diag(at.Theta_ff))
    )


def weights(stand: Stand) -> Array:
    """`inverse_weight` of the flywheels (N)."""
    return vector([s.inverse_weight for s in stand.flywheels])


def least_error(scaled: ScaledDemand, weight: Array, cuts: Cuts = CUTS) -> Inverse:
    """Least |r - W y|, then least sum weight_s y_s^2."""
    W, r = scaled.W, scaled.r
    U, sigma, Vt = np.linalg.svd(W, full_matrices=False)
    rank = int(np.sum(sigma > cuts.rank * sigma[0])) if sigma.size else 0
    if np.all(weight == 1.0):
        phi_ddot = scaled.phi_ddot(Vt[:rank].T @ ((U[:, :rank].T @ r) / sigma[:rank]))
    else:
        phi_ddot = weighted_solution(scaled, weight, rank)
    residual = scaled.c - scaled.A @ phi_ddot
    bits = {
        "NEAR_SINGULAR": rank and sigma[rank - 1] < cuts.near_singular * sigma[0],
        "UNREACHABLE": np.linalg.norm(scaled.root @ residual) > cuts.reached * np.linalg.norm(r),
        "RANK_DEFICIENT": rank < min(W.shape),
    }
    return Inverse(phi_ddot, status_of(bits), residual, sigma, rank)


def status_of(bits: Mapping[str, Any]) -> str:
    """Names of those of contract/status.py that are set, joined by |, in the order of their bits."""
    return "|".join(name for name, is_set in bits.items() if is_set) or "OK"


def answer_inverse(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), status, residual (m), sigma (min(m, N)), rank: (12). StateError: no freedoms, or no flywheels."""
    if stand.hold is not None and (fault := inverse_fault(len(stand.hold.freedoms), len(at.phi_dot))):
        raise StateError(f"want: {fault}")
    answer = least_error(scaled_demand(at, vector(state.V_dot)), weights(stand), cuts)
    return vars(answer) | with_excess(answer, at, stand, forward(at, answer.phi_ddot))


# Weights and damping: what the options of the emitted C mean.


def weighted_solution(
    scaled: ScaledDemand, weight: Array, rank: int, near_singular: float = 0.0, damping: float = 0.0
) -> Array:
    """phi'' (N): least |r - W y| in the first `rank` singular directions, then least sum weight_s y_s^2.

    Damping: where sigma_i < near_singular sigma_1, the demand in that direction is multiplied by
    sigma_i^2/(sigma_i^2 + lambda_i^2), lambda_i = damping sigma_1 (1 - sigma_i/(near_singular sigma_1)).
    """
    U, sigma, Vt = np.linalg.svd(scaled.W, full_matrices=False)
    wanted = (U.T @ scaled.r)[:rank]
    for i in range(rank):
        if sigma[i] < near_singular * sigma[0]:
            share = damping * sigma[0] * (1 - sigma[i] / (near_singular * sigma[0]))
            wanted[i] *= sigma[i] ** 2 / (sigma[i] ** 2 + share**2)
    root = 1 / np.sqrt(weight)
    rows = (sigma[:rank, None] * Vt[:rank]) * root
    return scaled.phi_ddot(np.asarray(root * (np.linalg.pinv(rows, rcond=0.0) @ wanted), dtype=np.float64))


def largest_damping(scaled: ScaledDemand, rank: int, near_singular: float, damping: float) -> float:
    """The largest lambda_i that `weighted` applies; 0 where it applies none."""
    if rank == 0:
        return 0.0
    sigma = np.linalg.svd(scaled.W, compute_uv=False)[:rank]
    ratios = sigma / sigma[0]
    return float(max((damping * sigma[0] * (1 - x / near_singular) for x in ratios if x < near_singular), default=0.0))


def normal_matrix(scaled: ScaledDemand, weight: Array, damping: float) -> Array:
    """Matrix of `inverse_fast`: W Omega^-1 W^T + lambda^2 E of six flywheels and more, W^T W + lambda^2 E of fewer.

    lambda^2 is damping^2 times the trace of the matrix without it; Omega = diag(weight).
    """
    W = scaled.W
    gram = (W / weight) @ W.T if W.shape[1] >= len(scaled.r) else W.T @ W
    return np.asarray(gram + damping**2 * np.trace(gram) * np.eye(len(gram)))


def least_pivot(gram: Array) -> float:
    """The least part of a diagonal element that is left of it as a pivot of gram = L D L^T."""
    try:
        pivots = np.diag(np.linalg.cholesky(gram)) ** 2
    except np.linalg.LinAlgError:
        return 0.0
    return float(np.min(pivots / np.diag(gram), initial=1.0))


# EXCESSIVE: an answer that needs more than the motors have.


def available(motor: Motor, tau: float, speed: float) -> float:
    """Torque (N m) that the motor has in the sense of tau at a speed (rad/s).

    Driving, it falls linearly from the limit at rest to 0 at the no-load speed and beyond; braking, it is the limit. A
    curve limits both: straight lines between its points, beyond them the last; without negative speeds by |speed|.
    """
    most = np.inf if motor.torque is None else motor.torque
    if motor.torque_speed:
        speeds, torques = np.transpose(motor.torque_speed)
        most = min(most, float(np.interp(speed if speeds[0] < 0 else abs(speed), speeds, torques)))
    if motor.speed is None or tau * speed <= 0:
        return most
    share = max(0.0, 1.0 - abs(speed) / motor.speed)
    return most * share if share else 0.0


def friction(motor: Motor, speed: float) -> float:
    """Torque of friction on the flywheel at a speed (rad/s), N m: viscous, and dry as the servos compensate it.

    Dry friction is y (27 + y^2) / (27 + 9 y^2) of its whole, y the speed over `coulomb_speed` inside -3..3: tanh y to
    0.024.
    """
    y = min(max(speed / motor.coulomb_speed, -3.0), 3.0)
    return -motor.viscous * speed - motor.coulomb * y * (27.0 + y * y) / (27.0 + 9.0 * y * y)


def shares_of(stand: Stand, at: Pieces, tau: Array, phi_ddot: Array) -> Array:
    """Need of each flywheel over what it has (N), for drive torques tau (N, N m); above 1 is too much.

    Torque of the motor, which gives tau_s and bears the friction, over what it has; without a motor, or of one without
    limits, |phi_s''| over `inverse_most`.
    """
    shares = np.zeros(len(stand.flywheels))
    for k, wheel in enumerate(stand.flywheels):
        motor = wheel.motor
        if motor is None or (motor.torque is None and motor.speed is None and not motor.torque_speed):
            shares[k] = abs(phi_ddot[k]) / stand.inverse_most
            continue
        needed = tau[k] - friction(motor, at.phi_dot[k])
        most = available(motor, needed, at.phi_dot[k])
        shares[k] = abs(needed) / most if most else (np.inf if needed else 0.0)
    return shares


def with_excess(answer: Inverse, at: Pieces, stand: Stand, V_dot: Array) -> dict[str, str]:
    """The status of an answer that gives the motion V_dot (6), with EXCESSIVE, the last of the bits."""
    needed = shares_of(stand, at, torque(at, V_dot, answer.phi_ddot), answer.phi_ddot)
    known = {} if answer.status == "OK" else {answer.status: True}
    return {"status": status_of(known | {"EXCESSIVE": np.any(needed > 1.0)})}


# Optimal control, (13): flywheels in two parts, N - 6 independent (minus), 6 dependent (plus).


def dependent_acceleration(at: Pieces, V_dot: Array, plus: Sequence[int], u: Array) -> Array:
    """phi_+'' = I+^-1 (P(t) - I- u - J phi') (6, rad/s2), (13), for the carrier's V_dot (6) relative to E0.

    `plus` (6) are the indices of the dependent flywheels, in the order of the answer; u = phi_-'' (N - 6, rad/s2)
    those of the others, in the file's order. det I+ = 0 raises numpy.linalg.LinAlgError.
    """
    minus = [s for s in range(len(at.phi_dot)) if s not in plus]
    return solve(at.I[:, list(plus)], demand(at, V_dot) - at.I[:, minus] @ u)


def determinant(at: Pieces, plus: Sequence[int]) -> float:
    """det I+ of (13): in units of kg^6 m^9, its sign is what matters."""
    return float(np.linalg.det(at.I[:, list(plus)]))


# -- tasks -------------------------------------------------------------------------------------------------------------

Flags = NDArray[np.bool_]

_SMALL = 1e-6
"""Weight of |y| against |r - W y|, relative to W, while the flywheels at a bound are sought."""

_RANK = 1e-9


@dataclass(frozen=True, eq=False)
class TaskRows:
    """a = S V* + s: S (mx6) constant, s (m) at one state; m/s2 and rad/s2."""

    S: Array
    s: Array

    def acceleration(self, V_dot: Array) -> Array:
        """a (m) of a motion V_dot (6)."""
        return self.S @ V_dot + self.s


def task_of(stand: Stand, name: str) -> Task:
    """The task of a name. Raises StateError."""
    for task in stand.tasks:
        if task.name == name:
            return task
    raise StateError(f'task: unknown "{name}", the stand has {", ".join(task.name for task in stand.tasks) or "none"}')


def task_rows(at: Pieces, stand: Stand, task: Task) -> TaskRows:
    """Rows of a task: of O1 the components of V*, of a point those of its acceleration relative to E0, in its axes.

    With L of the point, V_p* = L^T V* are the derivatives of the components of its twist V_p = L^T V = (v, omega), and
    its acceleration is (V_p* + omega x v): hence s.
    """
    transfers = point_transfers(stand)
    S, s = [], []
    for row in task.rows:
        k, L = COMPONENTS.index(row.component), transfers.get(row.of, E6)
        V_p = L.T @ at.V
        S.append(L[:, k])
        s.append((cross(V_p[3:]) @ V_p[:3])[k] if row.of and k < 3 else 0.0)
    return TaskRows(np.array(S), np.array(s))


def task_of_state(at: Pieces, stand: Stand, state: State) -> tuple[TaskRows, Array]:
    """Rows of the state's task and its demand (m). Raises StateError."""
    task = task_of(stand, state.task)
    if len(state.demand) != len(task.rows):
        raise StateError(f"demand: expected {len(task.rows)} numbers, found {len(state.demand)}")
    return task_rows(at, stand, task), vector(state.demand)


def scaled_task(at: Pieces, rows: TaskRows, demand: Array) -> ScaledDemand:
    """S K^-1 I phi'' = S K^-1 b + s - a for the demand a (m), in the norm of G^-1, G = S K^-1 S^T.

    G^-1/2 is R^-T of K^-1/2 S^T = Q R, which loses no digits to the squares in G.
    """
    to_motion = np.array([solve_symmetric(at.K, row) for row in rows.S])  # S K^-1
    c = to_motion @ (at.F - at.bias) + rows.s - demand
    R = np.asarray(np.linalg.qr(inverse_root(at.K) @ rows.S.T, mode="r"), dtype=np.float64)
    return ScaledDemand(to_motion @ at.I, c, np.asarray(np.linalg.inv(R.T)), 1.0 / np.sqrt(np.diag(at.Theta_ff)))


def answer_task(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), V_dot (6), residual (m), sigma (min(m, N)), rank, status of the state's task. Raises StateError.

    Least error of the demand in the norm of G^-1, then least phi'' in the norm of Theta_ff and the weights.
    """
    rows, demand = task_of_state(at, stand, state)
    least = least_error(scaled_task(at, rows, demand), weights(stand), cuts)
    V_dot = forward(at, least.phi_ddot)
    motion = {"V_dot": V_dot, "residual": demand - rows.acceleration(V_dot)}
    return vars(least) | motion | with_excess(least, at, stand, V_dot)


# Drive torques of a task within what the motors have: least error, then least torque.


@dataclass(frozen=True, eq=False)
class TorqueDemand(ScaledDemand):
    """A x = c for x = tau - preferred (N, N m) in the place of phi'': `to_phi_ddot` is Theta_ff^1/2, a = a_0 + A tau.

    preferred  tau (N, N m) that gives the preferred accelerations to flywheels on a carrier with V* = 0
    """

    preferred: Array

    def torque(self, y: Array) -> Array:
        """tau (N, N m) of a scaled answer."""
        return self.preferred + self.phi_ddot(y)

    def from_torque(self, tau: Array) -> Array:
        """y (N) of torques."""
        return np.asarray((tau - self.preferred) / self.to_phi_ddot)


def torque_demand(at: Pieces, rows: TaskRows, demand: Array, preferred: Array, locked: Array) -> TorqueDemand:
    """The equation for the demand a (m), preferred accelerations (N, rad/s2) and `locked` (N, bool) flywheels."""
    N = len(at.phi_dot)
    free = np.concatenate([np.full(6, True), np.logical_not(locked)])
    X = np.zeros((6 + N, 6 + N))
    X[np.ix_(free, free)] = np.linalg.inv(full_mass_matrix(at)[np.ix_(free, free)])
    a_0 = rows.acceleration(coupled(at, np.zeros(N), locked)[0])
    B = rows.S @ X[:6, 6:]
    root = inverse_root(rows.S @ ((X + X.T) / 2)[:6, :6] @ rows.S.T)
    Theta = np.diag(at.Theta_ff)
    tau = Theta * preferred - spin_up_torque(at, np.zeros(N))
    return TorqueDemand(B, demand - a_0 - B @ tau, root, np.sqrt(Theta), tau)


def motor_bounds(stand: Stand, at: Pieces) -> tuple[Array, Array]:
    """Least and largest torque (N, N m) of the motors at their speeds; infinite without a limit."""
    pairs = [
        (0.0, 0.0) if wheel.motor is None else (available(wheel.motor, -1.0, speed), available(wheel.motor, 1.0, speed))
        for wheel, speed in zip(stand.flywheels, at.phi_dot, strict=True)
    ]
    limited = np.array([wheel.motor is not None for wheel in stand.flywheels], dtype=bool)
    least, most = (np.array([pair[i] for pair in pairs], dtype=np.float64) for i in (0, 1))
    return -np.where(limited, least, np.inf), np.where(limited, most, np.inf)


def least_within(W: Array, r: Array, low: Array, high: Array) -> tuple[Array, Flags]:
    """y (N) inside low..high with the least |r - W y|, of these the least |y|; and which are at no bound (N, bool).

    Which flywheels are at a bound follows from bounded least squares (Stark and Parker 1995) with a small part of |y|;
    the others then solve the problem that is left exactly. Seldom |y| is a little longer than the least: one stays at
    its bound where rounding hides what its release would gain.
    """
    N = len(low)
    A = np.vstack([W, _SMALL * float(np.linalg.norm(W, 2)) * np.eye(N)])
    b = np.concatenate([r, np.zeros(N)])
    y = np.clip(np.linalg.pinv(W, rcond=_RANK) @ r, low, high)
    free = (y > low) & (y < high)
    least = 1e-13 * float(np.linalg.norm(A)) * float(np.linalg.norm(b))
    for _ in range(10 * N):
        _settle(A, b, y, free, low, high)
        push = A.T @ (b - A @ y)
        gain = np.where(free | (low >= high), 0.0, np.where(y <= low, push, -push))
        best = int(np.argmax(gain))
        if gain[best] <= least:
            break
        free[best] = True
    held = np.logical_not(free)
    rest = r - W[:, held] @ y[held]
    y[free] = np.clip(np.linalg.pinv(W[:, free], rcond=_RANK) @ rest, low[free], high[free])
    return y, free


def _settle(A: Array, b: Array, y: Array, free: Flags, low: Array, high: Array) -> None:
    """Move the free y to the least |b - A y|, fixing those that come to a bound on the way."""
    while free.any():
        held = np.logical_not(free)
        wanted = np.linalg.lstsq(A[:, free], b - A[:, held] @ y[held], rcond=None)[0]
        now, least, most = y[free], low[free], high[free]
        outside = (wanted < least) | (wanted > most)
        if not outside.any():
            y[free] = wanted
            return
        bound = np.where(wanted < least, least, most)
        parts = np.full(len(now), np.inf)
        parts[outside] = (bound[outside] - now[outside]) / (wanted[outside] - now[outside])
        first = int(np.argmin(parts))
        y[free] = np.clip(now + parts[first] * (wanted - now), least, most)
        s = int(np.flatnonzero(free)[first])
        y[s], free[s] = bound[first], False


def answer_torque_for(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """tau, phi_ddot (N), V_dot (6), residual (m), limited (N; 1: at a bound), status. Raises StateError."""
    rows, demand = task_of_state(at, stand, state)
    none = np.zeros(len(stand.flywheels))
    asked = torque_demand(at, rows, demand, none, none.astype(bool))
    least, most = motor_bounds(stand, at)
    root = 1.0 / np.sqrt(weights(stand))  # y = root z: the least z
    low, high = asked.from_torque(least) / root, asked.from_torque(most) / root
    z, free = least_within(asked.W * root, asked.r, low, high)
    y = root * z
    tau = np.where(free, asked.torque(y), np.where(z <= low, least, most))
    V_dot, phi_ddot = coupled(at, tau)
    reached = cuts.reached * np.linalg.norm(asked.r)
    bits = {"LIMITED": not free.all(), "UNREACHABLE": np.linalg.norm(asked.r - asked.W @ y) > reached}
    return {
        "tau": tau,
        "phi_ddot": phi_ddot,
        "V_dot": V_dot,
        "residual": demand - rows.acceleration(V_dot),
        "limited": np.logical_not(free).astype(np.int64),
        "status": status_of(bits),
    }
