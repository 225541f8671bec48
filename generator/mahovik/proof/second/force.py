"""Generalized forces: by potentials, by Rayleigh's function, and by the virtual power of wrenches."""

from __future__ import annotations

from functools import cache

import casadi as ca

from mahovik.proof.second.bodies import MovingBody
from mahovik.proof.second.chart import Chart, Expr, angular_velocity, turn


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


@cache
def leg_force() -> Expr:
    """(leg, place, C, V) -> generalized force (6) of a leg, of any pose of the carrier.

    -dU/dq - dR/dq' of U = stiffness (l - length)^2 / 2 and Rayleigh's R = damping l'^2 / 2, l the distance of the two
    points. `leg` is ground 3, carrier 3, length, stiffness, damping; `place` (3; m) of O1 and C are the pose.
    """
    chart = Chart()
    leg, place, C = ca.SX.sym("leg", 9), ca.SX.sym("place", 3), ca.SX.sym("C", 3, 3)
    ground, carrier, unstretched, stiffness, damping = ca.vertsplit(leg, [0, 3, 6, 7, 8, 9])
    end = place + C @ (chart.delta + turn(chart.xi) @ carrier)
    distance = ca.norm_2(end - ground)
    potential = stiffness * (distance - unstretched) ** 2 / 2
    rayleigh = damping * chart.rate(distance) ** 2 / 2
    force = chart.here(-ca.gradient(potential, chart.q) - ca.gradient(rayleigh, chart.q_dot))[:6]
    return ca.Function("leg_force", [leg, place, C, chart.q_dot[:6]], [force])
