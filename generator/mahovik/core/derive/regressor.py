"""Columns of the regressor: what (8) and the drive torques take of each mass, first moment and moment of inertia.

Both are linear in them. Of one rigid body, in a frame fixed in it, (4) reads
  wrench = Theta V* + Phi(V) Theta V - (m g, mu x g),
and in the proper acceleration d = v* + omega x v - g of the body's origin the velocity v of that origin drops out: the
columns depend on d, the angular acceleration a and the angular velocity w alone. `tests/derive` proves that the sum of
columns times parameters is the literal (8) and the literal drive torque.
"""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import Phi, Theta, cross, symmetric, vector

BODY = (sp.Symbol("m"), *vector("b"), *vector("J", 6))
"""The ten parameters of a body: mass, first moment b = m rc, and J about its origin: 11, 22, 33, 12, 13, 23."""

UPPER = tuple((i, j) for i in range(6) for j in range(i, 6))
"""Places of the 21 numbers of a symmetric 6x6 matrix, row by row."""

d, a, w = vector("d"), vector("a"), vector("w")


def body_columns() -> sp.Matrix:
    """6x10: wrench (about the body's origin, in its axes) by each of BODY, in d, a, w.

    Raises ValueError if the velocity is left in it.
    """
    v = vector("v")
    V, rate = v.col_join(w), (d - cross(w) * v).col_join(a)
    inertia = Theta(sp.Symbol("m"), vector("b"), symmetric("J"))
    wrench = inertia * rate + Phi(V) * inertia * V
    result = wrench.jacobian(sp.Matrix(BODY)).applyfunc(sp.expand)
    if result.free_symbols & v.free_symbols:
        raise ValueError("the wrench of a body depends on the velocity of its origin")
    return result


def added_mass_columns() -> sp.Matrix:
    """6x21: Lambda V_r* + Phi(V_r) Lambda V_r by each of UPPER, both halves alike. V_r = (v, w), V_r* = (d, a)."""
    V, rate = vector("v").col_join(w), d.col_join(a)
    columns = []
    for i, j in UPPER:
        unit = sp.zeros(6)
        unit[i, j] = unit[j, i] = 1
        columns.append((unit * rate + Phi(V) * unit * V).applyfunc(sp.expand))
    return sp.Matrix.hstack(*columns)
