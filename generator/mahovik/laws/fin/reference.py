"""Lift and drag of a body's fins, literally, (7); `V_r` (6) is its twist relative to the fluid, in the body's frame."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fin.law import Fin, Fins
from mahovik.proof.reference.algebra import (
    Array,
    arctan2,
    cross,
    force_at,
    larger,
    pi_like,
    smaller,
    sqrt,
    vector,
    with_sign,
)
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, law: Fins, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Wrench (6; N, N m) of all fins."""
    return {"fins": np.sum([lift_and_drag(fin, V_r) for fin in law.fins], axis=0)}


def lift_and_drag(fin: Fin, V_r: Array) -> Array:
    """Wrench (6; N, N m) of one fin about the body's origin.

    Drag D against the velocity (a, c) in the plane of chord and normal, lift L across it:
    -D (a, c)/|(a, c)| + L (c, -a)/|(a, c)|; without incidence (-D, -L).
    """
    position = vector(fin.position)
    chord = vector(fin.chord) / np.linalg.norm(vector(fin.chord))
    normal = cross(chord) @ vector(fin.span)
    normal = normal / np.linalg.norm(normal)
    velocity = V_r[:3] + cross(V_r[3:]) @ position
    a, b, c = velocity @ chord, velocity @ cross(normal) @ chord, velocity @ normal
    square = {"along": a**2, "across": a**2 + c**2, "whole": a**2 + b**2 + c**2}[fin.speed]
    along, up, angle = 1.0, 0.0, fin.deflection
    speed = sqrt(a**2 + c**2)
    if fin.incidence and speed > 0.0:
        along, up, angle = a / speed, c / speed, arctan2(c, a) + fin.deflection
    C_L = lift_coefficient(fin, angle)
    C_D = fin.drag + fin.induced * C_L**2
    lift, drag = (fin.density / 2 * fin.area * square * C for C in (C_L, C_D))
    force = (-drag * along + lift * up) * chord + (-drag * up - lift * along) * normal
    return force_at(force, position)


def lift_coefficient(fin: Fin, angle: Any) -> Any:
    """C_L of an angle (rad): linear to the stall, then falling linearly to zero at a right angle, and zero beyond."""
    size, right = abs(angle), pi_like(angle) / 2
    if fin.stall is not None:  # the falling line is below the other beyond the stall
        size = smaller(size, larger(fin.stall * (right - size) / (right - fin.stall), 0.0))
    return fin.lift_slope * with_sign(size, angle)


LAW = BodyReference(wrenches, Fins)
