"""Wrenches of (7) as expressions: transfer of twists and wrenches; weight, less that of the displaced fluid."""

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


def weight(displaces: bool) -> sp.Matrix:
    """Weight of every body and Archimedes force: (m g, mu x g) minus those of the displaced fluid.

    g = gravity in E1; mu at the phases of the flywheels: the line of action of a flywheel's weight moves with it.
    """
    g, m, moment = vector("g"), sp.Symbol("m"), vector("mu")
    if displaces:
        m = sp.Symbol("weight_mass")
        moment = moment - vector("displaced_moment")
    return (m * g).col_join(cross(moment) * g)


def weight_reaction(displaces: bool) -> sp.Matrix:
    """Load of weight and Archimedes force on the mount: the negative of `weight`."""
    return -weight(displaces)
