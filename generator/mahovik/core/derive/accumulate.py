"""Contribution of a row of harmonics at a phase: first moment, inertia and relative momentum, with their rates.

With c = cos phi, s = sin phi and their derivatives along the motion, a row gives
  mu = mu_c c + mu_s s                  first moment about O1
  J  = J_c c + J_s s + J_2c c2 + J_2s s2
  (mu', t) phi'                         I_s phi' of (2): force part mu_dot, moment part t phi'
  d/dt of these at fixed carrier        K_dot of (6), and the flywheel terms of (5)
Constants (harmonic 0 of mu and J) are not here: they belong to the carrier.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from mahovik.core.derive.screw import vector

c, s, c2, s2, dc, ds, dc2, ds2, ddc, dds = sp.symbols("c s c2 s2 dc ds dc2 ds2 ddc dds")
phi_dot, phi_ddot = sp.symbols("phi_dot phi_ddot")


def weights() -> dict[str, sp.Expr]:
    """Factors of a row's harmonics and their time derivatives, by name, derived by differentiation along the motion.

    c, s (cosine and sine of phi) are given; c2, s2 are those of 2 phi, two_c2, two_s2 twice c2, s2; dc, ds, dc2, ds2
    are first, ddc, dds second time derivatives.
    """
    t = sp.Symbol("t")
    phi = sp.Function("phi")(t)
    names = [
        (sp.Derivative(phi, (t, 2)), phi_ddot),
        (sp.Derivative(phi, t), phi_dot),
        (sp.cos(2 * phi), c2),
        (sp.sin(2 * phi), s2),
        (sp.cos(phi), c),
        (sp.sin(phi), s),
    ]
    double = {"c2": 1 - 2 * s * s, "s2": 2 * s * c, "two_c2": 2 - 4 * s * s, "two_s2": 4 * s * c}
    rates = {"dc": sp.cos(phi).diff(t), "ds": sp.sin(phi).diff(t)}
    rates |= {"dc2": sp.cos(2 * phi).diff(t), "ds2": sp.sin(2 * phi).diff(t)}
    named = {name: value.subs(names) for name, value in rates.items()}
    # Second rates in terms of the first: d/dt(-s phi') = -s phi'' - ds phi'.
    named["ddc"] = sp.cos(phi).diff(t, 2).subs(names).subs(c * phi_dot**2, ds * phi_dot)
    named["dds"] = sp.sin(phi).diff(t, 2).subs(names).subs(s * phi_dot**2, -dc * phi_dot)
    return double | named


@dataclass(frozen=True)
class Sums:
    """Contribution of one row: mu, mu_dot, J, J_dot; relative angular momentum h_rel = t phi'; rates a_rel, g_rel.

    I_s phi' = (mu_dot, h_rel); (a_rel, g_rel) = I_s phi'' + Ls [<e>] Theta_s f phi'^2, the last two sums of (5).
    """

    mu: sp.Matrix
    mu_dot: sp.Matrix
    J: sp.Matrix
    J_dot: sp.Matrix
    h_rel: sp.Matrix
    a_rel: sp.Matrix
    g_rel: sp.Matrix


@cache
def sums() -> Sums:
    """The contribution of one row of columns mu_c, mu_s (3), J_c, J_s, J_2c, J_2s (6), t_0, t_c, t_s (3)."""
    t = sp.Symbol("time")
    C, S, C2, S2, P = (sp.Function(n)(t) for n in ("C", "S", "C2", "S2", "P"))
    mu = vector("mu_c") * C + vector("mu_s") * S
    J = vector("J_c", 6) * C + vector("J_s", 6) * S + vector("J_2c", 6) * C2 + vector("J_2s", 6) * S2
    # c phi' = ds and s phi' = -dc: the moment part of I_s phi' needs no weights of its own.
    h_rel = vector("t_0") * P + vector("t_c") * S.diff(t) - vector("t_s") * C.diff(t)
    names = [
        (sp.Derivative(C, (t, 2)), ddc),
        (sp.Derivative(S, (t, 2)), dds),
        (sp.Derivative(P, t), phi_ddot),
        (sp.Derivative(C, t), dc),
        (sp.Derivative(S, t), ds),
        (sp.Derivative(C2, t), dc2),
        (sp.Derivative(S2, t), ds2),
        (P, phi_dot),
        (C, c),
        (S, s),
        (C2, c2),
        (S2, s2),
    ]
    return Sums(
        mu=mu.subs(names),
        mu_dot=mu.diff(t).subs(names),
        J=J.subs(names),
        J_dot=J.diff(t).subs(names),
        h_rel=h_rel.subs(names),
        a_rel=mu.diff(t, 2).subs(names),
        g_rel=h_rel.diff(t).subs(names),
    )


@dataclass(frozen=True)
class Columns:
    """Column of one flywheel in I and its derivative by phase: I_s = (mu', t), dI_s/dphi = (mu'', t')."""

    I: sp.Matrix
    I_prime: sp.Matrix


@cache
def columns() -> Columns:
    """I_s of (9) and its derivative by the phase, of a row."""
    phi = sp.Symbol("phi")
    cos, sin = sp.cos(phi), sp.sin(phi)
    names = [(cos, c), (sin, s)]
    mu = vector("mu_c") * cos + vector("mu_s") * sin
    t = vector("t_0") + vector("t_c") * cos + vector("t_s") * sin
    column = mu.diff(phi).col_join(t)
    return Columns(column.subs(names), column.diff(phi).subs(names))
