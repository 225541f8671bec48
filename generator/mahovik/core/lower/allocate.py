"""Control allocation: a demand distributed among weighted, limited flywheels, in a bounded number of passes.

The rows of W are orthogonal with sizes sigma (core/routines/jacobi.py); wanted is W y = r in the first `rank` rows.
With the weights Omega, least y^T Omega y is y = Omega^-1 B^T (B Omega^-1 B^T)^-1 g r, where B = g W has scaled rows.

The first pass asks all flywheels, with rows of unit size, so that small singular values lose no digits; who passes its
limit is held there. Then the active set method for bounded least squares (Stark and Parker 1995, "Bounded-variable
least squares"; Harkegard 2002 for control allocation), from that feasible answer: what is left over is shared among the
free flywheels, by a step as long as all limits allow; the flywheel that stopped it is held, and after a whole step the
held flywheel that would lower the residual most is freed. Here all rows are scaled alike, so what cannot be met is left
with the least residual in the norm of K^-1. It is settled after a whole step that lowers the residual no more and frees
nobody. Then, or after half of all passes, the weights are left out, until it is settled again: flywheels that they
nearly silenced may give.
"""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Not, Place, and_, equal, integer, magnitude, or_, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.jacobi import name_for_rows


def usual_passes(count: int) -> int:
    """Number of passes that are always made: each of N flywheels may be held once. It stops growing at 64."""
    return 4 + max(2, min(count, 64))


def most_passes(count: int) -> int:
    """Largest number of passes: each flywheel may be held and freed again, as in `bounded_least_squares`."""
    return 4 + 6 * count


def solve_gram(lib: Library, rows: int = 6) -> Function:
    """z = gram^-1 z of a symmetric matrix that regularisation keeps positive definite."""
    gram = Argument("gram", Kind.REAL, (rows, rows), "inout", purpose="lower triangle; becomes its Cholesky factor")
    z = Argument("z", Kind.REAL, (rows,), "inout", purpose="right-hand side; becomes the solution")
    least = Argument("least", Kind.REAL, purpose="lower bound of the pivots, except for rounding; greater than 0")
    A, b = gram.place, z.place
    body = Body()
    with body.loop("j", rows) as j:
        with body.loop("k", j) as k:
            body.add(A[j][j], -(A[j][k] * A[j][k]))
        pivot = body.let("pivot", select(A[j][j] > least.place, A[j][j], least.place))
        body.set(A[j][j], lib["sqrt"](pivot))
        with body.loop("i", rows, start=j + 1) as i:
            with body.loop("k", j) as k:
                body.add(A[i][j], -(A[i][k] * A[j][k]))
            body.set(A[i][j], A[i][j] / A[j][j])
        with body.loop("k", j) as k:
            body.add(b[j], -(A[j][k] * b[k]))
        body.set(b[j], b[j] / A[j][j])
    with body.loop("t", rows) as t:
        i_ = body.let("i", integer(rows - 1) - t)
        with body.loop("k", rows, start=i_ + 1) as k:
            body.add(b[i_], -(A[k][i_] * b[k]))
        body.set(b[i_], b[i_] / A[i_][i_])
    return body.function(
        name_for_rows("solve_gram", rows),
        "Solves gram z = z for a symmetric positive definite matrix by its Cholesky factor, in place.",
        (gram, z, least),
    )


