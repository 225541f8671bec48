"""A free motion of some seconds under constant drive torques: by the C, and by a judge in its own coordinates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, cast

import numpy as np

from mahovik.core.stand.model import Stand, Vec3, Vec6
from mahovik.core.stand.random_state import random_state
from mahovik.core.stand.state import Quaternion, State
from mahovik.proof import reference
from mahovik.proof.verify.judges.rigid import Array, MovingJudge, OutsideJudge, attitude, quaternion_rate

UNTIL = 2.0
"""s; of what is published. Tests that break a judge on purpose see it sooner."""

INTEGRATION = 1e-13
"""Relative tolerance of a step of either integration."""

MOTION_TOLERANCE = 1e-10
"""A thousand steps of 1e-13 each, on two sides."""

SPEED, ACCELERATION = 20.0, 10.0
"""rad/s, rad/s2 of the flywheels: some turns in the time."""


@dataclass(frozen=True, eq=False)
class Part:
    """One part of the last state, and what a difference of it is measured against."""

    values: Array
    scale: Array


def moderate(stand: Stand, seed: int) -> State:
    """A state from which 1e-13 a step is kept up: speeds of some turns in the time, torques to match."""
    rng = np.random.default_rng(seed)
    state = random_state(stand, rng)
    inertia = np.diag(reference.pieces(stand, state).Theta_ff)
    N = len(stand.flywheels)
    speeds = rng.uniform(0.3, 1.0, N) * rng.choice([-1.0, 1.0], N) * SPEED
    torques = rng.uniform(-1.0, 1.0, N) * ACCELERATION * inertia
    return replace(
        state, phi_dot=tuple(map(float, speeds)), tau=tuple(map(float, torques)), wrench=MappingProxyType({})
    )


def end_of_motion(
    stand: Stand,
    state: State,
    coupled: Callable[[State], tuple[Vec6, tuple[float, ...]]],
    judge: OutsideJudge | MovingJudge,
    until: float = UNTIL,
) -> tuple[dict[str, Part], dict[str, Part]]:
    """The state after `until` s by `coupled`, which gives V* and phi'' of a state, and by the judge."""
    tau = np.array(state.tau)
    turn = attitude(stand, state).as_quat(scalar_first=True)
    begin = np.concatenate([state.position, turn, state.V, state.phi, state.phi_dot])
    N = len(tau)

    def rates(y: Array) -> Array:
        q = y[3:7] / np.linalg.norm(y[3:7])
        V, phi, phi_dot = y[7:13], y[13 : 13 + N], y[13 + N :]
        moved = replace(
            state,
            position=cast(Vec3, tuple(y[:3].tolist())),
            angles=None,
            quaternion=cast(Quaternion, tuple(q.tolist())),
            V=cast(Vec6, tuple(V.tolist())),
            phi=tuple(phi.tolist()),
            phi_dot=tuple(phi_dot.tolist()),
        )
        V_dot, phi_ddot = coupled(moved)
        return np.concatenate([_matrix(q) @ V[:3], quaternion_rate(q, V[3:]), V_dot, phi_dot, phi_ddot])

    y = integrated(rates, begin, until)
    q = y[3:7] / np.linalg.norm(y[3:7])
    own = (y[:3], _matrix(q), y[7:13], y[13 : 13 + N], y[13 + N :])
    if isinstance(judge, MovingJudge):
        other = judge.moved(state, until)
    else:
        theirs = integrated(lambda y: judge.rates(y, tau), judge.own_coordinates(state), until)
        other = judge.pose_and_velocity(theirs)
    sizes = _sizes(own, until)
    return _parts(own, sizes), _parts(other, sizes)


def _parts(values: tuple[Array, ...], sizes: tuple[Array, ...]) -> dict[str, Part]:
    names = ("position", "C", "V", "phi", "phi_dot")
    return {name: Part(value, size) for name, value, size in zip(names, values, sizes, strict=True)}


def integrated(rates: Callable[[Array], Array], begin: Array, until: float = UNTIL) -> Array:
    """y after `until` s."""
    from scipy.integrate import solve_ivp  # slow to import, and not all who compare states integrate

    options: dict[str, Any] = {"method": "DOP853", "rtol": INTEGRATION, "atol": INTEGRATION}
    found = solve_ivp(lambda _, y: rates(y), (0.0, until), begin, **options)
    return np.asarray(found.y[:, -1])


def _sizes(own: tuple[Array, ...], until: float) -> tuple[Array, ...]:
    """Scales: ways and turns by how far things move in the time, velocities by the fastest of them."""
    position, C, V, phi, phi_dot = own
    v, omega = float(np.linalg.norm(V[:3])), float(np.linalg.norm(V[3:]))
    spin = float(np.abs(phi_dot).max(initial=0.0)) + omega
    return (
        np.full(3, float(np.linalg.norm(position)) + v * until),
        np.full_like(C, 1.0 + spin * until),
        np.repeat([v, omega + spin], 3),
        np.full_like(phi, 1.0 + spin * until),
        np.full_like(phi_dot, spin),
    )


def _matrix(q: Array) -> Array:
    """C (3x3) of a unit quaternion, w first."""
    w, v = q[0], q[1:]
    cross = np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)
