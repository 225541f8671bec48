"""The force of a body by its power."""

from __future__ import annotations

import casadi as ca

from mahovik.core.stand.model import Body
from mahovik.proof.second.body import BodyEnergy, Expr

from .law import Tug  # noqa: TID252  # its package is that of the laws


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """The gradient of force . v by the twist; None where there is none."""
    law = body.law(Tug)
    if law is None:
        return None
    V = ca.SX.sym("V", 6)
    return ca.Function("tug", [V], [ca.gradient(ca.dot(ca.DM(law.force), V[:3]), V)])(V_r)


LAW = BodyEnergy(wrench=wrench)
