"""Kinetic energy of one body, and of the fluid that the added mass stands for."""

from __future__ import annotations

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
