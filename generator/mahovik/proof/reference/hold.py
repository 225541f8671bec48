"""Held carrier: V = S u, S (6 x m) constant in E1; (8) with the wrench R of the hold, which does no work, S^T R = 0.

K S u* + K d + M V_r + I phi'' + J phi' = F + R, d = (omega x C^T u, 0) of the stream. All unknowns, R among them, are
found together. A free carrier is the one with S = E, R = 0.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Stand, Vec6
from mahovik.core.stand.state import State
from mahovik.errors import StateError, count_numbers
from mahovik.proof.reference.array import Array, Values, solve, stack, vector
from mahovik.proof.reference.motion import bias, coupled, forward, spin_up_torque
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.screw import E6, E, wrench_to_parent, zero


@dataclass(frozen=True, eq=False)
class HeldMotion:
    """u_dot (m), V_dot (6) in E1 and the reaction R (6; N, N m): wrench of the hold on the carrier, in E1 about O1."""

    u_dot: Array
    V_dot: Array
    reaction: Array


def unit(freedom: Freedom) -> Array:
    """Direction of a freedom (3), of length 1."""
    d = vector(freedom.direction)
    d = d / np.max(np.abs(d))
    return np.asarray(d / np.sqrt(d @ d))


def twists(hold: Hold | None) -> Array:
    """S (6 x m): a frame at the pivot r, with the axes of E1, has the twist L^T V of the carrier, L = T(r).

    A turn is (0; axis) of that frame, so V = T(-r)^T (0; axis); a slide is (direction; 0) of any frame. E without hold.
    """
    if hold is None:
        return E6
    to_O1, still = wrench_to_parent(-vector(hold.pivot), E).T, zero[0]
    columns = []
    for freedom in hold.freedoms:
        if freedom.kind == "twist":
            columns.append(vector(freedom.twist))
        else:
            parts = (unit(freedom), still) if freedom.kind == "slide" else (still, unit(freedom))
            columns.append(to_O1 @ np.concatenate(parts))
    return stack(columns, 6).T


def held_state(stand: Stand, state: State) -> State:
    """The state with V = S u, V* = S u*; as it is where the carrier is free. StateError: u of another length."""
    if stand.hold is None:
        return state
    S = twists(stand.hold)
    for name, given in (("u", state.u), ("u_dot", state.u_dot)):
        if len(given) != S.shape[1]:
            raise StateError(f"{name}: expected {count_numbers(S.shape[1])}, found {len(given)}")
    V, V_dot = (cast(Vec6, tuple((S @ vector(given)).tolist())) for given in (state.u, state.u_dot))
    return replace(state, V=V, V_dot=V_dot)


def held_forward(at: Pieces, hold: Hold, phi_ddot: Array) -> HeldMotion:
    """Motion and reaction for given phi_ddot (N): K S u* - R = F - K d - M V_r - J phi' - I phi'', S^T R = 0."""
    return _held_motion(at, hold, np.zeros(len(phi_ddot)), phi_ddot, np.zeros(len(phi_ddot), dtype=bool))[0]


def held_coupled(at: Pieces, hold: Hold, tau: Array, locked: Array | None = None) -> tuple[HeldMotion, Array]:
    """Motion, reaction and phi'' (N) for given drive torques tau (N): m + N + 6 unknowns u*, phi'', R.

    Besides the above I^T S u* + Theta_ff phi'' = tau - velocity terms + f^T P_s - I^T d. `locked` (N, bool): flywheels
    kept at phi'' = 0, without their rows and columns.
    """
    free = np.full(len(tau), True) if locked is None else np.logical_not(locked)
    return _held_motion(at, hold, tau, np.zeros(len(tau)), free)


def _held_motion(at: Pieces, hold: Hold, tau: Array, phi_ddot: Array, free: Array) -> tuple[HeldMotion, Array]:
    """Motion and phi'' (N) by the torques of the flywheels that are `free` (N, bool), and by phi'' of the others."""
    S, d = twists(hold), at.stream_rate()
    m, N = S.shape[1], len(phi_ddot)
    system = np.block(
        [
            [at.K @ S, at.I, -E6],
            [at.I.T @ S, at.Theta_ff, np.zeros((N, 6))],
            [np.zeros((m, m)), np.zeros((m, N)), S.T],
        ]
    )
    carrier = at.F - bias(at) - at.I @ phi_ddot - at.K @ d
    right = np.concatenate([carrier, spin_up_torque(at, tau) - at.I.T @ d, np.zeros(m)])
    rows, unknowns = (np.concatenate([np.full(k, True), free, np.full(n, True)]) for k, n in ((6, m), (m, 6)))
    found = np.concatenate([np.zeros(m), phi_ddot, np.zeros(6)]).astype(right.dtype)
    found[unknowns] = solve(system[np.ix_(rows, unknowns)], right[rows])
    u_dot, phi_ddot, R = np.split(found, [m, m + N])
    return HeldMotion(u_dot, S @ u_dot, R + 0.0), phi_ddot  # no -0.0


def acceleration(at: Pieces, stand: Stand, phi_ddot: Array) -> Array:
    """V* (6) of a free or held carrier for given phi_ddot (N)."""
    return forward(at, phi_ddot) if stand.hold is None else held_forward(at, stand.hold, phi_ddot).V_dot


def accelerations(at: Pieces, stand: Stand, tau: Array, locked: Array) -> tuple[Array, Array]:
    """V* (6) of a free or held carrier and phi'' (N) for given drive torques, with locks (N, bool)."""
    if stand.hold is None:
        return coupled(at, tau, locked)
    motion, phi_ddot = held_coupled(at, stand.hold, tau, locked)
    return motion.V_dot, phi_ddot


def answer_held_coupled(at: Pieces, hold: Hold, state: State) -> Values:
    """u_dot (m), V_dot, reaction (6), phi_ddot (N)."""
    motion, phi_ddot = held_coupled(at, hold, vector(state.tau))
    return vars(motion) | {"phi_ddot": phi_ddot}
