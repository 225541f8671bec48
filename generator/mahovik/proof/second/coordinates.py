"""Generalized coordinates and their rates, by differentiating the pose that they give.

Those of a free carrier are the place of O1 in E0 and the attitude angles, (10). Those of a held one are its freedoms':
the home pose goes about the axis by the angle, with the pivot along the axes of the home pose. The rate of the pose
gives the twist V of rates r of the coordinates, A r, and r is solved for; once more for r'. What turns about a point
has the attitude itself for a coordinate, whose rate is C <omega>.
"""

from __future__ import annotations

import math
from collections.abc import Sequence as Numbers
from functools import cache

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Sequence, Vec3
from mahovik.errors import StateError
from mahovik.proof.second.body import (
    Array,
    Expr,
    angular_velocity,
    by_angles,
    by_axis,
    directional_derivative,
    quaternion_of,
    unit,
)

SINGULAR = 1e-6
"""Least |cos theta| (Euler: |sin theta|) of an attitude that has rates of its angles."""


@cache
def _kinematic_matrices(sequence: Sequence) -> Expr:
    """(angles, q') -> A, D (6x6): V = A q', D = A' along the motion; q = (O1 in E0, psi, theta, phi)."""
    angles, q_dot = ca.SX.sym("angles", 3), ca.SX.sym("q_dot", 6)
    C = by_angles(sequence, angles)
    omega = angular_velocity(C, directional_derivative(C, angles, q_dot[3:]))
    A = ca.jacobian(ca.vertcat(C.T @ q_dot[:3], omega), q_dot)
    return ca.Function("kinematic_matrices", [angles, q_dot], [A, directional_derivative(A, angles, q_dot[3:])])


def free_coordinates(sequence: Sequence, angles: Vec3, V: Array, V_dot: Array) -> dict[str, Array]:
    """A, D (6x6), q_dot, q_ddot (6; m/s, rad/s and their rates) of a free carrier that moves with V, V_dot.

    StateError at a singular attitude.
    """
    name, size = ("sin", math.sin(angles[1])) if sequence == "euler" else ("cos", math.cos(angles[1]))
    if abs(size) < SINGULAR:
        raise StateError(
            f"angles: singular attitude of the {sequence} sequence, |{name} theta| = {abs(size):.3g}; "
            f"`generalized` needs at least {SINGULAR:g}"
        )
    A = _kinematic_matrices(sequence)(angles, np.zeros(6))[0].full()
    q_dot = np.linalg.solve(A, V)
    D = _kinematic_matrices(sequence)(angles, q_dot)[1].full()
    return {"A": A, "D": D, "q_dot": q_dot, "q_ddot": np.linalg.solve(A, V_dot - D @ q_dot)}


def held_coordinates(
    hold: Hold, sequence: Sequence, position: Vec3, C: Array, V: Numbers[float], V_dot: Array
) -> dict[str, Array]:
    """q, orientation of what has them, q_dot, q_ddot (m; m, rad, s) of a carrier that moves with V, V_dot = S u_dot.

    StateError: the freedoms have no coordinates.
    """
    turns = [k for k, freedom in enumerate(hold.freedoms) if freedom.kind == "turn"]
    if not hold.freedoms or any(freedom.kind == "twist" for freedom in hold.freedoms) or len(turns) == 2:
        raise StateError("generalized: the freedoms of [hold] have no coordinates")
    C0 = by_angles(sequence, ca.DM(hold.angles))
    numbered = [k for k in range(len(hold.freedoms)) if k not in turns or len(turns) == 1]
    q = np.array([coordinate(hold, hold.freedoms[k], C0, ca.DM(position), ca.DM(C)).full()[0, 0] for k in numbered])
    present = np.concatenate([q, np.asarray(C).T.ravel()]) if len(turns) == 3 else q
    motion = motion_of_coordinates(hold, C0, numbered)
    A = motion(present, np.zeros(len(hold.freedoms)))[0].full()
    q_dot = np.linalg.lstsq(A, np.array(V), rcond=None)[0]
    turning = motion(present, q_dot)[1].full()[:, 0]
    values = {"q": q} if numbered else {}
    if len(turns) == 3:
        values["orientation"] = quaternion_of(C0.full().T @ C)
    return {**values, "q_dot": q_dot, "q_ddot": np.linalg.lstsq(A, V_dot - turning, rcond=None)[0]}


def motion_of_coordinates(hold: Hold, C0: Expr, numbered: list[int]) -> Expr:
    """(coordinates, rates r (m)) -> A (6 x m) and A' r (6): V = A r, V' = A r' + A' r.

    The coordinates are q, followed by the attitude, column by column, of what turns about a point.
    """
    r, number = ca.SX.sym("r", len(hold.freedoms)), {k: i for i, k in enumerate(numbered)}
    q, C, place = ca.SX.sym("q", len(numbered)), C0, ca.DM(hold.pivot)
    directions: list[Expr] = [ca.DM(unit(freedom.direction)) for freedom in hold.freedoms]
    for k in numbered:
        if hold.freedoms[k].kind == "turn":
            C = C0 @ by_axis(directions[k], q[number[k]])
        else:
            place = place + directions[k] * q[number[k]]
    variables, rates = q, ca.vertcat(*(r[k] for k in numbered))
    free = [k for k in range(len(hold.freedoms)) if k not in number]
    if free:
        C = ca.SX.sym("C", 3, 3)
        omega = sum((directions[k] * r[k] for k in free), ca.SX.zeros(3))
        variables, rates = ca.vertcat(q, ca.vec(C)), ca.vertcat(rates, ca.vec(C @ ca.skew(omega)))
    position = ca.DM(hold.position) + C0 @ place - C @ ca.DM(hold.pivot)
    v = C.T @ directional_derivative(position, variables, rates)
    V = ca.vertcat(v, angular_velocity(C, directional_derivative(C, variables, rates)))
    along = directional_derivative(V, variables, rates)
    return ca.Function("motion_of_coordinates", [variables, r], [ca.jacobian(V, r), along])


def coordinate(hold: Hold, freedom: Freedom, C0: Expr, place: Expr, C: Expr) -> Expr:
    """Way (m) of the pivot in the axes of the home pose, or angle (rad) by which two arms have turned."""
    d = ca.DM(unit(freedom.direction))
    if freedom.kind == "slide":
        pivot = ca.DM(hold.pivot)
        return ca.dot(d, C0.T @ (place + C @ pivot - ca.DM(hold.position)) - pivot)
    first = np.eye(3)[int(np.argmin(np.abs(d.full())))]
    b = ca.cross(d, ca.DM(first))
    b = b / ca.norm_2(b)
    c = ca.cross(d, b)
    turned_b, turned_c = C0.T @ (C @ b), C0.T @ (C @ c)
    return ca.atan2(ca.dot(c, turned_b) - ca.dot(b, turned_c), ca.dot(b, turned_b) + ca.dot(c, turned_c))
