"""Local coordinates q = (delta, xi, phi) of the system at its present pose, and rates in them.

    x = delta + E(xi) rho(phi),     R = E(xi) G(phi)

are place and axes of anything that moves with the carrier, on the inertial axes that coincide with E1 at this
instant: delta (3; m) moves O1, xi (3; rad) turns the carrier, phi (rad) turns a flywheel. The present pose is
delta = 0, xi = 0, so q' = (V, phi') there. E(xi) is exact to the second order in xi: no equation of motion, and no
acceleration, differentiates it more than twice, so all that is found at xi = 0 is exact. In these coordinates
Lagrange's equations hold as they stand, without any rule for quasi-velocities.
"""

from __future__ import annotations

from typing import Any

import casadi as ca

Expr = Any
"""A CasADi expression (SX, MX) or matrix of numbers (DM): CasADi has no common type for them."""


class Chart:
    """Symbols of the coordinates of one body and their rates: q, q_dot, q_ddot (7)."""

    def __init__(self) -> None:
        self.q = ca.SX.sym("q", 7)
        self.q_dot = ca.SX.sym("q_dot", 7)
        self.q_ddot = ca.SX.sym("q_ddot", 7)
        self.delta, self.xi, self.phi = self.q[:3], self.q[3:6], self.q[6]

    def rate(self, expression: Expr) -> Expr:
        """d/dt of an expression in q, along q'; of the same shape."""
        return directional_derivative(expression, self.q, self.q_dot)

    def second_rate(self, expression: Expr) -> Expr:
        """d/dt of an expression in q and q', along (q', q''); of the same shape.

        The parts by q' and by q'' are formed apart: where the first cancels in itself, it leaves the second intact.
        """
        return self.rate(expression) + directional_derivative(expression, self.q_dot, self.q_ddot)

    def here(self, expression: Expr) -> Expr:
        """The expression at the present pose, delta = 0 and xi = 0."""
        return ca.substitute(expression, self.q[:6], ca.SX.zeros(6))


def directional_derivative(expression: Expr, variables: Expr, rates: Expr) -> Expr:
    """Directional derivative of a matrix expression along `rates` of `variables`; of the same shape."""
    return ca.reshape(ca.jtimes(ca.vec(expression), variables, rates), *expression.shape)


def cross(a: Expr) -> Expr:
    """<a> (3x3), <a> b = a x b."""
    return ca.skew(a)


def turn(xi: Expr) -> Expr:
    """E(xi) = 1 + <xi> + <xi>^2 / 2 (3x3): the rotation by the vector xi, to the second order."""
    return ca.SX.eye(3) + cross(xi) + cross(xi) @ cross(xi) / 2


def angular_velocity(R: Expr, R_dot: Expr) -> Expr:
    """omega (3; rad/s) of axes R with rates R_dot, in these axes: <omega> = R^T R', its antisymmetric part."""
    S = R.T @ R_dot
    return ca.vertcat(S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]) / 2


def inertial_acceleration(V: Expr, V_dot: Expr) -> Expr:
    """(delta'', xi'') (6; m/s2, rad/s2) of a carrier with twist V whose components change at V_dot.

    delta' = E(xi) v at any pose, so delta'' is its rate; and xi'' = omega' at xi = 0.
    """
    xi = ca.SX.sym("xi", 3)
    v, omega = ca.SX.sym("v", 3), ca.SX.sym("omega", 3)
    turning = ca.substitute(directional_derivative(turn(xi) @ v, xi, omega), xi, ca.SX.zeros(3))
    rate = ca.Function("turning", [v, omega], [turning])
    return ca.vertcat(V_dot[:3] + rate(V[:3], V[3:]), V_dot[3:])
