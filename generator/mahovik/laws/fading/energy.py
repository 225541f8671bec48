"""Fading damping of a body: half of what a quadratic form of the twist, faded, has for a gradient, and the rest."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fading.law import FadingDamping
from mahovik.proof.second.body import BodyEnergy, Expr


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """Wrench (6; N, N m) by its virtual power in every twist, in the body's frame; None where there is none."""
    law = body.law(FadingDamping)
    return None if law is None else _of_power(law)(V_r)


def _of_power(law: FadingDamping) -> Expr:
    """Twist -> gradient, by a virtual twist W, of the power -W^T linear V / e^(rate U)."""
    V, W = ca.SX.sym("V", 6), ca.SX.sym("W", 6)
    across = ca.bilin(ca.DM(np.array(law.linear)), W, V)
    power = -across / ca.exp(law.rate * ca.norm_2(V[:3]))
    return ca.Function("fading", [V], [ca.gradient(power, W)])


LAW = BodyEnergy(wrench=wrench)
