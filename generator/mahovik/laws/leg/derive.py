"""A leg as expressions."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from mahovik.core.derive.symbols import vector


@dataclass(frozen=True)
class Leg:
    """A spring-damper leg in E1: rate of its length, and force along it."""

    rate: sp.Expr
    tension: sp.Expr


def leg() -> Leg:
    """rate = -direction . velocity of the carrier's end, direction towards the ground; tension of spring and damper."""
    k, d, length, unstretched, rate = sp.symbols("stiffness damping distance length rate")
    return Leg(
        rate=-vector("direction").dot(vector("velocity")),
        tension=k * (length - unstretched) + d * rate,
    )
