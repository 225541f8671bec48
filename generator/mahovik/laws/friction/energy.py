"""Friction along the freedoms by Rayleigh's dissipation function of their speeds."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Hold, Stand
from mahovik.laws.friction.law import Friction, frictions_of
from mahovik.proof.second.body import CarrierEnergy, Expr, unit


def force(stand: Stand, inputs: dict[str, Expr]) -> Expr:
    """Generalized force (6) -dR/dq' of the function R of all frictions, q_dot = V here."""
    frictions, hold = frictions_of(stand), stand.hold
    if not frictions or hold is None:
        return ca.MX.zeros(6)
    V = ca.SX.sym("V", 6)
    u = _speeds(hold, V)
    R = sum(_dissipation(friction, u[friction.freedom]) for friction in frictions)
    return ca.Function("friction_force", [V], [-ca.gradient(R, V)])(inputs["V"])


def _dissipation(friction: Friction, u: Expr) -> Expr:
    """R (W) with dR/du the force against a speed u.

    w = sqrt(u^2 + smoothing^2) is what the smoothed sign u/w is the slope of; the rise times this sign is the slope of
    an arc tangent of w, since u^2 = w^2 - smoothing^2 and the Stribeck speed is the larger of the two.
    """
    w = ca.sqrt(u**2 + friction.smoothing**2)
    R = friction.viscous * u**2 / 2 + friction.coulomb * w
    if friction.stribeck_speed is not None:
        span = ca.sqrt(friction.stribeck_speed**2 - friction.smoothing**2)
        R += (friction.breakaway - friction.coulomb) * friction.stribeck_speed**2 / span * ca.atan(w / span)
    return R


def _speeds(hold: Hold, V: Expr) -> Expr:
    """Speeds (m) of the freedoms: turning about an axis, the pivot along a direction; of a basis least squares."""
    if hold.freedoms[0].kind == "twist":
        return ca.DM(np.linalg.pinv(np.array([freedom.twist for freedom in hold.freedoms]).T)) @ V
    at_pivot = V[:3] + ca.cross(V[3:], ca.DM(hold.pivot))
    speeds = []
    for freedom in hold.freedoms:
        part = at_pivot if freedom.kind == "slide" else V[3:]
        speeds.append(ca.dot(ca.DM(unit(freedom.direction)), part))
    return ca.vertcat(*speeds)


LAW = CarrierEnergy(force)
