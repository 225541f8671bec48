"""Equations of the carrier (2)-(9) in the sums of all bodies: Z, K, K_dot, M, and the solution of (8).

K = [[A, B^T], [B, J]] with A = m E + Lambda_11, B = <mu> + G, G = Lambda_21, J with Lambda_22: A is constant, so
that a 3x3 solve is left. Without added mass A = m E and G = 0 and all expressions shrink by themselves.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import Phi, blocks, cross
from mahovik.core.derive.symbols import matrix, six_of, symmetric, vector

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


def velocity_column() -> sp.Matrix:
    """Phi(V) times one column of six numbers `column`: a column of Phi K in (9), or Phi I_s in J_s of (9)."""
    return Phi(V) * vector("column", 6)


def schur_coupling(added_mass: bool) -> sp.Matrix:
    """U = A^-1 B^T as 9 numbers, from A_inv (six) and B (9); without added mass A^-1 = m_inverse E."""
    B = matrix("B")
    if added_mass:
        return symmetric("A_inv") * B.T
    return sp.Symbol("m_inverse") * coupling_block(False).T


def reduced_inertia(added_mass: bool) -> sp.Matrix:
    """S = J - B A^-1 B^T, six numbers, with U = A^-1 B^T by symbols: the 3x3 matrix left to be solved."""
    B = matrix("B") if added_mass else coupling_block(False)
    return six_of(symmetric("J") - B * _u(added_mass))


def reduced_moment(added_mass: bool) -> sp.Matrix:
    """n - B A^-1 f for K (v*, omega*) = (f, n): right-hand side of S omega* = ..."""
    return vector("n") - _u(added_mass).T * vector("f")


def linear_part(added_mass: bool) -> sp.Matrix:
    """v* = A^-1 f - U omega*."""
    inverse = symmetric("A_inv") if added_mass else sp.Symbol("m_inverse") * sp.eye(3)
    return inverse * vector("f") - _u(added_mass) * vector("omega_dot")


def _u(added_mass: bool) -> sp.Matrix:
    """U by symbols: 9 with added mass; without it U is skew, and three numbers rho = mu / m suffice."""
    return matrix("U") if added_mass else cross(vector("rho")).T


def centre_offset() -> sp.Matrix:
    """rho = mu / m: without added mass U = -<rho>."""
    return sp.Symbol("m_inverse") * mu


def inverse_of_symmetric() -> tuple[sp.Matrix, sp.Expr]:
    """Adjugate (six numbers) and determinant of a symmetric 3x3 matrix A; the determinant by its first row."""
    A = symmetric("A")
    adjugate = A.adjugate()
    cofactors = vector("cofactor", 6)
    return six_of(adjugate), A[0, 0] * cofactors[0] + A[0, 1] * cofactors[3] + A[0, 2] * cofactors[4]


def kinetic_energy() -> sp.Expr:
    """T = (V . Z + phi' . (I^T V + Theta_ff phi')) / 2 of all bodies: the flywheels' part by the sum `spin`."""
    return (V.dot(p.col_join(h)) + sp.Symbol("spin")) / 2


def momentum_in_E0() -> sp.Matrix:
    """Z0 = L1 Z of (1): about the origin of E0, in its axes; C = attitude, r = position of O1."""
    C, r = matrix("C"), vector("r")
    p0 = C * p
    return p0.col_join(C * h + cross(r) * vector("p0"))
