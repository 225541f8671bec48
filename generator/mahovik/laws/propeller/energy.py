"""Thrust and torque of a body's propellers by their virtual power, from the advance ratio."""

from __future__ import annotations

import math

import casadi as ca

from mahovik.core.stand.model import Body, Vec3
from mahovik.laws.propeller.law import Propeller, Propellers
from mahovik.proof.second.body import BodyEnergy, Expr


def wrench(body: Body, V_r: Expr) -> Expr | None:
    """Wrench (6; N, N m) of all propellers, in the body's frame; None where there is none."""
    law = body.law(Propellers)
    return None if law is None else sum((_of_propeller(p)(V_r) for p in law.propellers), ca.MX.zeros(6))


def _of_propeller(p: Propeller) -> Expr:
    """Twist -> wrench with the power of thrust and torque in every twist."""
    V = ca.SX.sym("V", 6)
    axis = ca.DM(p.axis) / math.sqrt(math.fsum(x * x for x in p.axis))
    through = V[:3] + ca.cross(V[3:], ca.DM(p.position))
    ahead, turn = ca.dot(axis, through), ca.dot(axis, V[3:])
    flow = (1.0 - p.wake) * (ca.norm_2(through) if p.whole else ahead)
    T = (1.0 - p.deduction) * p.density * p.diameter**4 * _coefficient(p.thrust, p, flow)
    Q = p.density * p.diameter**5 * _coefficient(p.torque, p, flow)
    power_of = ca.vertcat(ahead, turn), ca.vertcat(T, Q if p.left else -Q)
    return ca.Function("propeller", [V], [ca.jtimes(power_of[0], V, power_of[1], True)])


def _coefficient(k: Vec3, p: Propeller, flow: Expr) -> Expr:
    """K(J) over J in turns a second, |n| n K; where nothing turns, what is left of it."""
    turns = 0.5 * p.speed / math.pi
    if turns == 0.0:
        return k[2] * ca.fabs(flow) * flow / p.diameter**2
    J = flow / (turns * p.diameter)
    return math.copysign(turns**2, turns) * (k[0] + k[1] * J + k[2] * ca.fabs(J) * J)


LAW = BodyEnergy(wrench=wrench)
