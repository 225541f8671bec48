"""Matrices of damping, which the equations are linear in."""

from __future__ import annotations

from mahovik.core.stand.model import Body, Mat6
from mahovik.laws.damping.data import Damping


def matrices(body: Body) -> dict[str, Mat6]:
    """The matrices that a body has, by the end of the name of their columns: linear, quadratic."""
    damping = body.law(Damping)
    if damping is None:
        return {}
    found = {"linear": damping.linear, "quadratic": damping.quadratic}
    return {name: matrix for name, matrix in found.items() if matrix is not None}
