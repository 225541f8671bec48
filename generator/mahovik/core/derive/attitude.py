"""Attitude of the carrier: three sequences of elementary rotations, A and D of (10), unit quaternions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from mahovik.core.derive import SEQUENCES
from mahovik.core.derive.screw import blocks, cross, elementary, matrix, vector

ANGLES = ("psi", "theta", "phi")
rates = sp.symbols("psi_dot theta_dot phi_dot")


@dataclass(frozen=True)
class Attitude:
    """C (3x3, x0 = C x1), B (omega = B (psi', theta', phi')), its rate, its inverse and the singular function.

    All in cosines and sines by the symbols c_psi, s_psi, ...; B_dot also in the rates; B_inverse also in
    `singular_inv` = 1 / singular, singular = cos theta or sin theta.
    """

    C: sp.Matrix
    B: sp.Matrix
    B_dot: sp.Matrix
    B_inverse: sp.Matrix
    singular: sp.Expr


@cache
def attitude(sequence: str) -> Attitude:
    """The matrices of an attitude sequence. Derived: <omega> = C^T C', B from its coefficients."""
    axes = SEQUENCES[sequence]
    C = sp.eye(3)
    for axis, name in zip(axes, ANGLES, strict=True):
        angle = sp.Symbol(name)
        turn = elementary(axis, angle)
        C = C * turn.subs({sp.cos(angle): sp.Symbol(f"c_{name}"), sp.sin(angle): sp.Symbol(f"s_{name}")})
    spin = (C.T * _rate(C)).applyfunc(sp.expand)
    omega = sp.Matrix([spin[2, 1], spin[0, 2], spin[1, 0]])
    B = sp.Matrix(3, 3, lambda i, j: _reduce(omega[i].coeff(rates[j])))
    determinant = _reduce(B.det())
    singular = sp.Symbol("c_theta" if axes[0] != axes[2] else "s_theta")
    sign = sp.cancel(determinant / singular)  # +1 or -1

    def divided(x: sp.Expr) -> sp.Expr:
        quotient = sp.cancel(x / singular)
        return quotient if sp.denom(quotient) == 1 else x * sp.Symbol("singular_inv")

    return Attitude(C, B, _rate(B), (B.adjugate() / sign).applyfunc(_reduce).applyfunc(divided), singular)


def _rate(matrix_of_angles: sp.Matrix) -> sp.Matrix:
    """Derivative along the motion: (cos a)' = -sin a a', (sin a)' = cos a a'."""
    total = sp.zeros(*matrix_of_angles.shape)
    for name, rate in zip(ANGLES, rates, strict=True):
        c, s = sp.Symbol(f"c_{name}"), sp.Symbol(f"s_{name}")
        total += (matrix_of_angles.diff(s) * c - matrix_of_angles.diff(c) * s) * rate
    return total


def _reduce(expression: sp.Expr) -> sp.Expr:
    """The expression modulo c^2 + s^2 = 1 of each angle."""
    for name in ANGLES:
        c, s = sp.Symbol(f"c_{name}"), sp.Symbol(f"s_{name}")
        expression = sp.rem(sp.expand(expression), s**2 + c**2 - 1, s)
        expression = sp.expand(expression)
    return expression


def kinematics(sequence: str) -> tuple[sp.Matrix, sp.Matrix]:
    """A and D = A' of (10), 6x6, with omega of the carrier by symbols (C^T)' = -<omega> C^T."""
    result = attitude(sequence)
    C, zero = matrix("C"), sp.zeros(3)
    A = blocks(C.T, zero, zero, result.B)
    return A, blocks(-cross(vector("omega")) * C.T, zero, zero, result.B_dot)


def singular(sequence: str) -> sp.Expr:
    """cos theta or sin theta: A has no inverse where it is 0."""
    return attitude(sequence).singular


def angular_velocity(sequence: str) -> sp.Matrix:
    """omega = B a of angle rates a."""
    return attitude(sequence).B * vector("a")


def angular_acceleration(sequence: str) -> sp.Matrix:
    """omega* = B a + B' b of second rates a and rates b of the angles."""
    return attitude(sequence).B * vector("a") + attitude(sequence).B_dot * vector("b")


def angle_rates(sequence: str) -> sp.Matrix:
    """B^-1 a: rates of the angles of an angular velocity a."""
    return attitude(sequence).B_inverse * vector("a")


def quaternion_of(sequence: str) -> sp.Matrix:
    """Unit quaternion (w first) of a sequence, in cosines and sines of the half angles c_psi, s_psi, ..."""
    q = sp.Matrix([1, 0, 0, 0])
    for axis, name in zip(SEQUENCES[sequence], ANGLES, strict=True):
        turn = sp.zeros(4, 1)
        turn[0], turn[axis] = sp.Symbol(f"c_{name}"), sp.Symbol(f"s_{name}")
        q = quaternion_product(q, turn)
    return q


def quaternion_product(a: sp.Matrix, b: sp.Matrix) -> sp.Matrix:
    """Hamilton product, w first: the rotation b, then a (both active)."""
    w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]
    av, bv = a[1:, :], b[1:, :]
    return sp.Matrix([w]).col_join(a[0] * bv + b[0] * av + av.cross(bv))


def quaternion_rate() -> sp.Matrix:
    """q' = q (0, omega) / 2, omega in E1."""
    return quaternion_product(vector("q", 4), sp.Matrix([0]).col_join(vector("omega"))) / 2


def from_home() -> sp.Matrix:
    """h* q: the turn from the home attitude h to the attitude q, quaternions with w first."""
    home = vector("home", 4)
    return quaternion_product(sp.Matrix([home[0], -home[1], -home[2], -home[3]]), vector("q", 4))


def turned_home() -> sp.Matrix:
    """h q: the attitude after the turn q from the home attitude h."""
    return quaternion_product(vector("home", 4), vector("q", 4))


def rotation_of_quaternion() -> sp.Matrix:
    """C = E + k (w <u> + <u><u>), k = 2 / (q . q): right for a quaternion of any length, so that it needs no root."""
    q, k = vector("q", 4), sp.Symbol("k")
    u = q[1:, :]
    return (sp.eye(3) + k * (q[0] * cross(u) + cross(u) * cross(u))).applyfunc(_gather(k))


def _gather(k: sp.Symbol) -> sp.Lambda:
    """1 - k (...) and k (...): the bracket is not multiplied out."""

    def gather(x: sp.Expr) -> sp.Expr:
        constant = x.subs(k, 0)
        return constant + k * sp.expand((x - constant) / k)

    return gather
