"""L D L^T of a symmetric positive definite matrix, in place and without a square root, and solutions by it.

The lower triangle is given. L D is then on and below the diagonal, L^T above it. Pivots divide: where they are tiny
their inverses overflow, their quotients do not. The factors are backward stable (Higham 2002, chapter 10).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from mahovik.core.program.kernel import NOT_POSITIVE_DEFINITE, Reals, inline


@inline
def factor(gram: Reals, size: int, least_of: Callable[[Any], Any], refuses: bool = False, z: Any = None) -> Any:
    """The factors of gram, and with z L^-1 z.

    A pivot that is not above `least_of` its diagonal element is rounding: the function that asks returns
    NOT_POSITIVE_DEFINITE where it `refuses`, else the pivot is that least one.
    """
    for j in range(size):
        pivot: float = gram[j][j]
        least = least_of(pivot)  # a pivot below this is rounding error
        if z is not None:
            rest: float = z[j]
        for k in range(j):
            pivot -= gram[j][k] * gram[k][j]
            if z is not None:
                rest -= gram[k][j] * z[k]
        if z is not None:
            z[j] = rest
        if refuses:
            if not pivot > least:
                return NOT_POSITIVE_DEFINITE
        else:
            pivot = pivot if pivot > least else least
        gram[j][j] = pivot
        for i in range(j + 1, size):
            below: float = gram[i][j]
            for k in range(j):
                below -= gram[i][k] * gram[k][j]
            gram[i][j] = below
            gram[j][i] = below / pivot
    return None


@inline
def substitute_back(gram: Reals, z: Reals, size: int) -> None:
    """L^-T D^-1 z, in place."""
    for t in range(size):
        i = size - 1 - t
        rest: float = z[i] / gram[i][i]
        for k in range(i + 1, size):
            rest -= gram[i][k] * z[k]
        z[i] = rest


@inline
def solve(gram: Reals, z: Reals, size: int) -> None:
    """z = gram^-1 z by the factors."""
    for i in range(size):
        for k in range(i):
            z[i] -= gram[k][i] * z[k]
    substitute_back(gram, z, size)
