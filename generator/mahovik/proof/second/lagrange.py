"""Lagrange's equations of one body and of the fluid, by automatic differentiation of their kinetic energies.

Every function is of one generic body and built once; a stand calls it with one column per body.
"""

from __future__ import annotations

from functools import cache

import casadi as ca

from mahovik.proof.second.bodies import MovingBody
from mahovik.proof.second.chart import Chart, Expr, angular_velocity, turn


def body_energy(body: MovingBody) -> Expr:
    """T = m |x_c'|^2 / 2 + omega^T J_c omega / 2 (J), x_c the place of the mass centre, J_c about it."""
    velocity = body.chart.rate(body.place(body.center_of_mass))
    axes = body.axes()
    omega = angular_velocity(axes, body.chart.rate(axes))
    return body.mass * ca.sumsqr(velocity) / 2 + ca.dot(omega, body.central_inertia @ omega) / 2


def fluid_energy(chart: Chart, Lambda: Expr, stream: Expr) -> Expr:
    """T = V_r^T Lambda V_r / 2 (J), V_r the carrier's twist relative to a fluid of velocity `stream`, in E1.

    Lambda (6x6) is the added mass about O1 in E1; `stream` (3; m/s) is on the chart's axes, which do not turn.
    """
    turned = turn(chart.xi)
    relative = turned.T @ (chart.q_dot[:3] - stream)
    V_r = ca.vertcat(relative, angular_velocity(turned, chart.rate(turned)))
    return ca.dot(V_r, Lambda @ V_r) / 2


def inertial_force(chart: Chart, T: Expr) -> Expr:
    """d/dt (dT/dq') - dT/dq (7; N, N m, N m) along q', q''."""
    return chart.second_rate(ca.gradient(T, chart.q_dot)) - ca.gradient(T, chart.q)


@cache
def body_kinetics() -> Expr:
    """(body, q', phi) -> T (J), dT/dq' (7), d2T/dq'2 (7x7): energy, momenta, mass matrix of a body."""
    chart = Chart()
    body = MovingBody(chart)
    T = body_energy(body)
    momenta = ca.gradient(T, chart.q_dot)
    found = [chart.here(each) for each in (T, momenta, ca.jacobian(momenta, chart.q_dot))]
    return ca.Function("body_kinetics", [body.numbers, chart.q_dot, chart.phi], found)


@cache
def body_moment() -> Expr:
    """(body, phi) -> m x_c (3; kg m): first moment of a body about O1, in E1."""
    chart = Chart()
    body = MovingBody(chart)
    moment = chart.here(body.mass * body.place(body.center_of_mass))
    return ca.Function("body_moment", [body.numbers, chart.phi], [moment])


@cache
def body_inertial_force() -> Expr:
    """(body, q', q'', phi) -> d/dt (dT/dq') - dT/dq (7) of a body."""
    chart = Chart()
    body = MovingBody(chart)
    force = chart.here(inertial_force(chart, body_energy(body)))
    return ca.Function("body_inertial_force", [body.numbers, chart.q_dot, chart.q_ddot, chart.phi], [force])


@cache
def fluid_kinetics() -> Expr:
    """(Lambda, stream, V) -> T (J), dT/dV (6) of the fluid."""
    chart, Lambda, stream = _fluid()
    T = fluid_energy(chart, Lambda, stream)
    found = [chart.here(T), chart.here(ca.gradient(T, chart.q_dot))[:6]]
    return ca.Function("fluid_kinetics", [Lambda, stream, chart.q_dot[:6]], found)


@cache
def fluid_inertial_force() -> Expr:
    """(Lambda, stream, V, (delta'', xi'')) -> d/dt (dT/dq') - dT/dq (6) of the fluid."""
    chart, Lambda, stream = _fluid()
    force = chart.here(inertial_force(chart, fluid_energy(chart, Lambda, stream)))[:6]
    return ca.Function("fluid_inertial_force", [Lambda, stream, chart.q_dot[:6], chart.q_ddot[:6]], [force])


def _fluid() -> tuple[Chart, Expr, Expr]:
    return Chart(), ca.SX.sym("Lambda", 6, 6), ca.SX.sym("stream", 3)
