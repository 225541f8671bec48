"""Least squares within bounds: the least error of W y = r first, then the least weighted norm of y.

A primal active set method for the strictly convex problem |W y - r|^2 / lambda + y^T Omega y (Nocedal and Wright 2006,
Numerical Optimization, algorithm 16.3; Harkegard 2002 for control allocation), with lambda so small that the first term
decides. With z = (r - W y)/lambda the solution of the free unknowns is y = Omega^-1 W^T z, where
(W Omega^-1 W^T + lambda) z = r - W y_held: a system of as many unknowns as W has rows. Fewer free unknowns than rows
are solved from (W^T W + lambda Omega) y = W^T (r - W y_held) instead, since z is large where the demand is out of their
reach. Two steps of refinement remove what lambda leaves of the error. Each pass moves to this solution as far as all
bounds allow; the unknown that stops it is held at its bound. After a whole step the held unknown with the most wrong
multiplier is released.
"""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Not, Place, and_, equal, integer, magnitude, or_, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, NamedCount

ROUNDS = 3
"""Solutions of a pass, two of them for what the one before has left."""


def passes(count: int) -> int:
    """Number of passes: each unknown may be held and released again. Tests against SciPy need at most half."""
    return 4 + 6 * count


def bounded_least_squares(rows: int, count: NamedCount, square_root: Function, regular: float) -> Function:
    """`bounded_least_squares` for a matrix of `rows` x `count`; `regular`: lambda, relative to the largest row."""
    W = Argument("W", Kind.REAL, (rows * int(count),), purpose="rows of the equations, one after the other")
    r = Argument("r", Kind.REAL, (rows,), purpose="wanted W y")
    low = Argument("low", Kind.REAL, (count,), purpose="lower bounds of y")
    high = Argument("high", Kind.REAL, (count,), purpose="upper bounds; not below the lower ones")
    weight = Argument("weight", Kind.REAL, (count,), purpose="Omega, greater than 0")
    y = Argument("y", Kind.REAL, (count,), "out", purpose="the solution")
    held = Argument("held", Kind.INT, (count,), "out", purpose="-1 at its lower bound, 1 at its upper one, 0 between")
    body = Body()
    _begin(body, low.place, high.place, y.place, held.place)
    scratch = _Scratch(
        gram=body.local("gram", (rows, rows), comment="of rows, or of fewer free unknowns; then its factor"),
        z=body.local("z", (rows,), comment="(r - W y)/lambda"),
        left=body.local("left", (rows,), comment="right-hand side, and what solves it"),
        free=body.local("free", (rows,), Kind.INT, "free unknowns where these are fewer than rows"),
        many=body.local("many", (), Kind.INT, "number of free unknowns"),
        goal=body.local("goal", (count,), comment="solution of the free unknowns"),
    )
    ridge = _ridge(body, W.place, weight.place, rows, regular)
    going = body.local("going", (), Kind.INT)
    body.set(going, integer(1))
    with body.loop("pass", passes(int(count))), body.when(going > 0):
        _gram(body, W.place, weight.place, held.place, scratch, ridge)
        size = body.let("unknowns", select(scratch.many < rows, scratch.many, integer(rows)))
        _factor(body, scratch.gram, size, ridge, square_root)
        _goal(body, (W.place, r.place, weight.place), (y.place, held.place), scratch, size, ridge)
        stopped = _advance(body, low.place, high.place, y.place, held.place, scratch.goal)
        with body.when(stopped < 0):
            freed = _unknown_to_release(body, W.place, weight.place, y.place, held.place, scratch.z)
            with body.when(freed < 0):
                body.set(going, integer(0))
            with body.otherwise():
                body.set(held.place[freed], integer(0))
    return body.function(
        f"bounded_least_squares_{rows}",
        "Least error of W y = r within bounds, then least weighted norm of y.",
        (W, r, low, high, weight, y, held),
    )


def _begin(body: Body, low: Place, high: Place, y: Place, held: Place) -> None:
    """Begin at the place within the bounds that is nearest to zero; unknowns without room are held."""
    with body.loop("s", len(y)) as s:
        body.set(y[s], select(low[s] > 0, low[s], select(high[s] < 0, high[s], real(0))))
        body.set(held[s], select(Not(low[s] < high[s]), integer(1), integer(0)))


