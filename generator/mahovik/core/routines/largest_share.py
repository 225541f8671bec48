"""The largest share of a demand that bounded unknowns can meet without turning it: a small linear programme.

Wanted is the largest f in [0, 1] for which W y = start + f towards has a solution with low <= y <= high. Primal simplex
method for bounded variables on a dense tableau (Dantzig 1963, chapter 18): first the artificial variables of the rows
are driven to zero, then f is raised. The variable with the largest gain enters; after PASSES_BEFORE_BLAND passes per
variable the first one with a gain does (Bland 1977), so that it cannot circle. Rows may depend on one another: an
artificial variable that stays is held at zero. At the end the answer is put into the equations, so that rounding never
passes for a solution.
"""

from __future__ import annotations

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Convert,
    Expr,
    Not,
    Place,
    and_,
    equal,
    integer,
    magnitude,
    or_,
    real,
    select,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, NamedCount

OUT_OF_REACH = -1
"""Result where not even f = 0 has a solution."""

PASSES_BEFORE_BLAND = 3
PASSES = 6
"""Per row and variable; tests count at most two."""


def largest_share(rows: int, count: NamedCount, pivot: float, tolerance: float) -> Function:
    """`largest_share` for a matrix of `rows` x `count`.

    pivot      a coefficient below this, in scaled rows and columns (`_set_up`), counts as zero
    tolerance  how far the rows may be from zero at f = 0, in the same rows, before `start` counts as out of reach; the
               answer may be as far again from its equations, by rounding
    """
    W = Argument("W", Kind.REAL, (rows * int(count),), purpose="rows of the equations, one after the other")
    low = Argument("low", Kind.REAL, (count,), purpose="lower bounds of y")
    high = Argument("high", Kind.REAL, (count,), purpose="upper bounds; not below the lower ones")
    start = Argument("start", Kind.REAL, (rows,), purpose="W y wanted at f = 0")
    towards = Argument("towards", Kind.REAL, (rows,), purpose="what f = 1 adds to it")
    y = Argument("y", Kind.REAL, (count,), "inout", purpose="the solution; untouched where the result is -1")
    n = int(count)  # variable n is f
    body = Body()
    tableau = body.local(
        "tableau", (rows, n + 2), comment="columns: (y - low) / (high - low), then f, then the values of the basis"
    )
    upper = body.local("upper", (n + 1,), comment="upper bounds of the variables; the lower ones are 0")
    at_upper = body.local("at_upper", (n + 1,), Kind.INT, "1 where a variable outside the basis is at its upper bound")
    inside = body.local("inside", (n + 1,), Kind.INT, "1 where a variable is in the basis")
    basis = body.local("basis", (rows,), Kind.INT, "variable of each row; -1: its artificial one")
    size = body.local("size", (rows,), comment="largest element of each row before the rows are scaled")
    _set_up(body, (W.place, low.place, high.place, start.place, towards.place), tableau, upper, size)
    with body.loop("j", n + 1) as j:
        body.set(at_upper[j], integer(0))
        body.set(inside[j], integer(0))
    with body.loop("i", rows) as i:
        body.set(basis[i], integer(-1))
    raising = body.local("raising", (), Kind.INT, "0: artificial variables fall; 1: f rises")
    going = body.local("going", (), Kind.INT)
    body.set(raising, integer(0))
    body.set(going, integer(1))
    bland = PASSES_BEFORE_BLAND * (n + 1 + rows)
    with body.loop("pass", PASSES * (n + 1 + rows)) as turn, body.when(going > 0):
        enter = _entering(body, tableau, upper, at_upper, inside, basis, raising, turn >= bland, pivot)
        with body.when(enter < 0):
            with body.when(raising > 0):
                body.set(going, integer(0))
            with body.otherwise():
                left = body.local("left")
                body.set(left, real(0))
                with body.loop("i", rows) as i, body.when(basis[i] < 0):
                    body.add(left, tableau[i][n + 1])
                with body.when(left > real(tolerance)):
                    body.ret(real(OUT_OF_REACH))
                body.set(raising, integer(1))
        with body.otherwise():
            _exchange(body, tableau, upper, at_upper, inside, basis, raising, enter, pivot)
    body.note("out of passes before the start was reached")
    with body.when(equal(raising, integer(0))):
        body.ret(real(OUT_OF_REACH))
    answer = body.local("answer", (count,))
    _answer(body, tableau, at_upper, basis, (low.place, high.place), answer)
    share = body.local("share")
    body.set(share, select(at_upper[n] > 0, real(1), real(0)))
    with body.loop("i", rows) as i, body.when(equal(basis[i], integer(n))):
        body.set(share, tableau[i][n + 1])
    body.set(share, select(share > 1, real(1), select(share < 0, real(0), share)))
    error = _error(body, (W.place, start.place, towards.place), answer, share, size)
    with body.when(error > real(2 * tolerance)):
        body.ret(real(OUT_OF_REACH))
    with body.loop("j", n) as j:
        body.set(y.place[j], answer[j])
    body.ret(share)
    return body.function(
        f"largest_share_{rows}",
        "Largest f of 0 to 1 for which W y = start + f towards has a solution within the bounds; -1: none has.",
        (W, low, high, start, towards, y),
        returns=Kind.REAL,
    )


