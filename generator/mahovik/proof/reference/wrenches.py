"""External wrenches, (7): each body's own, in its frame about its origin, and those of the laws of `laws/`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.state import State
from mahovik.proof.reference.array import Array, vector
from mahovik.proof.reference.bodies import FixedBody, PlacedBody, SpinningFlywheel
from mahovik.proof.reference.pose import Pose
from mahovik.proof.reference.wrench_kinds import Kinds


def body_wrenches(body: Body, gravity: Array, V_r: Array, given: Array) -> Kinds:
    """Wrenches (6; N, N m) on one body by kind, in its own frame about its origin; their sum is P of (7).

    `gravity` (3, m/s2), `V_r` (6, twist relative to the fluid) in its frame; `given` (6) is the run-time wrench.
    """
    kinds: dict[str, Array] = {}
    for wrenches in laws.of_bodies("reference", "wrenches"):
        kinds |= wrenches(body, gravity, V_r)
    return kinds | {"run-time": given}


def run_time_wrench(state: State, body: Body) -> Array:
    """The caller's wrench (6; N, N m) on a body, in its own frame about its origin."""
    return vector(state.wrench.get(body.name, (0.0,) * 6))


def external_wrenches(
    stand: Stand,
    state: State,
    *,
    C: Array,
    V: Array,
    V_r: Array,
    fixed: Sequence[FixedBody],
    flywheels: Sequence[SpinningFlywheel],
) -> dict[str, Kinds]:
    """Every wrench of (7) by body name and kind, (6; N, N m) each in its body's frame about its origin.

    V, V_r (6): twists of E1 relative to E0 and to the fluid. The laws of `laws/` count among the carrier's.
    """
    gravity = C.T @ vector(stand.gravity)  # in E1
    P: dict[str, Kinds] = {}
    bodies: tuple[PlacedBody, ...] = (*fixed, *flywheels)
    for k in bodies:
        C_k = k.L[:3, :3]
        P[k.body.name] = body_wrenches(k.body, C_k.T @ gravity, k.twist(V_r), run_time_wrench(state, k.body))
    at = Pose(vector(state.position), C, V)
    for law in laws.parts("reference"):
        P[stand.carrier.name] = {**P[stand.carrier.name], **law.wrenches(stand, state, at)}
    return P


def total_wrench(P: Mapping[str, Array], fixed: Sequence[FixedBody], flywheels: Sequence[SpinningFlywheel]) -> Array:
    """F = P_1 + sum_p Lp P_p + sum_s Ls P_s (6; N, N m), in E1 about O1, (7)."""
    bodies: tuple[PlacedBody, ...] = (*fixed, *flywheels)
    return np.asarray(sum((k.L @ P[k.body.name] for k in bodies), np.zeros(6)))
