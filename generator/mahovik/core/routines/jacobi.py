"""Singular values of a matrix of six rows by one-sided Jacobi rotations: a fixed number of sweeps, nothing squared.

Rows of W (6 x N) are rotated in pairs until they are orthogonal: U^T W has rows sigma_i v_i^T. The rotations are
applied to U (6 x 6, from the unit matrix) and to a right-hand side r as well, so that r becomes U^T r. Small singular
values keep their relative accuracy, which the eigenvalues of W W^T would lose (Demmel and Veselic 1992). Cyclic
sweeps converge quadratically: of thousands of matrices, graded and of nearly equal singular values, two rows need two
in double, three four, four five, five seven.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.program.function import Function
from mahovik.core.program.kernel import argument, kernel
from mahovik.core.program.types import NamedCount, Struct

MORE_SWEEPS = {"double": 3, "float": 1}
"""Sweeps over the pairs of rows, 15 of six rows, beside one for each row."""


def name_for_rows(name: str, rows: int) -> str:
    """Name of a function for a number of rows: without one for six."""
    return name if rows == 6 else f"{name}_{rows}"


def orthogonalise(struct: Struct, count: NamedCount, sqrt: Function, precision_name: str, rows: int = 6) -> Function:
    """`orthogonalise`: works in place on a struct with members W[6][N], U[6][6], r[6], sigma[6].

    With fewer than six rows it is `orthogonalise_ROWS`, which works on the first of them.
    """
    sweeps = rows + MORE_SWEEPS[precision_name]

    @kernel(name_for_rows("orthogonalise", rows))
    def orthogonalise(
        work: Any = argument(
            "in: W, r; out: rows of W orthogonal, r = U^T r, U, sigma = |rows|", struct=struct, direction="inout"
        ),
    ) -> None:
        """Makes the rows of W orthogonal by one-sided Jacobi rotations: the condition is not squared."""
        W, U, r = work.W, work.U, work.r
        for i in range(rows):
            for j in range(rows):
                U[i][j] = 0
            U[i][i] = 1
        for sweep in range(sweeps):  # enough: they converge quadratically
            for p in range(rows - 1):
                for q in range(p + 1, rows):
                    a: float = 0
                    b: float = 0
                    g: float = 0
                    for j in range(count):
                        a += W[p][j] * W[p][j]
                        b += W[q][j] * W[q][j]
                        g += W[p][j] * W[q][j]
                    # tangent of the smaller angle that makes the rows orthogonal
                    size = abs(b - a) + 2 * abs(g)
                    unit = size if size > 0 else 1.0  # scaled to size 1, so that no square underflows
                    d = (b - a) / unit
                    h = 2 * g / unit
                    root = sqrt(d * d + h * h)
                    below = d - root if d < 0 else d + root
                    t = h / (below if abs(below) > 0 else 1.0) if abs(below) > 0 else 0.0
                    c = 1 / sqrt(1 + t * t)
                    s = c * t
                    for j in range(count):
                        x = W[p][j]
                        y = W[q][j]
                        W[p][j] = c * x - s * y
                        W[q][j] = s * x + c * y
                    for j in range(rows):
                        x = U[j][p]
                        y = U[j][q]
                        U[j][p] = c * x - s * y
                        U[j][q] = s * x + c * y
                    x = r[p]
                    y = r[q]
                    r[p] = c * x - s * y
                    r[q] = s * x + c * y
        for i in range(rows):
            total: float = 0.0
            for j in range(count):
                total += W[i][j] * W[i][j]
            work.sigma[i] = sqrt(total)

    return orthogonalise
