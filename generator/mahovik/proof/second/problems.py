"""Questions to the equations of motion, of a free carrier and of a held one. Each gives named expressions.

A held carrier moves as V = S u, V* = S u*, and its hold does no work in any u, by the principle of d'Alembert and
Lagrange: inertial forces less applied ones are what the hold exerts. A free carrier is the one with S = E.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import cast

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Hold, Stand, Vec6
from mahovik.core.stand.state import State
from mahovik.errors import StateError, count_numbers
from mahovik.proof.second.body import Chart, inertial_acceleration
from mahovik.proof.second.coordinates import motion_of_coordinates
from mahovik.proof.second.rotation import Array, Expr, angular_velocity, turn
from mahovik.proof.second.system import System, places

Results = dict[str, Expr]

POINT_QUANTITIES = ("position", "C", "twist", "specific_force", "angular_acceleration")


def twists(hold: Hold | None) -> Array:
    """S (6 x m), by motion: the twist of E1 as a freedom leaves the home pose at a rate of one. E without a hold."""
    if hold is None:
        return np.eye(6)
    vectors = [np.zeros((6, 0))]
    for freedom in hold.freedoms:
        if freedom.kind == "twist":
            vectors.append(np.array(freedom.twist)[:, None])
        else:
            vectors.append(
                motion_of_coordinates(replace(hold, freedoms=(freedom,)), ca.DM.eye(3), [0])(0.0, 0.0)[0].full()
            )
    return np.hstack(vectors)


def held_state(S: Array, state: State) -> State:
    """The state with V = S u, V* = S u*. StateError: u or u_dot of another length."""
    for name, rates in (("u", state.u), ("u_dot", state.u_dot)):
        if len(rates) != S.shape[1]:
            raise StateError(f"{name}: expected {count_numbers(S.shape[1])}, found {len(rates)}")
    V, V_dot = (cast(Vec6, tuple((S @ np.array(rates)).tolist())) for rates in (state.u, state.u_dot))
    return replace(state, V=V, V_dot=V_dot)


def momentum(system: System) -> Results:
    """Z (6), Z0 (6, in E0 about its origin), energy (J), center_of_mass (3; m, of all bodies, in E1) and its velocity
    (3; m/s, in E0)."""
    T, Z, _, _, center, velocity = system.kinetics()
    return {
        "Z": Z,
        "Z0": momentum_in_E0(system.inputs["position"], system.inputs["C"], Z),
        "energy": T,
        "center_of_mass": center,
        "center_of_mass_velocity": system.inputs["C"] @ velocity,
    }


def momentum_in_E0(position: Expr, C: Expr, Z: Expr) -> Expr:
    """Z0 (6): what Z is worth in the motions of the carrier with E0 as one rigid body, turning about its origin."""
    motion, shapes = ca.SX.sym("motion", 6), ((3, 1), (3, 3), (6, 1))
    r, axes, screw = (ca.SX.sym(name, *shape) for name, shape in zip(("r", "C", "Z"), shapes, strict=True))
    V = ca.vertcat(axes.T @ (motion[:3] + ca.cross(motion[3:], r)), axes.T @ motion[3:])
    worth = ca.gradient(ca.dot(screw, V), motion)
    return ca.Function("momentum_in_E0", [r, axes, screw], [worth])(position, C, Z)


def forward(system: System) -> Results:
    """V_dot (6) for given phi_ddot: Lagrange's equations of the carrier; u_dot (m) and reaction of a held one."""
    phi_ddot = system.inputs["phi_ddot"]
    S, (_, _, K, *_) = system.S, system.kinetics()
    applied, _ = system.applied_force()
    inertial, _ = system.inertial_force(ca.MX.zeros(6), phi_ddot)
    return _motion(system, _solve(S.T @ K @ S, S.T @ (applied - inertial)), phi_ddot)


def coupled(system: System, locked: Sequence[bool] = ()) -> Results:
    """What `forward` gives, and phi_ddot (N), for given tau: all equations together.

    `locked` (N, none by default): flywheels for whose equation stands phi_ddot = 0, as their torques are reactions.
    """
    S, (_, _, K, columns, *_) = system.S, system.kinetics()
    m = S.shape[1]
    applied, on_flywheels = system.applied_force()
    still, still_flywheels = system.inertial_force(ca.MX.zeros(6), ca.MX.zeros(system.N))
    drive = on_flywheels + system.inputs["tau"] - still_flywheels
    coupling = S.T @ columns[:6, :]
    full = ca.vertcat(ca.horzcat(S.T @ K @ S, coupling), ca.horzcat(coupling.T, ca.diag(columns[6, :])))
    stopped = ca.DM([0] * m + [int(x) for x in locked or [False] * system.N])
    free = ca.diag(1 - stopped)
    unknown = _solve(free @ full @ free + ca.diag(stopped), free @ ca.vertcat(S.T @ (applied - still), drive))
    phi_ddot = unknown[m:, 0]
    return {**_motion(system, unknown[:m, 0], phi_ddot), "phi_ddot": phi_ddot}


