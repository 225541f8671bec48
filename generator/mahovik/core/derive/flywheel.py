"""One generic flywheel: its literal terms of (2), (5), (6), (9), and their reduction to a table of harmonics.

Literal: Es has origin O and axes R C1(phi) in E1; Theta is its spatial inertia in its own frame. Since [C1] turns
the inertia about the spin axis only, `Theta(phi) = [C1] Theta [C1]^T` is a Fourier polynomial of second order, and
`L Theta L^T = L0 Theta(phi) L0^T` with the constant `L0 = T(O) [R]`. So a flywheel is a row of constants: the
harmonics of Theta(phi) carried to E1 by L0. `tests/derive` proves that both forms are the same.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from mahovik.core.derive.screw import (
    L,
    Phi,
    T,
    Theta,
    blocks,
    bracket,
    cross,
    e_bracket,
    elementary,
    f,
    matrix,
    six_of,
    symmetric,
    vector,
)

HARMONICS = ("0", "c", "s", "2c", "2s")
"""Constant, cos phi, sin phi, cos 2 phi, sin 2 phi."""


@dataclass(frozen=True)
class Generic:
    """The symbols of one flywheel: mass m, first moment b = m rc and J in Es; O and R = mounting axes in E1; phase."""

    m: sp.Symbol
    b: sp.Matrix
    J: sp.Matrix
    O: sp.Matrix
    R: sp.Matrix
    phi: sp.Symbol
    phi_dot: sp.Symbol


def generic() -> Generic:
    """A flywheel with general unbalance, asymmetry, products of inertia, position and mounting."""
    phi, phi_dot = sp.symbols("phi phi_dot")
    return Generic(sp.Symbol("m"), vector("b"), symmetric("J"), vector("O"), matrix("R"), phi, phi_dot)


@dataclass(frozen=True)
class Literal:
    """Terms of one flywheel in (8), as printed: K_s (2), K_dot_s (6), I_s and J_s (9)."""

    K: sp.Matrix
    K_dot: sp.Matrix
    I: sp.Matrix
    J: sp.Matrix


def literal(w: Generic, V: sp.Matrix) -> Literal:
    """The terms of (2), (6), (9) from the paper's factors, at carrier twist V. R is taken as it is: 9 symbols."""
    Ls = L(w.O, w.R * elementary(1, w.phi))
    Theta_s = Theta(w.m, w.b, w.J)
    e = e_bracket()
    return Literal(
        K=Ls * Theta_s * Ls.T,
        K_dot=Ls * (e * Theta_s - Theta_s * e) * Ls.T * w.phi_dot,
        I=Ls * Theta_s * f,
        J=(Phi(V) * Ls + Ls * e * w.phi_dot) * Theta_s * f,
    )


def harmonics(expression: sp.Expr, phi: sp.Symbol) -> dict[str, sp.Expr]:
    """Coefficients of a Fourier polynomial of second order in phi, by HARMONICS. Exact.

    Raises ValueError for an expression of higher order.
    """
    c, s = sp.symbols("cos_phi sin_phi")
    polynomial = sp.Poly(sp.expand(expression.subs({sp.cos(phi): c, sp.sin(phi): s})), c, s)
    result = dict.fromkeys(HARMONICS, sp.S.Zero)
    half = sp.Rational(1, 2)
    parts: dict[tuple[int, int], dict[str, sp.Expr]] = {
        (0, 0): {"0": sp.S.One},
        (1, 0): {"c": sp.S.One},
        (0, 1): {"s": sp.S.One},
        (2, 0): {"0": half, "2c": half},
        (0, 2): {"0": half, "2c": -half},
        (1, 1): {"2s": half},
    }
    for powers, coefficient in polynomial.terms():
        if powers not in parts:
            raise ValueError(f"order {powers} of cos, sin is no Fourier polynomial of second order")
        for name, weight in parts[powers].items():
            result[name] += weight * coefficient
    return result


@dataclass(frozen=True)
class Inertia:
    """Mass, first moment (3) and six moments of inertia, of a spatial inertia or of one of its harmonics."""

    m: sp.Expr
    b: sp.Matrix
    J: sp.Matrix


def spun_inertia(w: Generic) -> dict[str, Inertia]:
    """Harmonics of Theta(phi) = [C1] Theta [C1]^T, in mounting axes (those of Es at phi = 0) about Os."""
    C1 = elementary(1, w.phi)
    turned = bracket(C1) * Theta(w.m, w.b, w.J) * bracket(C1).T
    first_moment = C1 * w.b
    J = six_of(turned[3:, 3:])
    by_b = [harmonics(x, w.phi) for x in first_moment]
    by_J = [harmonics(x, w.phi) for x in J]
    return {
        k: Inertia(
            m=w.m if k == "0" else sp.S.Zero,
            b=sp.Matrix([h[k] for h in by_b]),
            J=sp.Matrix([sp.factor_terms(h[k]) for h in by_J]),
        )
        for k in HARMONICS
    }


def rotated_tensor(J: sp.Matrix, R: sp.Matrix) -> tuple[sp.Matrix, sp.Matrix]:
    """R J R^T in two steps, so that nothing is multiplied twice: (R J as 9 entries, then six from symbols RJ)."""
    RJ = matrix("RJ")
    return R * J, six_of(RJ * R.T)


def shifted_inertia(m: sp.Expr, b: sp.Matrix, J: sp.Matrix, O: sp.Matrix) -> tuple[sp.Matrix, sp.Matrix]:
    """T Theta T^T: the same body about O1, Os being at O; axes do not turn. (mu, six of J by the symbols mu).

    In two steps, T Theta first: its lower left block is <mu>, mu = m O + b, and J' = J - <O><b> - <mu><O>.
    """
    half = T(O) * Theta(m, b, J)
    skew = half[3:, :3]
    mu = sp.Matrix([skew[2, 1], skew[0, 2], skew[1, 0]])
    named = blocks(half[:3, :3], half[:3, 3:], cross(vector("mu")), half[3:, 3:])
    return mu, six_of((named * T(O).T)[3:, 3:])


def spin_momentum(b: sp.Matrix, J: sp.Matrix, O: sp.Matrix) -> sp.Matrix:
    """Angular part of T Theta a, a = (0, axis): moment of I_s about O1 for the spin axis `axis` in E1 (2), (9).

    Theta in carrier axes about Os; its mass plays no part.
    """
    axis = vector("axis")
    return (T(O) * Theta(sp.S.Zero, b, J) * sp.Matrix([0, 0, 0, *axis]))[3:, :]
