"""Held carrier by the principle of d'Alembert and Lagrange: along what is free, no work of the hold.

The energies are those of the carrier with the velocities V = S u, V* = S u*: the inertial forces less the applied ones
are what the hold exerts, and its power in every u is zero. That is linear in u*, and solved by its derivatives.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import cast

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Vec6
from mahovik.core.stand.state import State
from mahovik.errors import StateError, count_numbers
from mahovik.proof.second.chart import Expr
from mahovik.proof.second.rotation import Array, by_axis
from mahovik.proof.second.system import System

Results = dict[str, Expr]


def twists(hold: Hold) -> Array:
    """S (6 x m), by motion: how the place of O1 and the axes of E1 change as a freedom goes on by an amount."""
    columns = [_twist(freedom, hold.pivot) for freedom in hold.freedoms]
    return np.column_stack(columns) if columns else np.zeros((6, 0))


def _twist(freedom: Freedom, pivot: Sequence[float]) -> Array:
    if freedom.kind == "twist":
        return np.array(freedom.twist)
    scaled = ca.DM(freedom.direction) / max(abs(x) for x in freedom.direction)
    unit, amount, r = scaled / ca.norm_2(scaled), ca.SX.sym("amount"), ca.DM(pivot)
    if freedom.kind == "slide":
        place, axes = amount * unit, ca.SX.eye(3)
    else:
        axes = by_axis(unit, amount)
        place = r + axes @ (-r)  # the pivot stays, O1 is at -r from it
    rate = ca.jacobian(ca.vertcat(place, ca.vec(axes)), amount)
    found = ca.Function("motion", [amount], [rate])(0.0).full()[:, 0]
    turning = found[3:].reshape(3, 3).T
    return np.concatenate([found[:3], [turning[2, 1], turning[0, 2], turning[1, 0]]])


def held_state(hold: Hold, state: State) -> State:
    """The state with V = S u, V* = S u*. StateError: u or u_dot of another length."""
    S = ca.DM(twists(hold))
    for name, given in (("u", state.u), ("u_dot", state.u_dot)):
        if len(given) != S.shape[1]:
            raise StateError(f"{name}: expected {count_numbers(S.shape[1])}, found {len(given)}")
    V, V_dot = (cast(Vec6, tuple((S @ ca.DM(given)).full()[:, 0].tolist())) for given in (state.u, state.u_dot))
    return replace(state, V=V, V_dot=V_dot)


def forward(system: System) -> Results:
    """u_dot (m), V_dot (6) and reaction (6; N, N m, in E1 about O1) for given phi_ddot."""
    S = _basis(system)
    u_dot = ca.MX.sym("u_dot", S.shape[1])
    applied, _ = system.applied_force()
    inertial, _ = system.inertial_force(S @ u_dot, system.inputs["phi_ddot"])
    reaction = inertial - applied
    found = _where_zero(S.T @ reaction, u_dot)
    return {"u_dot": found, "V_dot": S @ found, "reaction": ca.substitute(reaction, u_dot, found)}


def reaction(system: System) -> Results:
    """reaction (6; N, N m, in E1 about O1) for given V_dot, phi_ddot: inertial forces less the applied ones."""
    applied, _ = system.applied_force()
    inertial, _ = system.inertial_force(system.inputs["V_dot"], system.inputs["phi_ddot"])
    return {"reaction": inertial - applied}


def coupled(system: System, locked: Sequence[bool] = ()) -> Results:
    """u_dot (m), V_dot (6), reaction (6) and phi_ddot (N) for given tau.

    `locked` (N, none by default): flywheels for whose equation stands phi_ddot = 0, as their torques are reactions.
    """
    S = _basis(system)
    m = S.shape[1]
    unknown = ca.MX.sym("unknown", m + system.N)
    u_dot, phi_ddot = unknown[:m, 0], unknown[m:, 0]
    applied, on_flywheels = system.applied_force()
    inertial, of_flywheels = system.inertial_force(S @ u_dot, phi_ddot)
    reaction = inertial - applied
    stopped = ca.DM([float(x) for x in locked] or [0.0] * system.N)
    driven = of_flywheels - on_flywheels - system.inputs["tau"]
    left = ca.vertcat(S.T @ reaction, (1 - stopped) * driven + stopped * phi_ddot)
    found = _where_zero(left, unknown)
    u_dot, phi_ddot = found[:m, 0], found[m:, 0]
    return {
        "u_dot": u_dot,
        "V_dot": S @ u_dot,
        "reaction": ca.substitute(reaction, unknown, found),
        "phi_ddot": phi_ddot,
    }


def _basis(system: System) -> Expr:
    assert system.stand.hold is not None
    return ca.DM(twists(system.stand.hold))


def _where_zero(left: Expr, unknown: Expr) -> Expr:
    """The unknowns at which what is left, linear in them, is zero; scaled to a unit diagonal, rows as columns.

    By Householder reflections: Gram-Schmidt, of "symbolicqr", loses the square of the condition, which a basis of
    nearly the same rows has.
    """
    if not unknown.shape[0]:
        return unknown
    matrix, at_zero = ca.substitute([ca.jacobian(left, unknown), left], [unknown], [ca.MX.zeros(unknown.shape)])
    scale = 1 / ca.sqrt(ca.diag(matrix))
    scaled = ca.diag(scale) @ matrix @ ca.diag(scale)
    return -scale * ca.solve(ca.densify(scaled), scale * at_zero, "qr")
