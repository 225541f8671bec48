"""Balls: exact numbers from binary ones, small matrices, lengths. A vector is a matrix of one column."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from flint import arb, arb_mat

Rows = Sequence[Sequence[float | arb]]


def number(x: float) -> arb:
    """A binary number as it is, without rounding, whatever the working precision."""
    return arb(float(x))


def matrix(rows: Rows) -> arb_mat:
    """A matrix of numbers taken as they are, and of balls."""
    return arb_mat([[x if isinstance(x, arb) else number(x) for x in row] for row in rows])


def column(numbers: Iterable[float | arb]) -> arb_mat:
    """A vector (n x 1)."""
    return matrix([[x] for x in numbers])


def elements(a: arb_mat) -> list[arb]:
    """The elements of a vector, or of a matrix row by row."""
    return list(a.entries())


def zeros(rows: int, columns: int = 1) -> arb_mat:
    """Exact zeros."""
    return arb_mat(rows, columns)


def identity(n: int) -> arb_mat:
    """E (n x n)."""
    return arb_mat(n, n, [int(i == j) for i in range(n) for j in range(n)])


def block(rows: Sequence[Sequence[arb_mat]]) -> arb_mat:
    """A matrix of blocks."""
    found: list[list[arb]] = []
    for row in rows:
        for i in range(row[0].nrows()):
            found.append([part[i, j] for part in row for j in range(part.ncols())])
    return arb_mat(found)


def part(a: arb_mat, rows: slice, columns: slice | None = None) -> arb_mat:
    """Some rows and columns of a matrix."""
    given = slice(None) if columns is None else columns
    return arb_mat([row[given] for row in a.tolist()[rows]])


def dot(a: arb_mat, b: arb_mat) -> arb:
    """a . b of two vectors."""
    return (a.transpose() * b)[0, 0]


def length(a: arb_mat) -> arb:
    """Euclidean length of a vector. A power of a ball that holds zero is none: hence products."""
    return sum((x * x for x in elements(a)), arb(0)).nonnegative_part().sqrt()


def cross(a: arb_mat) -> arb_mat:
    """<a> (3x3) of a (3): <a> b = a x b."""
    x, y, z = elements(a)
    return matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
