"""(8) linearised along a course of the carrier: how small displacements, and changes of the flywheels' motion, act.

x = (displacement in E1, rotation vector in E1, change of V), 12 numbers a time:

    x' = A x + B_phi dphi + B_phi' dphi' + B_phi'' dphi''.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.plan.array import Array
from mahovik.plan.forward.carrier import Carrier, acceleration, stream_rate
from mahovik.plan.forward.drive import Drive
from mahovik.plan.residual import Mechanics, linear
from mahovik.plan.residual.kinematics import Twists
from mahovik.plan.residual.prescribed import prescribed_at
from mahovik.plan.residual.spatial import skew

_PLACE, _SPEED = 1e-6, 1e-5
"""m or rad, m/s or rad/s: of central differences."""


@dataclass(frozen=True, eq=False)
class Linearised:
    """At M times: A (M, 12, 12), and the lower halves of B (M, 6, N each) by phi, phi', phi''; upper are zero."""

    A: Array
    by_phi: Array
    by_phi_dot: Array
    by_phi_ddot: Array


def linearise(mechanics: Mechanics, at: Drive, course: Carrier, phi_ddot: Array) -> Linearised:
    """Along a course (M states) under flywheels' motion `at` with accelerations phi'' (M, N)."""
    A = np.zeros((len(course.V), 12, 12))
    turning = -skew(course.V[:, 3:])
    A[:, :3, :3] = A[:, 3:6, 3:6] = turning
    A[:, :3, 3:6] = -skew(course.V[:, :3])
    A[:, range(6), range(6, 12)] = 1.0
    A[:, 6:, :6] = by_displacement(mechanics, at, course)
    A[:, 6:, 6:] = _by_twist(mechanics, at, course)
    V_r, rate = stream_rate(mechanics.stand, course.C, course.V)
    V_r_dot = acceleration(mechanics, at, course) + rate
    moving = prescribed_at(mechanics, Twists(course.C, course.O1, course.V, V_r, V_r_dot))
    found = linear(moving, at.phi, at.phi_dot, phi_ddot)
    return Linearised(A, *(at.inverse @ x for x in (found.by_phi, found.by_phi_dot, found.by_phi_ddot)))


def by_displacement(mechanics: Mechanics, at: Drive, course: Carrier) -> Array:
    """Derivatives of V* by small displacements in E1 (M, 6, 6), central differences."""
    columns = []
    for i in range(6):
        step = np.zeros((1, 6))
        step[0, i] = _PLACE
        ahead, behind = (
            acceleration(mechanics, at, course.displaced(np.repeat(x, len(course.V), axis=0))) for x in (step, -step)
        )
        columns.append((ahead - behind) / (2.0 * _PLACE))
    return np.stack(columns, axis=2)


def _by_twist(mechanics: Mechanics, at: Drive, course: Carrier) -> Array:
    columns = []
    for i in range(6):
        step = np.zeros(6)
        step[i] = _SPEED
        ahead, behind = (acceleration(mechanics, at, course._replace(V=course.V + x)) for x in (step, -step))
        columns.append((ahead - behind) / (2.0 * _SPEED))
    return np.stack(columns, axis=2)


def sensitivity(found: Linearised, push: Array, start: Array, step: float) -> Array:
    """x (n + 1, 12, P) at every second time, for P changes, from x = `start` (12, P).

    `found` at 2 n + 1 times, half a `step` (s) apart; `push` (2 n + 1, 6, P): what the changes add to V*.
    """
    x, states = start, [start]

    def rate(i: int, y: Array) -> Array:
        grown = found.A[i] @ y
        grown[6:] += push[i]
        return np.asarray(grown)

    for i in range(0, len(found.A) - 1, 2):
        first = rate(i, x)
        second = rate(i + 1, x + step / 2 * first)
        third = rate(i + 1, x + step / 2 * second)
        fourth = rate(i + 2, x + step * third)
        x = x + step / 6 * (first + 2.0 * (second + third) + fourth)
        states.append(x)
    return np.stack(states)