@dataclass(frozen=True, eq=False)
class _Scratch:
    """Local arrays of the solution for the free unknowns."""

    gram: Place
    z: Place
    left: Place
    free: Place
    many: Place
    goal: Place


def _ridge(body: Body, W: Place, weight: Place, rows: int, regular: float) -> Place:
    """lambda: a small part of the largest diagonal element of W Omega^-1 W^T."""
    count = len(weight)
    largest = body.local("largest", comment="diagonal element of W Omega^-1 W^T")
    body.set(largest, real(0))
    with body.loop("i", rows) as i:
        whole = body.local("whole")
        body.set(whole, real(0))
        with body.loop("s", count) as s:
            body.add(whole, W[i * count + s] * W[i * count + s] / weight[s])
        body.set(largest, select(whole > largest, whole, largest))
    return body.let("lambda", select(largest > 0, real(regular) * largest, real(1)))


def _gram(body: Body, W: Place, weight: Place, held: Place, scratch: _Scratch, ridge: Place) -> None:
    """W Omega^-1 W^T + lambda over the free unknowns; where these are fewer than rows, W^T W + lambda Omega of them."""
    gram, free, many = scratch.gram, scratch.free, scratch.many
    rows, count = len(gram), len(weight)
    with body.loop("i", rows) as i, body.loop("j", i + 1) as j:
        body.set(gram[i][j], real(0))
    body.set(many, integer(0))
    with body.loop("s", count) as s, body.when(equal(held[s], integer(0))):
        with body.when(many < rows):
            body.set(free[many], s)
        body.set(many, many + 1)
    total = body.local("total")
    with body.when(many < rows), body.loop("k", many) as k, body.loop("l", k + 1) as l:
        body.set(total, select(equal(k, l), ridge * weight[free[k]], real(0)))
        with body.loop("i", rows) as i:
            body.add(total, W[i * count + free[k]] * W[i * count + free[l]])
        body.set(gram[k][l], total)
    with body.otherwise(), body.loop("i", rows) as i, body.loop("j", i + 1) as j:
        body.set(total, select(equal(i, j), ridge, real(0)))
        with body.loop("s", count) as s, body.when(equal(held[s], integer(0))):
            body.add(total, W[i * count + s] * W[j * count + s] / weight[s])
        body.set(gram[i][j], total)


def _factor(body: Body, gram: Place, size: Place, ridge: Place, square_root: Function) -> None:
    """Cholesky factor in the lower triangle."""
    with body.loop("j", size) as j:
        least = body.let(
            "least", real(2.0**-52) * gram[j][j] + real(2.0**-20) * ridge, "rounding, of a singular matrix"
        )
        with body.loop("k", j) as k:
            body.add(gram[j][j], -(gram[j][k] * gram[j][k]))
        body.set(gram[j][j], square_root(select(gram[j][j] > least, gram[j][j], least)))
        with body.loop("i", size, start=j + 1) as i:
            with body.loop("k", j) as k:
                body.add(gram[i][j], -(gram[i][k] * gram[j][k]))
            body.set(gram[i][j], gram[i][j] / gram[j][j])


def _solve(body: Body, gram: Place, b: Place, size: Place) -> None:
    """b = gram^-1 b by the factor."""
    with body.loop("i", size) as i:
        with body.loop("k", i) as k:
            body.add(b[i], -(gram[i][k] * b[k]))
        body.set(b[i], b[i] / gram[i][i])
    with body.loop("t", size) as t:
        i_ = body.let("i", size - 1 - t)
        with body.loop("k", size, start=i_ + 1) as k:
            body.add(b[i_], -(gram[k][i_] * b[k]))
        body.set(b[i_], b[i_] / gram[i_][i_])


