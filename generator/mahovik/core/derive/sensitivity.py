"""Derivatives of (8) and of the drive torques by V, phi, phi' and phi'': for filters, linear design, (13).

The equations are linear in the sums over the flywheels, and of all flywheels only s depends on phi_s and phi_s'. So
their derivative by the phase is the same expression on the derivatives of one row's contributions: the row's columns
with the derivatives of their weights.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive import carrier
from mahovik.core.derive.order import WEIGHTS
from mahovik.core.derive.screw import Phi, cross
from mahovik.core.derive.symbols import symmetric, vector


def by_phase() -> dict[str, sp.Expr]:
    """Derivatives of the weights by phi, in the weights themselves."""
    c, s, c2, s2, dc, ds, dc2, ds2, ddc, dds, _, _ = sp.symbols(" ".join(WEIGHTS))
    zero = sp.S.Zero
    values = (-s, c, -2 * s2, 2 * c2, -ds, dc, -2 * ds2, 2 * dc2, -dds, ddc, zero, zero)
    return dict(zip(WEIGHTS, values, strict=True))


def by_speed() -> dict[str, sp.Expr]:
    """Derivatives of the weights by phi'."""
    c, s, c2, s2, dc, ds, *_ = sp.symbols(" ".join(WEIGHTS))
    zero, one = sp.S.Zero, sp.S.One
    values = (zero, zero, zero, zero, -s, c, -2 * s2, 2 * c2, -2 * ds, 2 * dc, one, zero)
    return dict(zip(WEIGHTS, values, strict=True))


def momentum() -> sp.Matrix:
    """(p, h) that a change of the sums adds at fixed V: no mass changes."""
    return (_mass_matrix() * carrier.V + carrier.mu_dot.col_join(carrier.h_rel)).applyfunc(sp.expand)


def remainder(weight: bool) -> sp.Matrix:
    """Contribution of a change of the sums to F - Phi Z - K_dot V - (a_rel, g_rel) - K V*; its (p, h) by symbols."""
    V_dot = vector("v_dot").col_join(vector("omega_dot"))
    force = sp.zeros(6, 1)
    if weight:
        force[3:, :] = cross(carrier.mu) * vector("g")
    momentum_rate = Phi(carrier.V) * carrier.p.col_join(carrier.h)
    changed = momentum_rate + carrier.mass_matrix_rate() * carrier.V + carrier.a_rel.col_join(carrier.g_rel)
    return force - changed - _mass_matrix() * V_dot


def _mass_matrix() -> sp.Matrix:
    """Change of K: of the first moment and the inertia."""
    return carrier.mass_matrix(added_mass=False).subs(sp.Symbol("m"), 0)


def momentum_by_twist() -> sp.Matrix:
    """d(-Phi(V) Z)/dV at fixed Z: [[0, <p>], [<p>, <h>]], 6x6."""
    found = sp.zeros(6)
    found[:3, 3:] = cross(carrier.p)
    found[3:, :3] = cross(carrier.p)
    found[3:, 3:] = cross(carrier.h)
    return found


def bias_torque_by_twist() -> sp.Matrix:
    """Derivative of the bias torque mu' . (omega x v) - omega . J' omega / 2 by V, six numbers."""
    mu_p, v, omega = vector("mu_p"), vector("v"), vector("omega")
    return (cross(mu_p) * omega).col_join(cross(v) * mu_p - vector("turned"))


def second_phase_derivatives() -> tuple[sp.Matrix, sp.Matrix]:
    """mu'' (3) and J'' (six) of a row by the phase."""
    c, s, c2, s2 = sp.symbols("c s c2 s2")
    mu = -vector("mu_c") * c - vector("mu_s") * s
    J = -vector("J_c", 6) * c - vector("J_s", 6) * s - 4 * vector("J_2c", 6) * c2 - 4 * vector("J_2s", 6) * s2
    return mu, J


def quadratic_form(six: str) -> sp.Expr:
    """omega . J omega of six numbers."""
    omega = vector("omega")
    return omega.dot(symmetric(six) * omega)


def bias_by_phase() -> sp.Expr:
    """Derivative of the bias torque by the phase: mu'' . origin_acceleration - omega . J'' omega / 2."""
    return vector("mu_pp").dot(vector("origin_acceleration")) - quadratic_form("J_pp") / 2
