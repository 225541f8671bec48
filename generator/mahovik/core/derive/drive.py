"""Drive torque of one flywheel, and the coupled motion of the whole system with the flywheels eliminated.

Literal, in the frame of the flywheel: tau = f^T (Theta V_s* + Phi(V_s) Z_s) - f^T P_s, with V_s = L^T V + f phi',
V_s* = L^T V* - phi' [<e>] L^T V + f phi''. In a row of harmonics nothing of phi' is left in it:
  tau = mu' . (v* + omega x v) + t . omega* + Theta_ff phi'' - omega . J' omega / 2 - f^T P_s,
' the derivative by the phase. `tests/derive` proves that both are the same.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.flywheel import Generic
from mahovik.core.derive.screw import L, Phi, Theta, bracket, cross, e_bracket, elementary, f
from mahovik.core.derive.symbols import symmetric, vector

V_dot = vector("v_dot").col_join(vector("omega_dot"))
phi_ddot = sp.Symbol("phi_ddot")


def literal_torque(w: Generic, V: sp.Matrix) -> sp.Matrix:
    """Theta_s V_s* + Phi(V_s) Z_s, the wrench that accelerates a flywheel, in its own frame; row 3 is the torque."""
    Ls = L(w.O, w.R * elementary(1, w.phi))
    Theta_s = Theta(w.m, w.b, w.J)
    V_s = Ls.T * V + f * w.phi_dot
    V_s_dot = Ls.T * V_dot - w.phi_dot * e_bracket() * Ls.T * V + f * phi_ddot
    return Theta_s * V_s_dot + Phi(V_s) * Theta_s * V_s


def bias_torque(displaces: bool) -> sp.Expr:
    """Torque at V* = 0, phi'' = 0: mu' . (omega x v - g) - omega . J' omega / 2; the weight's moment is mu' . g.

    `mu_p`, `J_p`, `displaced_p` are derivatives by the phase, `origin_acceleration` = omega x v (less g where there is
    weight), `spun` are `spin_products`. Displaced fluid pulls the other way: + displaced' . g.
    """
    bias = vector("mu_p").dot(vector("origin_acceleration")) + vector("J_p", 6).dot(vector("spun", 6))
    return bias + vector("displaced_p").dot(vector("g")) if displaces else bias


def spin_products() -> sp.Matrix:
    """Six numbers whose product with those of a symmetric J is -omega . J omega / 2: the same for all flywheels."""
    J, omega = vector("J", 6), vector("omega")
    energy = -sp.Rational(1, 2) * omega.dot(symmetric("J") * omega)
    return sp.Matrix([sp.expand(energy).coeff(x) for x in J])


def origin_acceleration(weight: bool) -> sp.Matrix:
    """omega x v - g: acceleration of O1 at V* = 0, as a pendulum feels it."""
    found = cross(vector("omega")) * vector("v")
    return found - vector("g") if weight else found


def phase_derivatives() -> tuple[sp.Matrix, sp.Matrix]:
    """mu' and J' (six) of a row by the phase, with c, s, two_c2 = 2 cos 2 phi and two_s2 = 2 sin 2 phi."""
    phi = sp.Symbol("phi")
    cos, sin, cos2, sin2 = sp.cos(phi), sp.sin(phi), sp.cos(2 * phi), sp.sin(2 * phi)
    mu = vector("mu_c") * cos + vector("mu_s") * sin
    J = vector("J_c", 6) * cos + vector("J_s", 6) * sin + vector("J_2c", 6) * cos2 + vector("J_2s", 6) * sin2
    half = sp.Rational(1, 2)
    names = [(cos2, half * sp.Symbol("two_c2")), (sin2, half * sp.Symbol("two_s2"))]
    names += [(cos, sp.Symbol("c")), (sin, sp.Symbol("s"))]
    return mu.diff(phi).subs(names), J.diff(phi).subs(names)


def turned_twist() -> sp.Matrix:
    """[C1]^T of six numbers `U`, with c, s of the phase."""
    return _to_turning_axes() * vector("U", 6)


def _to_turning_axes() -> sp.Matrix:
    """[C1]^T: from the axes at phi = 0 to those of the flywheel, which turn."""
    c, s = sp.symbols("c s")
    C1 = sp.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]])
    return bracket(C1).T
