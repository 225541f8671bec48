"""Wrenches of (7) as expressions: transfer of twists and wrenches."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.screw import cross
from mahovik.core.derive.symbols import matrix, vector


def twist_at() -> sp.Matrix:
    """v + omega x O: velocity of the point O of E1, in its axes."""
    return vector("v") + turning_velocity()


def rotated_back() -> sp.Matrix:
    """C^T a."""
    return matrix("C").T * vector("a")


def rotated() -> sp.Matrix:
    """C a."""
    return matrix("C") * vector("a")


def moment_of_force() -> sp.Matrix:
    """O x f: moment about O1 of a force at O, in axes of E1; T of the paper."""
    return cross(vector("O")) * vector("f")


def moved_moment() -> sp.Matrix:
    """O x f + n: moment about O1 of a wrench (f, n) at O."""
    return moment_of_force() + vector("n")


def turning_velocity() -> sp.Matrix:
    """omega x O."""
    return cross(vector("omega")) * vector("O")


def turned_axes() -> sp.Matrix:
    """R C1(phi), 9 numbers, with c, s of the phase: axes of a flywheel in E1."""
    c, s = sp.symbols("c s")
    C1 = sp.Matrix([[1, 0, 0], [0, c, -s], [0, s, c]])
    return matrix("R") * C1


def row_times() -> sp.Expr:
    """One row of a matrix times a vector of six numbers: sum of row[j] column[j]."""
    return vector("row", 6).dot(vector("column", 6))
