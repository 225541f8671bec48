"""Generalized forces: by potentials, and by the virtual power of wrenches."""

from __future__ import annotations

from functools import cache

import casadi as ca
import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import Stand
from mahovik.proof.second.bodies import MovingBody
from mahovik.proof.second.chart import Chart, Expr, angular_velocity
from mahovik.proof.second.potential import Potential
from mahovik.proof.second.rotation import Array


@cache
def body_twist() -> Expr:
    """(body, q', phi, stream) -> twist (6) of a body relative to the fluid, in its own frame."""
    chart = Chart()
    body = MovingBody(chart)
    stream = ca.SX.sym("stream", 3)
    twist = chart.here(_twist(body, stream))
    return ca.Function("body_twist", [body.numbers, chart.q_dot, chart.phi, stream], [twist])


def potentials() -> tuple[Potential, ...]:
    """The potentials of the laws that have one."""
    return laws.of_bodies("second", "POTENTIAL")


def law_columns(stand: Stand) -> Array:
    """The numbers that the potentials have for each body, side by side."""
    return np.array([[x for law in potentials() for x in law.numbers(body)] for body in stand.bodies]).T


@cache
def body_force() -> Expr:
    """(body, numbers, phi, gravity, P) -> generalized force (7) of the potentials and of a wrench P of a body.

    -dU/dq of the sum U of the potentials, with the laws' `numbers` of the body, and d/dq' of the power P . V_k that P
    has in the twist V_k of the body (own frame). `gravity` (3; m/s2) is on the chart's axes.
    """
    chart = Chart()
    body = MovingBody(chart)
    gravity, P = ca.SX.sym("gravity", 3), ca.SX.sym("P", 6)
    laws_of_potential = potentials()
    numbers = ca.SX.sym("numbers", sum(law.count for law in laws_of_potential))
    potential, first = ca.SX(0), 0
    for law in laws_of_potential:
        potential += law.energy(body, numbers[first : first + law.count], gravity)
        first += law.count
    power = ca.dot(_twist(body, ca.SX.zeros(3)), P)
    force = chart.here(ca.gradient(power, chart.q_dot) - ca.gradient(potential, chart.q))
    return ca.Function("body_force", [body.numbers, numbers, chart.phi, gravity, P], [force])


def _twist(body: MovingBody, stream: Expr) -> Expr:
    """Velocity of the body's origin relative to the fluid, and angular velocity, on the body's axes (6)."""
    rate, axes = body.chart.rate, body.axes()
    velocity = rate(body.place(ca.SX.zeros(3))) - stream
    return ca.vertcat(axes.T @ velocity, angular_velocity(axes, rate(axes)))
