"""The columns of the regressor are the literal (8) and the literal drive torque, for a general body on a general mount.

Modulo c^2 + s^2 = 1 and R in SO(3), as in test_table_is_literal.
"""

from __future__ import annotations

import pytest
import sympy as sp

from derive.exact import circle, remainders, rotation, trigonometric
from mahovik.core.derive import carrier, flywheel, regressor
from mahovik.core.derive.screw import L, Phi, Theta, cross, e_bracket, elementary, f, vector

W = flywheel.generic()
SO3 = (*circle(sp.Symbol("c"), sp.Symbol("s")), *rotation(W.R))
G = vector("g")
PARAMETERS = sp.Matrix(regressor.BODY)
V_DOT, PHI_DDOT = vector("v_dot").col_join(vector("omega_dot")), sp.Symbol("phi_ddot")


def bind(name: str, values: sp.Matrix) -> dict[sp.Symbol, sp.Expr]:
    return dict(zip(vector(name), values, strict=True))


def turned_axes() -> sp.Matrix:
    """R C1: axes of the flywheel in E1."""
    return trigonometric(W.R * elementary(1, W.phi), W.phi)


def by_columns() -> sp.Matrix:
    """The wrench of one flywheel in its own frame: columns times parameters."""
    N, e1, v, omega = turned_axes(), sp.Matrix([1, 0, 0]), carrier.v, carrier.omega
    v_dot, omega_dot = V_DOT[:3, :], V_DOT[3:, :]
    proper = v_dot + cross(omega) * (v + cross(omega) * W.O) + cross(omega_dot) * W.O - G
    column = N.T * omega
    acceleration = N.T * omega_dot - W.phi_dot * cross(e1) * column + PHI_DDOT * e1
    known = bind("d", N.T * proper) | bind("w", column + W.phi_dot * e1) | bind("a", acceleration)
    return regressor.body_columns().xreplace(known) * PARAMETERS


def literal() -> sp.Matrix:
    """Theta_s V_s* + Phi(V_s) Z_s less the weight, in Es; row 3 is the drive torque."""
    Ls, Theta_s = L(W.O, W.R * elementary(1, W.phi)), Theta(W.m, W.b, W.J)
    V_s = Ls.T * carrier.V + f * W.phi_dot
    V_s_dot = Ls.T * V_DOT - W.phi_dot * e_bracket() * Ls.T * carrier.V + f * PHI_DDOT
    in_Es = trigonometric(Theta_s * V_s_dot + Phi(V_s) * Theta_s * V_s, W.phi)
    g = turned_axes().T * G
    return in_Es - (W.m * g).col_join(cross(W.b) * g)


@pytest.mark.parametrize("row", range(6))
def test_one_flywheel_in_its_own_frame(row: int) -> None:
    assert remainders([literal()[row] - by_columns()[row]], SO3) == []


@pytest.mark.slow
def test_the_carrier_rows_are_the_literal_equation() -> None:
    """K V* + M V + I phi'' + J phi' of one flywheel, (8), is L times its wrench; the force rows and the moment rows."""
    terms = flywheel.literal(W, carrier.V)
    M = Phi(carrier.V) * terms.K + terms.K_dot
    equation = terms.K * V_DOT + M * carrier.V + terms.I * PHI_DDOT + terms.J * W.phi_dot
    weight = (W.m * G).col_join(cross(W.m * W.O) * G)
    N = turned_axes()
    moment = N * W.b
    weight += sp.zeros(3, 1).col_join(cross(moment) * G)
    numbers = {**dict(zip(W.O, (2, -1, 3), strict=True)), W.phi_dot: 5}
    left = trigonometric(equation, W.phi) - weight
    right = L(W.O, N) * by_columns()
    assert remainders((left - right).xreplace(numbers), SO3) == []


def test_added_mass_is_the_literal_equation() -> None:
    """Lambda V* + Phi(V) Lambda V for a general symmetric Lambda."""
    numbers = sp.Matrix([sp.Symbol(f"L[{k}]") for k in range(21)])
    Lambda = sp.zeros(6)
    for number, (i, j) in zip(numbers, regressor.UPPER, strict=True):
        Lambda[i, j] = Lambda[j, i] = number
    V = vector("v").col_join(vector("w"))
    literal_wrench = Lambda * vector("d").col_join(vector("a")) + Phi(V) * Lambda * V
    assert remainders(literal_wrench - regressor.added_mass_columns() * numbers) == []
