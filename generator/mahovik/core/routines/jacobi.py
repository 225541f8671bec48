"""Singular values of a matrix of six rows by one-sided Jacobi rotations: a fixed number of sweeps, nothing squared.

Rows of W (6 x N) are rotated in pairs until they are orthogonal: U^T W has rows sigma_i v_i^T. The rotations are
applied to U (6 x 6, from the unit matrix) and to a right-hand side r as well, so that r becomes U^T r. Small singular
values keep their relative accuracy, which the eigenvalues of W W^T would lose (Demmel and Veselic 1992). Cyclic
sweeps converge quadratically; for six rows SWEEPS is more than any matrix of the tests needs.
"""

from __future__ import annotations

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import magnitude, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import NamedCount, Struct

SWEEPS = {"double": 9, "float": 7}
"""Sweeps over the pairs of rows, 15 of six rows."""


def name_for_rows(name: str, rows: int) -> str:
    """Name of a function for a number of rows: without one for six."""
    return name if rows == 6 else f"{name}_{rows}"


def orthogonalise(
    struct: Struct, count: NamedCount, square_root: Function, precision_name: str, rows: int = 6
) -> Function:
    """`orthogonalise`: works in place on a struct with members W[6][N], U[6][6], r[6], sigma[6].

    With fewer than six rows it is `orthogonalise_ROWS`, which works on the first of them.
    """
    work = Argument(
        "work", struct, (), "inout", purpose="in: W, r; out: rows of W orthogonal, r = U^T r, U, sigma = |rows|"
    )
    w = work.place
    body = Body()
    with body.loop("i", rows) as i:
        with body.loop("j", rows) as j:
            body.set(w.U[i][j], real(0))
        body.set(w.U[i][i], real(1))
    with (
        body.loop("sweep", SWEEPS[precision_name]),
        body.loop("p", rows - 1) as p,
        body.loop("q", rows, start=p + 1) as q,
    ):
        a = body.local("a")
        b = body.local("b")
        g = body.local("g")
        for place in (a, b, g):
            body.set(place, real(0))
        with body.loop("j", count) as j:
            body.add(a, w.W[p][j] * w.W[p][j])
            body.add(b, w.W[q][j] * w.W[q][j])
            body.add(g, w.W[p][j] * w.W[q][j])
        body.note("tangent of the smaller angle that makes the rows orthogonal")
        size = body.let("size", magnitude(b - a) + 2 * magnitude(g))
        unit = body.let("unit", select(size > 0, size, real(1)), "scaled to size 1, so that no square underflows")
        d = body.let("d", (b - a) / unit)
        h = body.let("h", 2 * g / unit)
        root = body.let("root", square_root(d * d + h * h))
        below = body.let("below", select(d < 0, d - root, d + root))
        t = body.let("t", select(magnitude(below) > 0, h / select(magnitude(below) > 0, below, real(1)), real(0)))
        c = body.let("c", 1 / square_root(1 + t * t))
        s = body.let("s", c * t)
        with body.loop("j", count) as j:
            x = body.let("x", w.W[p][j])
            y = body.let("y", w.W[q][j])
            body.set(w.W[p][j], c * x - s * y)
            body.set(w.W[q][j], s * x + c * y)
        with body.loop("j", rows) as j:
            x = body.let("x", w.U[j][p])
            y = body.let("y", w.U[j][q])
            body.set(w.U[j][p], c * x - s * y)
            body.set(w.U[j][q], s * x + c * y)
        x = body.let("x", w.r[p])
        y = body.let("y", w.r[q])
        body.set(w.r[p], c * x - s * y)
        body.set(w.r[q], s * x + c * y)
    with body.loop("i", rows) as i:
        total = body.local("total")
        body.set(total, real(0))
        with body.loop("j", count) as j:
            body.add(total, w.W[i][j] * w.W[i][j])
        body.set(w.sigma[i], square_root(total))
    return body.function(
        name_for_rows("orthogonalise", rows),
        "One-sided Jacobi rotations make the rows of W orthogonal: singular values without squaring the condition.",
        (work,),
    )
