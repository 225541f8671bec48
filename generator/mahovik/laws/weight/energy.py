"""Weight of a body by its potential."""

from __future__ import annotations

import casadi as ca

from mahovik.core.stand.model import Body
from mahovik.proof.second.body import BodyEnergy, Expr, MovingBody, Potential


def numbers(body: Body) -> tuple[float, ...]:
    """None beyond those that every body has."""
    return ()


def energy(body: MovingBody, numbers: Expr, gravity: Expr) -> Expr:
    """-m x_c . gravity (J), x_c the place of the mass centre."""
    return -body.mass * ca.dot(body.place(body.center_of_mass), gravity)


LAW = BodyEnergy(Potential(0, numbers, energy))
