"""Equations of the carrier (2)-(9) in the sums of all bodies: Z, K, K_dot, M, and the solution of (8).

K = [[A, B^T], [B, J]] with A = m E + Lambda_11, B = <mu> + G, G = Lambda_21, J with Lambda_22: A is constant, so
that a 3x3 solve is left. Without added mass A = m E and G = 0 and all expressions shrink by themselves.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import Phi, blocks, cross, matrix, six_of, symmetric, vector

v, omega = vector("v"), vector("omega")
V = v.col_join(omega)
mu, mu_dot, h_rel, a_rel, g_rel = (vector(n) for n in ("mu", "mu_dot", "h_rel", "a_rel", "g_rel"))
p, h = vector("p"), vector("h")


def translation_block(added_mass: bool) -> sp.Matrix:
    """A: constant mass block of K, m E + Lambda_11."""
    return symmetric("A") if added_mass else sp.Symbol("m") * sp.eye(3)


def coupling_block(added_mass: bool) -> sp.Matrix:
    """B = <mu> + G: lower left block of K."""
    return cross(mu) + matrix("G") if added_mass else cross(mu)


def mass_matrix(added_mass: bool) -> sp.Matrix:
    """K of (2) in the sums A (or m), mu, G, J."""
    B = coupling_block(added_mass)
    return blocks(translation_block(added_mass), B.T, B, symmetric("J"))


def mass_matrix_rate() -> sp.Matrix:
    """K_dot of (6) in the sums mu_dot, J_dot: added mass and carrier do not change in E1."""
    return blocks(sp.zeros(3), -cross(mu_dot), cross(mu_dot), symmetric("J_dot"))


def momentum(added_mass: bool) -> sp.Matrix:
    """Z = K V + sum I_s phi' of (2) as (p, h)."""
    return mass_matrix(added_mass) * V + mu_dot.col_join(h_rel)


def remainder() -> sp.Matrix:
    """F - Phi Z - K_dot V - (a_rel, g_rel): right-hand side of K V* = ..., (4), (5), (8). Z by the symbols p, h."""
    F = vector("F", 6)
    return F - Phi(V) * p.col_join(h) - mass_matrix_rate() * V - a_rel.col_join(g_rel)


def reduced_inertia(added_mass: bool) -> sp.Matrix:
    """S = J - B A^-1 B^T, six numbers, with U = A^-1 B^T by symbols: the 3x3 matrix left to be solved."""
    B = matrix("B") if added_mass else coupling_block(False)
    return six_of(symmetric("J") - B * _u(added_mass))


def _u(added_mass: bool) -> sp.Matrix:
    """U by symbols: 9 with added mass; without it U is skew, and three numbers rho = mu / m suffice."""
    return matrix("U") if added_mass else cross(vector("rho")).T
