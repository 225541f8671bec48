"""Drive torques of a task within what the motors have, literally: least error, then least torque."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array, Values, vector
from mahovik.proof.reference.coupled import coupled_with_locks
from mahovik.proof.reference.excess import available
from mahovik.proof.reference.inverse import CUTS, Cuts
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.task import task_of, task_rows
from mahovik.proof.reference.task_torque import torque_demand

Flags = NDArray[np.bool_]

_SMALL = 1e-6
"""Weight of |y| against |r - W y|, relative to W, while the flywheels at a bound are sought."""

_RANK = 1e-9


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


def answer(at: Pieces, stand: Stand, state: State, cuts: Cuts = CUTS) -> Values:
    """tau, phi_ddot (N), V_dot (6), residual (m), limited (N; 1: at a bound), status. Raises StateError."""
    task = task_of(stand, state.task)
    if len(state.demand) != len(task.rows):
        raise StateError(f"demand: expected {len(task.rows)} numbers, found {len(state.demand)}")
    rows, demand = task_rows(at, stand, task), vector(state.demand)
    none = np.zeros(len(stand.flywheels))
    asked = torque_demand(at, rows, demand, none, none.astype(bool))
    least, most = motor_bounds(stand, at)
    low, high = asked.from_torque(least), asked.from_torque(most)
    y, free = least_within(asked.W, asked.r, low, high)
    tau = np.where(free, asked.torque(y), np.where(y <= low, least, most))
    V_dot, phi_ddot = coupled_with_locks(at, tau, none.astype(bool))
    names = ["LIMITED"] if not free.all() else []
    if np.linalg.norm(asked.r - asked.W @ y) > cuts.reached * np.linalg.norm(asked.r):
        names.append("UNREACHABLE")
    return {
        "tau": tau,
        "phi_ddot": phi_ddot,
        "V_dot": V_dot,
        "residual": demand - rows.acceleration(V_dot),
        "limited": np.logical_not(free).astype(np.int64),
        "status": "|".join(names) or "OK",
    }
