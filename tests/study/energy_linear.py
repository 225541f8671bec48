"""The linear model by automatic differentiation: A, B, C, D of deviations from a motion, for comparison."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import casadi as ca
import numpy as np

from mahovik.contract.laws import parts
from mahovik.core.stand.model import Stand, State
from mahovik.proof.second.body import Array, CarrierEnergy, Expr, turn
from mahovik.proof.second.system import Second, point_names


class Matrices(NamedTuple):
    """x' = A x + B u, y = C x + D u.

    x: place of O1 and rotation vector from the pose in the motion, on E1 as it is there (6), deviations of V (6), phi,
    phi' (N); u: drive torques (N), wrench on the carrier in E1 about O1 (6); y: displacement, velocity, acceleration in
    E0 of every instrument and point, on its axes in the motion (3 each).
    """

    A: Array
    B: Array
    C: Array
    D: Array


def linear(stand: Stand, state: State) -> Matrices:
    """About the motion through `state` with its phi''; V* and drive torques are Lagrange's. Raises StateError."""
    second = Second(stand)
    V_dot = second.evaluate(state, ["forward"])["V_dot"]
    moving = replace(state, V_dot=tuple(V_dot.tolist()))
    tau = second.evaluate(moving, ["torque"])["tau"]
    N = len(stand.flywheels)
    x, u = ca.MX.sym("x", 12 + 2 * N), ca.MX.sym("u", N + 6)
    e, eta, V, phi, phi_dot = ca.vertsplit(x, [0, 3, 6, 12, 12 + N, 12 + 2 * N])
    at = second.arguments(moving)
    place, C = at["position"] + at["C"] @ e, ca.DM(at["C"]) @ turn(eta)
    arguments: dict[str, Any] = {
        **at,
        "position": place,
        "C": C,
        "V": at["V"] + V,
        "phi": at["phi"] + phi,
        "phi_dot": at["phi_dot"] + phi_dot,
        "tau": tau + u[:N],
        "wrench": ca.horzcat(at["wrench"][:, 0] + u[N:], at["wrench"][:, 1:]),
    }
    for law in parts("energy", CarrierEnergy):
        arguments |= law.arguments_near(stand, at["C"], place, C)
    acceleration = second.function("coupled")(**arguments)
    rate = acceleration["coupled_V_dot"]
    drift = _drift(e, eta, at["V"], arguments["V"])
    x_dot = ca.vertcat(*drift, rate, phi_dot, acceleration["coupled_phi_ddot"])
    y = ca.vertcat(ca.MX.zeros(0), *_outputs(second, moving, {**arguments, "V_dot": rate}))
    blocks = [ca.jacobian(f, z) for f in (x_dot, y) for z in (x, u)]
    values = ca.Function("linear", [x, u], blocks)(np.zeros(12 + 2 * N), np.zeros(N + 6))
    return Matrices(*(matrix.full() for matrix in values))


def _drift(e: Expr, eta: Expr, V0: Array, V: Expr) -> tuple[Expr, Expr]:
    """Rates of place and rotation vector, seen from axes that move with the motion itself at V0."""
    v0, omega0, v, omega = V0[:3], V0[3:], V[:3], V[3:]
    shift = turn(eta) @ v - v0 - ca.cross(omega0, e)
    return shift, (omega + ca.cross(eta, omega) / 2) - (omega0 - ca.cross(eta, omega0) / 2)


def _outputs(second: Second, state: State, arguments: dict[str, Any]) -> Iterator[Expr]:
    """Place, velocity and acceleration (less gravity, a constant) in E0 of every point, on its axes as they are."""
    known = point_names(second.stand)
    if not known:
        return
    still = second.evaluate(state, ["points"])["points"]
    answers = second.function("points")(**arguments)
    for k, name in enumerate(known):
        to_own = still[name]["C"].T
        axes = to_own @ answers["points_C"][:, 3 * k : 3 * k + 3]
        yield to_own @ answers["points_position"][:, k]
        yield axes @ answers["points_twist"][:3, k]
        yield axes @ answers["points_specific_force"][:, k]