def _set_up(body: Body, given: tuple[Place, ...], tableau: Place, upper: Place, size: Place) -> None:
    """Tableau of z = (y - low) / (high - low) and f: rows of largest element 1, with values that are not negative.

    Both are scaled, so that a coefficient near zero is one that cannot move its row, whatever the units of y are.
    `size` keeps what each row was divided by.
    """
    W, low, high, start, towards = given
    rows, n = len(tableau), len(low)
    with body.loop("j", n) as j:
        body.set(upper[j], select(high[j] > low[j], real(1), real(0)))
    body.set(upper[n], real(1))
    with body.loop("i", rows) as i:
        value = body.local("value")
        largest = body.local("largest")
        body.set(value, start[i])
        body.set(largest, magnitude(towards[i]))
        with body.loop("j", n) as j:
            body.set(tableau[i][j], W[i * n + j] * (high[j] - low[j]))
            body.add(value, -(W[i * n + j] * low[j]))
            body.set(largest, select(magnitude(tableau[i][j]) > largest, magnitude(tableau[i][j]), largest))
        body.set(tableau[i][n], -towards[i])
        body.set(tableau[i][n + 1], value)
        body.set(largest, select(magnitude(value) > largest, magnitude(value), largest))
        body.set(size[i], select(largest > 0, largest, real(1)))
        factor = body.let("factor", select(value < 0, -1 / size[i], 1 / size[i]))
        with body.loop("j", n + 2) as j:
            body.set(tableau[i][j], tableau[i][j] * factor)


def _entering(
    body: Body,
    tableau: Place,
    upper: Place,
    at_upper: Place,
    inside: Place,
    basis: Place,
    raising: Place,
    first: Expr,
    pivot: float,
) -> Place:
    """The variable to enter the basis: that of the largest gain, or the first with a gain; -1: none has."""
    rows, n = len(tableau), len(upper) - 1
    enter = body.local("enter", (), Kind.INT)
    best = body.local("best")
    body.set(enter, integer(-1))
    body.set(best, real(pivot))
    with body.loop("j", n + 1) as j, body.when(and_(equal(inside[j], integer(0)), upper[j] > 0)):
        gain = body.local("gain")
        body.set(gain, select(and_(raising > 0, equal(j, integer(n))), real(1), real(0)))
        with body.loop("i", rows) as i:
            with body.when(and_(raising > 0, equal(basis[i], integer(n)))):
                body.set(gain, -tableau[i][j])
            with body.when(and_(equal(raising, integer(0)), basis[i] < 0)):
                body.add(gain, tableau[i][j])
        body.set(gain, select(at_upper[j] > 0, -gain, gain))
        with body.when(and_(gain > best, Not(and_(first, enter >= 0)))):
            body.set(best, gain)
            body.set(enter, j)
    return enter


