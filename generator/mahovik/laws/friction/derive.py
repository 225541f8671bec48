"""Friction of a freedom as expressions."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from mahovik.core.derive.symbols import vector


@dataclass(frozen=True)
class Friction:
    """Speed of the freedom, and the force or moment against it."""

    speed: sp.Expr
    drag: sp.Expr


def friction() -> Friction:
    """speed = W . V; drag = viscous speed + (coulomb + (breakaway - coulomb) slow) sign.

    sign = speed / sqrt(speed^2 + smoothing^2), slow = vs^2 / (vs^2 + speed^2) are quotients, which the lowering makes.
    """
    viscous, coulomb, breakaway, speed = sp.symbols("viscous coulomb breakaway speed")
    sign, slow = sp.symbols("sign slow")
    return Friction(
        speed=vector("direction", 6).dot(vector("V", 6)),
        drag=viscous * speed + (coulomb + (breakaway - coulomb) * slow) * sign,
    )
