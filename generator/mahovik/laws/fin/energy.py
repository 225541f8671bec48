"""Lift and drag of a body's fins by their virtual power in the fin's own axes."""

from __future__ import annotations

import casadi as ca
import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fin.law import Fin, Fins
from mahovik.proof.second.body import BodyEnergy, Expr


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """Wrench (6; N, N m) of all fins, in the body's frame; None where there is none."""
    law = body.law(Fins)
    return None if law is None else sum((_of_fin(fin)(V_r) for fin in law.fins), ca.MX.zeros(6))


def _of_fin(fin: Fin) -> Expr:
    """Twist -> wrench that has the power of the fin's force in every twist."""
    V = ca.SX.sym("V", 6)
    # columns: chord, normal by Gram and Schmidt of the span, and the rest of the right-handed triad
    forward, side = np.array(fin.chord), np.array(fin.span)
    forward = forward / np.sqrt(forward @ forward)
    side = side - forward * (forward @ side)
    side = side / np.sqrt(side @ side)
    axes = np.column_stack([forward, side, np.cross(forward, side)])
    velocity = axes.T @ (V[:3] + ca.cross(V[3:], ca.DM(fin.position)))
    ahead, aside, down = velocity[0], velocity[1], velocity[2]
    head = 0.5 * fin.density * fin.area * ahead**2
    if fin.speed != "along":
        head += 0.5 * fin.density * fin.area * down**2
    if fin.speed == "whole":
        head += 0.5 * fin.density * fin.area * aside**2
    flow = 0.0
    if fin.incidence:  # at rest any angle, as no force depends on it
        flow = ca.atan2(down, ca.if_else(down**2 + ahead**2 > 0.0, ahead, 1.0))
    C_L = _lift(fin, flow + fin.deflection)
    drag, lift = head * (fin.drag + fin.induced * C_L * C_L), head * C_L
    force = ca.vertcat(lift * ca.sin(flow) - drag * ca.cos(flow), 0.0, -lift * ca.cos(flow) - drag * ca.sin(flow))
    return ca.Function("fin", [V], [ca.jtimes(velocity, V, force, True)])


def _lift(fin: Fin, angle: Expr) -> Expr:
    """The line up to the stall, the line through the right angle beyond it: the lower of both, and none below zero."""
    size = ca.fabs(angle)
    if fin.stall is not None:
        rest = 0.5 * np.pi
        size = ca.fmax(0.0, ca.fmin(size, (rest - size) * (fin.stall / (rest - fin.stall))))
    return fin.lift_slope * ca.sign(angle) * size


LAW = BodyEnergy(wrench=wrench)
