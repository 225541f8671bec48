"""The suspension as expressions."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.attitude import quaternion_product
from mahovik.core.derive.symbols import vector


def relative_quaternion() -> sp.Matrix:
    """Quaternion of C_eq^T C: the conjugate of q_eq times q."""
    q_eq = vector("q_eq", 4)
    return quaternion_product(sp.Matrix([q_eq[0], -q_eq[1], -q_eq[2], -q_eq[3]]), vector("q", 4))


def wrench_row() -> sp.Expr:
    """One row of stiffness x + damping V."""
    return vector("stiffness", 6).dot(vector("x", 6)) + vector("damping", 6).dot(vector("V", 6))
