"""Tasks: chosen components a = S V* + s of the carrier's motion are demanded, what no row names is free.

By flywheel accelerations: V* = K^-1 (b - I phi'') - d with b = F - M V_r - J phi' and d = (omega x C^T u, 0), so that
S K^-1 I phi'' = S (K^-1 b - d) + s - a. By drive torques within bounds: the motion of `coupled` is affine in the
torques, a = a_0 + B tau with the columns of B by unit torques, so least squares decide.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import COMPONENTS, Stand, State, Task
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, solve_symmetric, vector
from mahovik.proof.reference.inverse import (
    CUTS,
    Cuts,
    ScaledDemand,
    available,
    inverse_root,
    least_error,
    status_of,
    with_excess,
)
from mahovik.proof.reference.motion import (
    bias,
    coupled,
    forward,
    full_mass_matrix,
    point_transfers,
    spin_up_torque,
)
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import E6, cross

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
    """S K^-1 I phi'' = S (K^-1 b - d) + s - a for the demand a (m), in the norm of G^-1, G = S K^-1 S^T.

    G^-1/2 is R^-T of K^-1/2 S^T = Q R, which loses no digits to the squares in G.
    """
    to_motion = np.array([solve_symmetric(at.K, row) for row in rows.S])  # S K^-1
    c = to_motion @ (at.F - bias(at)) - rows.S @ at.stream_rate() + rows.s - demand
    R = np.asarray(np.linalg.qr(inverse_root(at.K) @ rows.S.T, mode="r"), dtype=np.float64)
    return ScaledDemand(to_motion @ at.I, c, np.asarray(np.linalg.inv(R.T)), inverse_root(at.Theta_ff).T)


def answer_task(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """phi_ddot (N), V_dot (6), residual (m), sigma (min(m, N)), rank, status of the state's task. Raises StateError.

    Least error of the demand in the norm of G^-1, then least phi'' in the norm of Theta_ff.
    """
    rows, demand = task_of_state(at, stand, state)
    least = least_error(scaled_task(at, rows, demand), cuts)
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
        return np.asarray((tau - self.preferred) / np.diag(self.to_phi_ddot))


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
    return TorqueDemand(B, demand - a_0 - B @ tau, root, np.diag(np.sqrt(Theta)), tau)


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
    low, high = asked.from_torque(least), asked.from_torque(most)
    y, free = least_within(asked.W, asked.r, low, high)
    tau = np.where(free, asked.torque(y), np.where(y <= low, least, most))
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
