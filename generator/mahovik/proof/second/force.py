"""Generalized forces: by potentials, and by the virtual power of wrenches."""

from __future__ import annotations

from functools import cache

import casadi as ca

from mahovik.proof.second.bodies import MovingBody
from mahovik.proof.second.chart import Chart, Expr, angular_velocity


@cache
def body_twist() -> Expr:
    """(body, q', phi, stream) -> twist (6) of a body relative to the fluid, in its own frame."""
    chart = Chart()
    body = MovingBody(chart)
    stream = ca.SX.sym("stream", 3)
    twist = chart.here(_twist(body, stream))
    return ca.Function("body_twist", [body.numbers, chart.q_dot, chart.phi, stream], [twist])


@cache
def body_force() -> Expr:
    """(body, phi, gravity, P) -> generalized force (7) of weight, buoyancy and a wrench P of a body.

    -dU/dq of U = -(m x_c - m_displaced x_b) . gravity, and d/dq' of the power P . V_k that P has in the twist V_k of
    the body (own frame). `gravity` (3; m/s2) is on the chart's axes.
    """
    chart = Chart()
    body = MovingBody(chart)
    gravity, P = ca.SX.sym("gravity", 3), ca.SX.sym("P", 6)
    weight = body.mass * body.place(body.center_of_mass)
    buoyancy = body.displaced_mass * body.place(body.center)
    potential = -ca.dot(weight - buoyancy, gravity)
    power = ca.dot(_twist(body, ca.SX.zeros(3)), P)
    force = chart.here(ca.gradient(power, chart.q_dot) - ca.gradient(potential, chart.q))
    return ca.Function("body_force", [body.numbers, chart.phi, gravity, P], [force])


def _twist(body: MovingBody, stream: Expr) -> Expr:
    """Velocity of the body's origin relative to the fluid, and angular velocity, on the body's axes (6)."""
    rate, axes = body.chart.rate, body.axes()
    velocity = rate(body.place(ca.SX.zeros(3))) - stream
    return ca.vertcat(axes.T @ velocity, angular_velocity(axes, rate(axes)))
