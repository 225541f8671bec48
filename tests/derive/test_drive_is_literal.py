"""The proof on which `torque` and `coupled` rest: the drive torque by a row of harmonics is exactly the literal one.

For a general flywheel on a general mount, modulo c^2 + s^2 = 1 and R in SO(3): see test_table_is_literal.
"""

from __future__ import annotations

import sympy as sp

from derive import table
from derive.exact import circle, remainders, rotation, trigonometric
from mahovik.core.derive import carrier, drive, flywheel
from mahovik.core.derive.symbols import symmetric, vector

W = flywheel.generic()
SO3 = (*circle(sp.Symbol("c"), sp.Symbol("s")), *rotation(W.R))


def by_the_table() -> sp.Expr:
    """I_s . V* + Theta_ff phi'' + bias, in the flywheel's own symbols."""
    columns, weights = table.row(W), table.weights()
    mu_p, J_p = (part.xreplace(weights).xreplace(columns) for part in drive.phase_derivatives())
    twist = table.bind("V", carrier.V)
    origin_acceleration, spun = (
        drive.origin_acceleration(weight=False).xreplace(twist),
        drive.spin_products().xreplace(twist),
    )
    known = (
        table.bind("mu_p", mu_p)
        | table.bind("J_p", J_p)
        | table.bind("origin_acceleration", origin_acceleration)
        | table.bind("spun", spun)
    )
    bias = drive.bias_torque(displaces=False).xreplace(known)
    return table.columns(W).I.dot(drive.V_dot) + W.J[0, 0] * drive.phi_ddot + bias


def test_the_drive_torque() -> None:
    """f^T (Theta V_s* + Phi(V_s) Z_s) with V_s, V_s* of the paper."""
    literal = trigonometric(drive.literal_torque(W, carrier.V), W.phi)
    assert remainders([literal[3] - by_the_table()], SO3) == []


def test_products_of_spin() -> None:
    """-omega . J omega / 2 for any symmetric J."""
    omega = vector("omega")
    energy = omega.dot(symmetric("J") * omega)
    assert remainders([2 * drive.spin_products().dot(vector("J", 6)) + energy]) == []
