"""Coordinates of the freedoms of a held carrier, and their rates by differentiating the pose that they give.

The pose of coordinates is where the home pose goes: about the axis by the angle, with the pivot along the axes of the
home pose. Its rate gives the twist V of rates r of the coordinates, A r, and r is solved for; once more for r'. What
turns about a point has the attitude itself for a coordinate, whose rate is C <omega>.
"""

from __future__ import annotations

import math
from collections.abc import Sequence as Numbers

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Sequence, Vec3
from mahovik.errors import StateError
from mahovik.proof.second.chart import Expr, angular_velocity, directional_derivative
from mahovik.proof.second.rotation import Array, by_angles, by_axis, rotation_vector


def generalized(
    hold: Hold, sequence: Sequence, position: Vec3, C: Array, V: Numbers[float], V_dot: Array
) -> dict[str, Array]:
    """q, orientation of what has them, q_dot, q_ddot (m; m, rad, s) of a carrier that moves with V, V_dot = S u_dot.

    StateError: the freedoms have no coordinates.
    """
    turns = [k for k, freedom in enumerate(hold.freedoms) if freedom.kind == "turn"]
    if not hold.freedoms or any(freedom.kind == "twist" for freedom in hold.freedoms) or len(turns) == 2:
        raise StateError("generalized: the freedoms of [hold] have no coordinates")
    C0 = by_angles(sequence, ca.DM(hold.angles))
    own = [k for k, freedom in enumerate(hold.freedoms) if k not in turns or len(turns) == 1]
    q = np.array([coordinate(hold, hold.freedoms[k], C0, ca.DM(position), ca.DM(C)).full()[0, 0] for k in own])
    here = np.concatenate([q, np.asarray(C).T.ravel()]) if len(turns) == 3 else q
    motion = _motion(hold, C0, own)
    A = motion(here, np.zeros(len(hold.freedoms)))[0].full()
    q_dot = np.linalg.lstsq(A, np.array(V), rcond=None)[0]
    turning = motion(here, q_dot)[1].full()[:, 0]
    found = {"q": q} if own else {}
    if len(turns) == 3:
        x = rotation_vector(C0.full().T @ C)
        half = math.hypot(*x) / 2
        share = math.sin(half) / (2 * half) if half else 0.5
        found["orientation"] = np.array([math.cos(half), *(share * x)])
    return {**found, "q_dot": q_dot, "q_ddot": np.linalg.lstsq(A, V_dot - turning, rcond=None)[0]}


def _motion(hold: Hold, C0: Expr, own: list[int]) -> Expr:
    """(coordinates, rates r (m)) -> A (6 x m) and A' r (6): V = A r, V' = A r' + A' r.

    The coordinates are q, followed by the attitude, column by column, of what turns about a point.
    """
    r, number = ca.SX.sym("r", len(hold.freedoms)), {k: i for i, k in enumerate(own)}
    q, C, place = ca.SX.sym("q", len(own)), C0, ca.DM(hold.pivot)
    for k in own:
        if hold.freedoms[k].kind == "turn":
            C = C0 @ by_axis(unit(hold.freedoms[k]), q[number[k]])
        else:
            place = place + unit(hold.freedoms[k]) * q[number[k]]
    variables, rates = q, ca.vertcat(*(r[k] for k in own))
    free = [k for k in range(len(hold.freedoms)) if k not in number]
    if free:
        C = ca.SX.sym("C", 3, 3)
        omega = sum((unit(hold.freedoms[k]) * r[k] for k in free), ca.SX.zeros(3))
        variables, rates = ca.vertcat(q, ca.vec(C)), ca.vertcat(rates, ca.vec(C @ ca.skew(omega)))
    position = ca.DM(hold.position) + C0 @ place - C @ ca.DM(hold.pivot)
    v = C.T @ directional_derivative(position, variables, rates)
    V = ca.vertcat(v, angular_velocity(C, directional_derivative(C, variables, rates)))
    along = directional_derivative(V, variables, rates)
    return ca.Function("motion_of_coordinates", [variables, r], [ca.jacobian(V, r), along])


def coordinate(hold: Hold, freedom: Freedom, C0: Expr, place: Expr, C: Expr) -> Expr:
    """Way (m) of the pivot in the axes of the home pose, or angle (rad) by which two arms have turned."""
    d = unit(freedom)
    if freedom.kind == "slide":
        pivot = ca.DM(hold.pivot)
        return ca.dot(d, C0.T @ (place + C @ pivot - ca.DM(hold.position)) - pivot)
    first = np.eye(3)[int(np.argmin(np.abs(d.full())))]
    b = ca.cross(d, ca.DM(first))
    b = b / ca.norm_2(b)
    c = ca.cross(d, b)
    turned_b, turned_c = C0.T @ (C @ b), C0.T @ (C @ c)
    return ca.atan2(ca.dot(c, turned_b) - ca.dot(b, turned_c), ca.dot(b, turned_b) + ca.dot(c, turned_c))


def unit(freedom: Freedom) -> Expr:
    """Direction of a freedom (3), of length 1."""
    scaled = ca.DM(freedom.direction) / max(abs(x) for x in freedom.direction)
    return scaled / ca.norm_2(scaled)
