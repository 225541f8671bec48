"""Questions to the equations of motion: momentum, forward, torque, coupled. Each gives named expressions."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from mahovik.proof.second.chart import Expr
from mahovik.proof.second.system import System

SOLVER = "ldl"  # comes with CasADi; K and the full mass matrix are symmetric positive definite

Results = dict[str, Expr]


def momentum(system: System) -> Results:
    """Z (6), Z0 (6, in E0 about its origin), energy (J), center_of_mass (3; m, of all bodies, in E1)."""
    T, Z, _, _ = system.kinetics()
    return {
        "Z": Z,
        "Z0": momentum_in_E0(system.inputs["position"], system.inputs["C"], Z),
        "energy": T,
        "center_of_mass": system.center_of_mass(),
    }


def momentum_in_E0(position: Expr, C: Expr, Z: Expr) -> Expr:
    """Z0 (6): what Z is worth in the motions of the carrier with E0 as one rigid body, turning about its origin."""
    motion, shapes = ca.SX.sym("motion", 6), ((3, 1), (3, 3), (6, 1))
    r, axes, screw = (ca.SX.sym(name, *shape) for name, shape in zip(("r", "C", "Z"), shapes, strict=True))
    V = ca.vertcat(axes.T @ (motion[:3] + ca.cross(motion[3:], r)), axes.T @ motion[3:])
    worth = ca.gradient(ca.dot(screw, V), motion)
    return ca.Function("momentum_in_E0", [r, axes, screw], [worth])(position, C, Z)


def forward(system: System) -> Results:
    """V_dot (6) for given phi_ddot: Lagrange's equations of the carrier."""
    _, _, K, _ = system.kinetics()
    applied, _ = system.applied_force()
    inertial, _ = system.inertial_force(ca.MX.zeros(6), system.inputs["phi_ddot"])
    return {"V_dot": ca.solve(K, applied - inertial, SOLVER)}


def torque(system: System) -> Results:
    """tau (N) for given V_dot, phi_ddot: Lagrange's equations of the flywheels."""
    _, applied = system.applied_force()
    _, inertial = system.inertial_force(system.inputs["V_dot"], system.inputs["phi_ddot"])
    return {"tau": inertial - applied}


def coupled(system: System, locked: Sequence[bool] = ()) -> Results:
    """V_dot (6) and phi_ddot (N) for given tau: all 6 + N equations together.

    `locked` (N, none by default): flywheels for whose equation stands phi_ddot = 0, as their torques are reactions.
    """
    _, _, K, columns = system.kinetics()
    applied = ca.vertcat(*system.applied_force())
    still = ca.vertcat(*system.inertial_force(ca.MX.zeros(6), ca.MX.zeros(system.N)))
    drive = ca.vertcat(ca.MX.zeros(6), system.inputs["tau"])
    coupling, own = columns[:6, :], columns[6, :]
    full = ca.vertcat(ca.horzcat(K, coupling), ca.horzcat(coupling.T, ca.diag(own)))
    held = ca.DM([0] * 6 + [int(x) for x in locked or [False] * system.N])
    free = ca.diag(1 - held)
    found = ca.solve(free @ full @ free + ca.diag(held), free @ (applied + drive - still), SOLVER)
    return {"V_dot": found[:6], "phi_ddot": found[6:]}
