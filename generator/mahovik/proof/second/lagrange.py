"""Lagrange's equations of one body and of the fluid, by automatic differentiation of their energies.

Every function is of one generic body and built once; a stand calls it with one column a body.
"""

from __future__ import annotations

from functools import cache

import casadi as ca

from mahovik.proof.second import energy
from mahovik.proof.second.bodies import MovingBody
from mahovik.proof.second.chart import Chart, Expr


def inertial_force(chart: Chart, T: Expr) -> Expr:
    """d/dt (dT/dq') - dT/dq (7; N, N m, N m) along q', q''."""
    return chart.second_rate(ca.gradient(T, chart.q_dot)) - ca.gradient(T, chart.q)


@cache
def body_kinetics() -> Expr:
    """(body, q', phi) -> T (J), dT/dq' (7), d2T/dq'2 (7x7): energy, momenta, mass matrix of a body."""
    chart = Chart()
    body = MovingBody(chart)
    T = energy.body_energy(body)
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
    force = chart.here(inertial_force(chart, energy.body_energy(body)))
    return ca.Function("body_inertial_force", [body.numbers, chart.q_dot, chart.q_ddot, chart.phi], [force])


@cache
def fluid_kinetics() -> Expr:
    """(Lambda, stream, V) -> T (J), dT/dV (6) of the fluid."""
    chart, Lambda, stream = _fluid()
    T = energy.fluid_energy(chart, Lambda, stream)
    found = [chart.here(T), chart.here(ca.gradient(T, chart.q_dot))[:6]]
    return ca.Function("fluid_kinetics", [Lambda, stream, chart.q_dot[:6]], found)


@cache
def fluid_inertial_force() -> Expr:
    """(Lambda, stream, V, (delta'', xi'')) -> d/dt (dT/dq') - dT/dq (6) of the fluid."""
    chart, Lambda, stream = _fluid()
    force = chart.here(inertial_force(chart, energy.fluid_energy(chart, Lambda, stream)))[:6]
    return ca.Function("fluid_inertial_force", [Lambda, stream, chart.q_dot[:6], chart.q_ddot[:6]], [force])


def _fluid() -> tuple[Chart, Expr, Expr]:
    return Chart(), ca.SX.sym("Lambda", 6, 6), ca.SX.sym("stream", 3)
