"""A stop of a freedom as expressions."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from mahovik.core.derive.screw import cross
from mahovik.core.derive.symbols import matrix, vector


@dataclass(frozen=True)
class Stop:
    """Speed of the freedom, depth beyond the stop, and the push per depth."""

    speed: sp.Expr
    depth: sp.Expr
    push: sp.Expr


def stop() -> Stop:
    """speed = W . V; depth = side (coordinate - at); push = stiffness + damping side speed; side is 1 or -1."""
    stiffness, damping, side, coordinate, at, speed = sp.symbols("stiffness damping side coordinate at speed")
    return Stop(
        speed=vector("direction", 6).dot(vector("V", 6)),
        depth=side * (coordinate - at),
        push=stiffness + damping * (side * speed),
    )


def relative() -> sp.Matrix:
    """R = C0^T C, row by row."""
    return matrix("C0").T * matrix("C")


def sine_and_cosine() -> sp.Matrix:
    """(2 sine, 2 cosine), times a common factor, of the angle by which R turns about the axis a of length 1.

    They are tr(<a>^T R) and tr R - a^T R a.
    """
    a, R = vector("axis"), matrix("R")
    return sp.Matrix([(cross(a).T * R).trace(), R.trace() - (a.T * R * a)[0]])


def way() -> sp.Expr:
    """direction . (C pivot + O1 - home): way of the pivot from `home`, along a direction, all in E0."""
    return vector("axis").dot(matrix("C") * vector("pivot") + vector("O1") - vector("home"))
