"""Control derivatives of a body by their virtual power."""

from __future__ import annotations

import casadi as ca

from mahovik.core.stand.model import Body
from mahovik.laws.control.law import Control, ControlDerivatives, Factor
from mahovik.proof.second.body import BodyEnergy, Expr


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """Wrench (6; N, N m) of all derivatives, in the body's frame; None where there is none."""
    law = body.law(ControlDerivatives)
    return None if law is None else _of_power(body, law)(V_r)


def _of_power(body: Body, law: ControlDerivatives) -> Expr:
    """Twist -> gradient, by a virtual twist W, of the power of every product in its component of W."""
    V, W = ca.SX.sym("V", 6), ca.SX.sym("W", 6)
    power = ca.SX(0)
    for term in law.terms:
        product = W[term.wrench] * term.value
        for velocity in term.of:
            size = _size(body, law, velocity, V)
            product *= ca.fabs(size) if velocity.absolute else size
        power += product
    return ca.Function("control", [V], [ca.gradient(power, W)])


def _size(body: Body, law: ControlDerivatives, velocity: Factor, V: Expr) -> Expr:
    """A factor without its bars; the race is the excess of one speed ahead over another."""
    if not isinstance(velocity, Control):
        return V[velocity.component]
    value = body.inputs[velocity.source]
    if velocity.what != "race":
        return value
    behind = ca.norm_2(ca.vertcat(V[0], value * law.race**0.5))
    excess = behind - ca.fabs(V[0])
    return excess if value > 0.0 else -excess if value < 0.0 else 0.0


LAW = BodyEnergy(wrench=wrench)
