"""Named symbols for vectors and matrices: element names are `name[i]`, as lowering finds them again."""

from __future__ import annotations

import sympy as sp

from mahovik.core.derive.order import SYMMETRIC


def vector(name: str, size: int = 3) -> sp.Matrix:
    """Column of symbols name[0], name[1], ..."""
    return sp.Matrix([sp.Symbol(f"{name}[{i}]") for i in range(size)])


def matrix(name: str) -> sp.Matrix:
    """3x3 matrix of symbols name[0..8], row by row."""
    return sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"{name}[{3 * i + j}]"))


def symmetric(name: str) -> sp.Matrix:
    """Symmetric 3x3 matrix of symbols name[0..5] in the order 11, 22, 33, 12, 13, 23."""
    return from_six(vector(name, 6))


def from_six(six: sp.Matrix) -> sp.Matrix:
    """Symmetric 3x3 matrix from its six numbers."""
    index = {pair: k for k, pair in enumerate(SYMMETRIC)}
    return sp.Matrix(3, 3, lambda i, j: six[index[min(i, j), max(i, j)]])


def six_of(full: sp.Matrix) -> sp.Matrix:
    """The six numbers of a symmetric 3x3 matrix."""
    return sp.Matrix([full[pair] for pair in SYMMETRIC])
