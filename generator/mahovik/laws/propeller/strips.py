"""Numbers of a propeller in SI of its speed in rad/s, for the C and for planning; referees make their own."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mahovik.core.stand.columns import hypot
from mahovik.core.stand.model import Vec3
from mahovik.laws.propeller.data import Propeller


@dataclass(frozen=True)
class Screw:
    """Thrust and torque on the body as t0 |n| n + t1 |n| u + t2 |u| u of the speed n (rad/s) and the velocity u (m/s).

    axis    of length one
    thrust  t0 (N s2/rad2), t1 (N s2/(rad m)), t2 (N s2/m2)
    torque  likewise, about the axis, N m
    """

    axis: Vec3
    thrust: Vec3
    torque: Vec3


def screw_of(p: Propeller) -> Screw:
    """The propeller so."""
    force = p.density * p.diameter**4
    hand = 1.0 if p.left else -1.0
    thrust = _in_radians(p, p.thrust, (1.0 - p.deduction) * force)
    return Screw(_unit(p.axis), thrust, _in_radians(p, p.torque, hand * force * p.diameter))


def _in_radians(p: Propeller, k: Vec3, size: float) -> Vec3:
    advance = (1.0 - p.wake) / p.diameter
    return (
        size * k[0] / (math.tau * math.tau),
        size * k[1] * advance / math.tau,
        size * k[2] * abs(advance) * advance,
    )


def _unit(a: Vec3) -> Vec3:
    largest = max(abs(x) for x in a)  # first, so that squares neither overflow nor vanish
    x, y, z = (each / largest for each in a)
    length = hypot(x, y, z)
    return (x / length, y / length, z / length)
