"""What instruments and points measure: places, axes, twists and accelerations, by differentiating the place twice."""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.proof.second.bodies import places
from mahovik.proof.second.chart import Chart, Expr, angular_velocity, inertial_acceleration, turn
from mahovik.proof.second.system import System

QUANTITIES = ("position", "C", "twist", "specific_force", "angular_acceleration")


def names(stand: Stand) -> tuple[str, ...]:
    """Instruments, then points."""
    return (*(p.name for p in stand.instruments), *(p.name for p in stand.points))


@cache
def point_quantities() -> Expr:
    """(origin, axes, place, C, gravity, V, (delta'', xi'')) -> QUANTITIES of a point fixed on the carrier.

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
    acceleration = chart.second_rate(velocity)
    found = [
        position,
        axes,
        ca.vertcat(axes.T @ velocity, omega),
        axes.T @ (acceleration - gravity),
        chart.second_rate(omega),
    ]
    given = [origin, fixed, place, C, gravity, chart.q_dot[:6], chart.q_ddot[:6]]
    return ca.Function("measured", given, [chart.here(each) for each in found])


def points(system: System) -> dict[str, Expr]:
    """QUANTITIES of every instrument and point, side by side in the order of `names`; needs V_dot."""
    stand, inputs = system.stand, system.inputs
    where = [places(stand)[name] for name in names(stand)]
    count = len(where)
    acceleration = inertial_acceleration(system.V, inputs["V_dot"])
    common = (inputs["position"], inputs["C"], ca.DM(stand.gravity), system.V, acceleration)
    found = point_quantities().map(count)(
        np.column_stack([origin for origin, _ in where]),
        np.hstack([axes for _, axes in where]),
        *(ca.repmat(each, 1, count) for each in common),
    )
    return dict(zip(QUANTITIES, found, strict=True))
