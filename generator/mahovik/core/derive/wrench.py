"""Wrenches of (7) as expressions: weight and buoyancy, transfer of twists and wrenches, suspension, legs."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from mahovik.core.derive.attitude import quaternion_product
from mahovik.core.derive.screw import cross
from mahovik.core.derive.symbols import matrix, vector


def weight(buoyancy: bool) -> sp.Matrix:
    """Weight of every body and Archimedes force: (m g, mu x g) less the displaced mass and its first moment.

    g = gravity in E1; mu at the phases of the flywheels: the line of action of a flywheel's weight moves with it.
    """
    g, m, moment = vector("g"), sp.Symbol("m"), vector("mu")
    if buoyancy:
        m = sp.Symbol("weight_mass")
        moment = moment - vector("displaced_moment")
    return (m * g).col_join(cross(moment) * g)


def weight_reaction(buoyancy: bool) -> sp.Matrix:
    """What a mount bears of weight and Archimedes force: the negative of `weight`."""
    return -weight(buoyancy)


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


def relative_quaternion() -> sp.Matrix:
    """Quaternion of C_eq^T C: the conjugate of q_eq times q."""
    q_eq = vector("q_eq", 4)
    return quaternion_product(sp.Matrix([q_eq[0], -q_eq[1], -q_eq[2], -q_eq[3]]), vector("q", 4))


def row_times(row: str, column: str, size: int = 6) -> sp.Expr:
    """One row of a matrix times a vector: sum of row[j] column[j]."""
    return vector(row, size).dot(vector(column, size))


def suspension_row() -> sp.Expr:
    """One row of stiffness x + damping V."""
    return row_times("stiffness", "x") + row_times("damping", "V")


@dataclass(frozen=True)
class Leg:
    """A spring-damper leg in E1: rate of its length, and force along it."""

    rate: sp.Expr
    tension: sp.Expr


def leg() -> Leg:
    """rate = -direction . velocity of the carrier's end, direction towards the ground; tension of spring and damper."""
    k, d, length, unstretched, rate = sp.symbols("stiffness damping distance length rate")
    return Leg(
        rate=-vector("direction").dot(vector("velocity")),
        tension=k * (length - unstretched) + d * rate,
    )