def torque(system: System) -> Results:
    """tau (N) for given V_dot, phi_ddot: Lagrange's equations of the flywheels."""
    _, applied = system.applied_force()
    _, inertial = system.inertial_force(system.inputs["V_dot"], system.inputs["phi_ddot"])
    return {"tau": inertial - applied}


def reaction(system: System) -> Results:
    """reaction (6; N, N m, in E1 about O1) for given V_dot, phi_ddot."""
    return {"reaction": _reaction(system, system.inputs["V_dot"], system.inputs["phi_ddot"])}


def _reaction(system: System, V_dot: Expr, phi_ddot: Expr) -> Expr:
    return system.inertial_force(V_dot, phi_ddot)[0] - system.applied_force()[0]


def _motion(system: System, u_dot: Expr, phi_ddot: Expr) -> Results:
    """What a carrier answers that moves at u_dot (m) in its freedoms."""
    if system.stand.hold is None:
        return {"V_dot": u_dot}
    V_dot = system.S @ u_dot
    return {"u_dot": u_dot, "V_dot": V_dot, "reaction": _reaction(system, V_dot, phi_ddot)}


def _solve(matrix: Expr, right: Expr) -> Expr:
    """The solution of equations with a symmetric definite matrix, scaled to a unit diagonal.

    By Householder reflections: Gram-Schmidt, of "symbolicqr", loses the square of the condition, which a basis of
    nearly the same rows has.
    """
    if not matrix.shape[0]:
        return right
    scale = 1 / ca.sqrt(ca.diag(matrix))
    scaled = ca.diag(scale) @ matrix @ ca.diag(scale)
    return scale * ca.solve(ca.densify(scaled), scale * right, "qr")


def point_names(stand: Stand) -> tuple[str, ...]:
    """Instruments, then points."""
    return (*(p.name for p in stand.instruments), *(p.name for p in stand.points))


@cache
def _point_quantities() -> Expr:
    """(origin, axes, place, C, gravity, V, (delta'', xi'')) -> POINT_QUANTITIES of a point fixed on the carrier.

    `origin` (3; m) and `axes` (3x3) in E1; `place` (3; m) of O1 and C are the pose; `gravity` (3; m/s2) in E0. On the
    point's own axes: twist (6) relative to E0, specific force (3; m/s2) and angular acceleration (3; rad/s2).
    """
    chart = Chart()
    origin, fixed, place, gravity = (ca.SX.sym(name, 3, n) for name, n in zip("ofpg", (1, 3, 1, 1), strict=True))
    C = ca.SX.sym("C", 3, 3)
    turned = turn(chart.xi)
    position, axes = place + C @ (chart.delta + turned @ origin), C @ turned @ fixed
    velocity = chart.rate(position)
    # of the carrier, then turned: the terms quadratic in omega cancel to the last bit on axes that coincide with E1
    omega = fixed.T @ angular_velocity(turned, chart.rate(turned))
    specific_force = axes.T @ (chart.second_rate(velocity) - gravity)
    results = [position, axes, ca.vertcat(axes.T @ velocity, omega), specific_force, chart.second_rate(omega)]
    arguments = [origin, fixed, place, C, gravity, chart.q_dot[:6], chart.q_ddot[:6]]
    return ca.Function("measured", arguments, [chart.here(value) for value in results])


def points(system: System) -> Results:
    """POINT_QUANTITIES of every instrument and point, side by side in the order of `point_names`; needs V_dot."""
    stand, inputs = system.stand, system.inputs
    at = [places(stand)[name] for name in point_names(stand)]
    acceleration = inertial_acceleration(system.V, inputs["V_dot"])
    common = (inputs["position"], inputs["C"], ca.DM(stand.gravity), system.V, acceleration)
    values = _point_quantities().map(len(at))(
        np.column_stack([origin for origin, _ in at]),
        np.hstack([axes for _, axes in at]),
        *(ca.repmat(value, 1, len(at)) for value in common),
    )
    return dict(zip(POINT_QUANTITIES, values, strict=True))
