"""Archimedes force on a body by its potential."""

from __future__ import annotations

import casadi as ca

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.proof.second.body import BodyEnergy, Expr, MovingBody, Potential


def numbers(body: Body) -> tuple[float, ...]:
    """Displaced mass and its centre; zeros where there is none."""
    buoyancy = body.law(Buoyancy)
    return (buoyancy.displaced_mass, *buoyancy.center) if buoyancy else (0.0,) * 4


def energy(body: MovingBody, numbers: Expr, gravity: Expr) -> Expr:
    """m_displaced x_b . gravity (J), x_b the place of the centre of buoyancy: it rises where a weight falls."""
    displaced_mass, center = numbers[0], numbers[1:]
    return displaced_mass * ca.dot(body.place(center), gravity)


LAW = BodyEnergy(Potential(4, numbers, energy))