def _exchange(
    body: Body,
    tableau: Place,
    upper: Place,
    at_upper: Place,
    inside: Place,
    basis: Place,
    raising: Place,
    enter: Place,
    pivot: float,
) -> None:
    """Move the entering variable as far as the basis allows, and exchange it for the one that stops it."""
    rows, n = len(tableau), len(upper) - 1
    direction = body.let("direction", select(at_upper[enter] > 0, real(-1), real(1)))
    reach = body.local("reach")
    leave = body.local("leave", (), Kind.INT)
    body.set(reach, upper[enter])
    body.set(leave, integer(-1))
    largest = body.local("steepest")
    body.set(largest, real(0))
    with body.loop("i", rows) as i:
        slope = body.let("slope", tableau[i][enter] * direction)
        value = body.let("value", tableau[i][n + 1])
        artificial = basis[i] < 0
        bounded = or_(basis[i] >= 0, raising > 0)
        top = body.local("top")
        body.set(top, real(0))
        with body.when(Not(artificial)):
            body.set(top, upper[basis[i]])
        room = body.local("room")
        body.set(room, real(-1))
        with body.when(slope > real(pivot)):
            body.set(room, select(value > 0, value, real(0)) / slope)
        with body.when(and_(slope < real(-pivot), bounded)):
            body.set(room, select(top > value, top - value, real(0)) / -slope)
        # of variables that stop it at once, the steepest makes the largest pivot
        nearer = or_(room < reach, and_(Not(room > reach), and_(leave >= 0, magnitude(slope) > largest)))
        with body.when(and_(room >= 0, nearer)):
            body.set(reach, room)
            body.set(leave, i)
            body.set(largest, magnitude(slope))
    moved = body.let("moved", direction * reach)
    with body.loop("i", rows) as i:
        body.add(tableau[i][n + 1], -(tableau[i][enter] * moved))
    with body.when(leave < 0):
        body.set(at_upper[enter], 1 - at_upper[enter])
    with body.otherwise():
        with body.when(basis[leave] >= 0):
            body.set(inside[basis[leave]], integer(0))
            above = and_(tableau[leave][enter] * direction < 0, upper[basis[leave]] > 0)
            body.set(at_upper[basis[leave]], select(above, integer(1), integer(0)))
        begun = body.let("begun", Convert(at_upper[enter], Kind.REAL) * upper[enter])
        body.set(basis[leave], enter)
        body.set(inside[enter], integer(1))
        unit = body.let("unit", tableau[leave][enter])
        with body.loop("j", n + 1) as j:
            body.set(tableau[leave][j], tableau[leave][j] / unit)
        body.set(tableau[leave][n + 1], begun + moved)
        with body.loop("i", rows) as i, body.when(Not(equal(i, leave))):
            share = body.let("share", tableau[i][enter])
            with body.loop("j", n + 1) as j:
                body.add(tableau[i][j], -(share * tableau[leave][j]))


def _answer(body: Body, tableau: Place, at_upper: Place, basis: Place, bounds: tuple[Place, Place], y: Place) -> None:
    """y of the basis, inside its bounds despite rounding."""
    low, high = bounds
    n = len(low)
    with body.loop("j", n) as j:
        body.set(y[j], select(at_upper[j] > 0, high[j], low[j]))
    with body.loop("i", len(tableau)) as i, body.when(and_(basis[i] >= 0, basis[i] < n)):
        own = basis[i]
        value = body.let("value", low[own] + tableau[i][n + 1] * (high[own] - low[own]))
        body.set(y[own], select(value > high[own], high[own], select(value < low[own], low[own], value)))


def _error(body: Body, system: tuple[Place, ...], answer: Place, share: Expr, size: Place) -> Place:
    """Sum of the errors of the rows of W y = start + share towards, in rows of largest element 1."""
    W, start, towards = system
    n = len(answer)
    error = body.local("error")
    body.set(error, real(0))
    with body.loop("i", len(start)) as i:
        rest = body.local("rest")
        body.set(rest, start[i] + share * towards[i])
        with body.loop("j", n) as j:
            body.add(rest, -(W[i * n + j] * answer[j]))
        body.add(error, magnitude(rest) / size[i])
    return error