def _goal(
    body: Body,
    given: tuple[Place, Place, Place],
    state: tuple[Place, Place],
    scratch: _Scratch,
    size: Place,
    ridge: Place,
) -> None:
    """The solution of the free unknowns, refined, and the multipliers z."""
    W, r, weight = given
    y, held = state
    gram, z, left, free, many, goal = vars(scratch).values()
    rows, count = len(r), len(y)
    body.note("held unknowns keep their values; the free ones start from 0")
    with body.loop("s", count) as s:
        body.set(goal[s], select(equal(held[s], integer(0)), real(0), y[s]))
    with body.loop("i", rows) as i:
        body.set(z[i], real(0))
    missing = body.local("missing", (rows,), comment="r - W goal")
    with body.loop("round", ROUNDS + 1) as turn:
        with body.loop("i", rows) as i:
            body.set(missing[i], r[i])
            with body.loop("s", count) as s:
                body.add(missing[i], -(W[i * count + s] * goal[s]))
        with body.when(and_(many >= rows, turn < ROUNDS)):
            with body.loop("i", rows) as i:
                body.set(left[i], missing[i])
            _solve(body, gram, left, size)
            with body.loop("i", rows) as i:
                body.add(z[i], left[i])
            with body.loop("s", count) as s, body.when(equal(held[s], integer(0))), body.loop("i", rows) as i:
                body.add(goal[s], W[i * count + s] * left[i] / weight[s])
        with body.when(many < rows):
            body.note("what the last round leaves of the demand gives the multipliers")
            with body.loop("i", rows) as i:
                body.set(z[i], missing[i] / ridge)
            with body.when(turn < ROUNDS):
                with body.loop("k", many) as k:
                    body.set(left[k], real(0))
                    with body.loop("i", rows) as i:
                        body.add(left[k], W[i * count + free[k]] * missing[i])
                _solve(body, gram, left, size)
                with body.loop("k", many) as k:
                    body.add(goal[free[k]], left[k])


def _advance(body: Body, low: Place, high: Place, y: Place, held: Place, goal: Place) -> Place:
    """Go towards the goal as far as all bounds allow; the unknown that stopped it, or -1."""
    length = body.local("length")
    stopped = body.local("stopped", (), Kind.INT)
    body.set(length, real(1))
    body.set(stopped, integer(-1))
    with body.loop("s", len(y)) as s, body.when(equal(held[s], integer(0))):
        beyond = or_(goal[s] > high[s], goal[s] < low[s])
        with body.when(beyond):
            room = body.let("room", select(goal[s] > high[s], high[s] - y[s], low[s] - y[s]))
            part = body.let("part", room / (goal[s] - y[s]))
            with body.when(part < length):
                body.set(length, select(part > 0, part, real(0)))
                body.set(stopped, s)
    with body.loop("s", len(y)) as s, body.when(equal(held[s], integer(0))):
        moved = body.let("moved", select(length < 1, y[s] + length * (goal[s] - y[s]), goal[s]))
        body.set(y[s], select(moved > high[s], high[s], select(moved < low[s], low[s], moved)))
    with body.when(stopped >= 0):
        up = body.let("up", goal[stopped] > high[stopped])
        body.set(y[stopped], select(up, high[stopped], low[stopped]))
        body.set(held[stopped], select(up, integer(1), integer(-1)))
    return stopped


def _unknown_to_release(body: Body, W: Place, weight: Place, y: Place, held: Place, z: Place) -> Place:
    """The held unknown that the objective would move inward most, beyond rounding, or -1."""
    freed = body.local("freed", (), Kind.INT)
    best = body.local("best")
    body.set(freed, integer(-1))
    body.set(best, real(0))
    with body.loop("s", len(y)) as s, body.when(Not(equal(held[s], integer(0)))):
        pull = body.local("pull", comment="W^T z - Omega y: where the objective falls")
        size = body.local("size", comment="sum of its terms, for rounding")
        body.set(pull, -(weight[s] * y[s]))
        body.set(size, magnitude(weight[s] * y[s]))
        with body.loop("i", len(z)) as i:
            term = body.let("term", W[i * len(y) + s] * z[i])
            body.add(pull, term)
            body.add(size, magnitude(term))
        inward = body.let("inward", select(held[s] > 0, -pull, pull))
        with body.when(and_(inward > real(2.0**-20) * size, inward * inward > best * weight[s])):
            body.set(best, inward * inward / weight[s])
            body.set(freed, s)
    return freed
