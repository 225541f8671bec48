"""Scale of thrust and torque of a body's propellers."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Body, Vec3
from mahovik.laws.propeller.data import Propellers
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.scales.parts import length


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """Sizes of all terms (6; N, N m) in any direction, at the scale of the twist (6)."""
    law, total = body.law(Propellers), np.zeros(6)
    for p in law.propellers if law else ():
        arm = length(p.position)
        flow = length(twist[:3]) + arm * length(twist[3:])
        turns, advance = abs(p.speed) / math.tau, (1 - p.wake) * flow / p.diameter
        force = (1 - p.deduction) * p.density * p.diameter**4 * _size(p.thrust, turns, advance)
        moment = force * arm + p.density * p.diameter**5 * _size(p.torque, turns, advance)
        total += np.repeat([force, moment], 3)
    return total


def _size(k: Vec3, n: float, advance: float) -> float:
    return abs(k[0]) * n * n + abs(k[1]) * n * advance + abs(k[2]) * advance * advance