def allocate(lib: Library, rows: int = 6) -> Function:
    """phi'' of a demand in orthogonal rows, the first `rows` of the work."""
    layout = lib.layout
    work = Argument("work", layout.inverse_work, purpose="orthogonal rows W, their sizes sigma, demand r, scale")
    options = Argument("options", layout.inverse_options, purpose="weights and limits")
    rank = Argument("rank", Kind.INT, purpose="number of rows used")
    limited = Argument("limited", Kind.INT, (layout.count,), "out", purpose="1 where a flywheel is held at its limit")
    phi_ddot = Argument("phi_ddot", Kind.REAL, (layout.count,), "out", "rad/s2", "flywheel accelerations")
    w, p, y, held = work.place, options.place, phi_ddot.place, limited.place
    count = int(layout.count)
    body = Body()
    share = body.local("share", (layout.count,), comment="1/weight")
    give = body.local("give", (layout.count,), comment="1/weight of a free flywheel, 0 for one held at its limit")
    step = body.local("step", (layout.count,), comment="increment of the free flywheels")
    row = body.local("row", (rows,), comment="factor of each row; 0: the row is left out")
    gram = body.local("gram", (rows, rows))
    z = body.local("z", (rows,))
    going, weighted = body.local("going", (), Kind.INT), body.local("weighted", (), Kind.INT)
    settled = body.local("settled", (), Kind.INT, "1 after a whole step that gains nothing and frees nobody")
    square_before = body.local("square_before", comment="square of the residual after the last whole step")
    body.set(going, integer(1))
    body.set(weighted, integer(1))
    body.set(square_before, real(lib.layout.precision.largest))
    body.note("until the end phi_ddot holds y = D phi''")
    with body.loop("s", layout.count) as s:
        body.set(y[s], real(0))
        body.set(held[s], integer(0))
        body.set(share[s], 1 / p.weight[s])
    with body.loop("pass", most_passes(count)) as turn, body.when(going > 0):
        most = body.local("most")
        body.set(most, real(0))
        with body.loop("s", layout.count) as s:
            body.set(give[s], select(held[s] > 0, real(0), share[s]))
            body.set(most, select(give[s] > most, give[s], most))
        regular = body.let("regular", real(lib.thresholds.regular) * most)
        least = body.let("least", select(most > 0, regular, real(1)), "lower bound that keeps the diagonal positive")
        _rows(body, w, rank.place, turn, row, rows)
        _left_over(lib, body, w, y, row, z, rows)
        _gram(lib, body, w, row, give, gram, least, rows)
        body.call(lib[name_for_rows("solve_gram", rows)], gram, z, least)
        with body.loop("i", rows) as i:
            body.set(z[i], row[i] * z[i])
        with body.loop("s", layout.count) as s:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("i", rows) as i:
                body.add(total, w.W[i][s] * z[i])
            body.set(step[s], give[s] * total)
        body.set(settled, integer(0))
        with body.when(turn < 1):
            _clip(lib, body, w, p, y, held, step)
        with body.otherwise():
            _advance(lib, body, w, p, rank.place, y, held, step, rows, settled, square_before)
        ends = or_(settled > 0, equal(turn, most_passes(count) // 2))
        with body.when(and_(turn >= usual_passes(count) - 2, ends)):
            body.set(going, weighted)
            body.set(weighted, integer(0))
            with body.loop("s", layout.count) as s:
                body.set(share[s], real(1))
    body.note("the product may round an answer that just reaches its limit beyond it; what overflows is refused later")
    largest = lib.limits["LARGEST"].expression
    with body.loop("s", layout.count) as s:
        found = body.let("found", y[s] * w.scale[s])
        body.set(y[s], found)
        beyond = and_(magnitude(found) > p.limit[s], magnitude(found) <= largest)
        with body.when(or_(held[s] > 0, beyond)):
            body.set(y[s], select(found < 0, -p.limit[s], p.limit[s]))
    return body.function(
        name_for_rows("allocate", rows),
        "Distributes a demand among the flywheels: least weighted norm; what one at its limit lacks, the others share.",
        (work, options, rank, phi_ddot, limited),
        equation="(12)",
    )


def _clip(lib: Library, body: Body, w: Place, p: Place, y: Place, held: Place, step: Place) -> None:
    """The first answer, with flywheels beyond their limit held at it."""
    with body.loop("s", lib.layout.count) as s:
        body.set(y[s], step[s])
        with body.when(magnitude(step[s]) * w.scale[s] > p.limit[s]):
            bound = body.let("bound", p.limit[s] / w.scale[s])
            body.set(y[s], select(step[s] < 0, -bound, bound))
            body.set(held[s], integer(1))


def _advance(
    lib: Library, body: Body, w: Place, p: Place, rank: Place, y: Place, held: Place, step: Place, rows: int,
    settled: Place, square_before: Place
) -> None:  # fmt: skip
    """A step of the active set method."""
    body.note("go as far as all limits allow; hold the flywheel that reaches its limit")
    length = body.local("length")
    body.set(length, real(1))
    stopped = body.local("stopped", (), Kind.INT)
    body.set(stopped, integer(-1))
    with body.loop("s", lib.layout.count) as s:
        moved = body.let("moved", (y[s] + step[s]) * w.scale[s])
        beyond = and_(equal(held[s], 0), magnitude(moved) > p.limit[s])
        # at its limit a flywheel that does not move may still be beyond it by the rounding of the product
        with body.when(and_(beyond, magnitude(step[s]) > 0)):
            room = body.let("room", p.limit[s] / w.scale[s] - select(moved < 0, -y[s], y[s]))
            part = body.let("part", room / magnitude(step[s]))
            with body.when(part < length):
                body.set(length, select(part > 0, part, real(0)))
                body.set(stopped, s)
    with body.loop("s", lib.layout.count) as s:
        body.add(y[s], length * step[s])
        with body.when(equal(stopped, s)):
            bound = body.let("bound", p.limit[s] / w.scale[s])
            body.set(y[s], select(step[s] < 0, -bound, bound))
            body.set(held[s], integer(1))
    body.note("after a full step, release the held flywheel that would lower the residual most")
    with body.when(stopped < 0):
        left = body.local("left", (rows,))
        wanted = body.local("wanted")
        square = body.local("square", comment="of the residual")
        body.set(wanted, real(0))
        body.set(square, real(0))
        with body.loop("i", rows) as i:
            body.add(wanted, w.r[i] * w.r[i])
            body.set(left[i], select(i < rank, w.r[i], real(0)))
            with body.when(i < rank), body.loop("s", lib.layout.count) as s:
                body.add(left[i], -(w.W[i][s] * y[s]))
            body.add(square, left[i] * left[i])
        best = body.local("best")
        tolerance = lib.thresholds.unreachable
        body.set(best, real(tolerance * tolerance) * wanted, "smaller gains are ignored")
        freed = body.local("freed", (), Kind.INT)
        body.set(freed, integer(-1))
        with body.loop("s", lib.layout.count) as s, body.when(held[s] > 0):
            slope = body.local("slope")
            body.set(slope, real(0))
            size = body.local("size")
            body.set(size, real(0))
            with body.loop("i", rows) as i:
                body.add(slope, w.W[i][s] * left[i])
                body.add(size, w.W[i][s] * w.W[i][s])
            inward = body.let("inward", select(y[s] > 0, -slope, slope))
            with body.when(and_(inward > 0, inward * inward > best * size)):
                body.set(best, inward * inward / size)
                body.set(freed, s)
        with body.when(freed >= 0):
            body.set(held[freed], integer(0))
        with body.otherwise(), body.when(Not(and_(square > best, square < square_before * real(1 - tolerance)))):
            body.set(settled, integer(1))
        body.set(square_before, square)


def _rows(body: Body, w: Place, rank: Place, turn: Place, row: Place, rows: int) -> None:
    """Factors of the rows in a pass."""
    with body.loop("i", rows) as i:
        body.set(row[i], real(0))
        with body.when(i < rank):
            body.set(row[i], 1 / select(turn < 1, w.sigma[i], w.sigma[0]))


def _left_over(lib: Library, body: Body, w: Place, y: Place, row: Place, z: Place, rows: int) -> None:
    """Compute the demand that the flywheels do not meet yet."""
    with body.loop("i", rows) as i:
        left = body.local("left")
        body.set(left, w.r[i])
        with body.loop("s", lib.layout.count) as s:
            body.add(left, -(w.W[i][s] * y[s]))
        body.set(z[i], row[i] * left)


def _gram(lib: Library, body: Body, w: Place, row: Place, give: Place, gram: Place, least: Place, rows: int) -> None:
    """B Omega^-1 B^T of the free flywheels, lower triangle."""
    weighed = body.local("weighed", (lib.layout.count,), comment="a row of W Omega^-1")
    with body.loop("i", rows) as i:
        with body.loop("s", lib.layout.count) as s:
            body.set(weighed[s], w.W[i][s] * give[s])
        with body.loop("j", i + 1) as j:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("s", lib.layout.count) as s:
                body.add(total, weighed[s] * w.W[j][s])
            body.set(gram[i][j], row[i] * row[j] * total)
        body.add(gram[i][i], least)
