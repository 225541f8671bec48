"""The largest share of a demand that bounded unknowns can meet without turning it: a small linear programme.

Wanted is the largest f in [0, 1] for which W y = start + f towards has a solution with low <= y <= high. Primal simplex
method for bounded variables on a dense tableau (Dantzig 1963, chapter 18): first the artificial variables of the rows
are driven to zero, then f is raised. The variable with the largest gain enters; after PASSES_BEFORE_BLAND passes per
variable the first one with a gain does (Bland 1977), so that it cannot circle. Rows may depend on one another: an
artificial variable that stays is held at zero. At the end the answer is put into the equations, so that rounding never
passes for a solution.
"""

from __future__ import annotations

from mahovik.core.program.function import Function
from mahovik.core.program.kernel import Ints, Reals, argument, inline, ints, kernel, reals
from mahovik.core.program.types import NamedCount

OUT_OF_REACH = -1
"""Result where not even f = 0 has a solution."""

PASSES_BEFORE_BLAND = 3
PASSES = 6
"""Per row and variable; tests count at most two."""


def largest_share(rows: int, count: NamedCount, pivot: float, tolerance: float) -> Function:
    """`largest_share` for a matrix of `rows` x `count`.

    pivot      a coefficient below this, in scaled rows and columns (`set_up`), counts as zero
    tolerance  how far the rows may be from zero at f = 0, in the same rows, before `start` counts as out of reach; the
               answer may be as far again from its equations, by rounding
    """
    n = int(count)  # variable n is f
    bland = PASSES_BEFORE_BLAND * (n + 1 + rows)

    @kernel(f"largest_share_{rows}")
    def largest_share(
        W: Reals = argument("rows of the equations, one after the other", rows * n),
        low: Reals = argument("lower bounds of y", count),
        high: Reals = argument("upper bounds; not below the lower ones", count),
        start: Reals = argument("W y wanted at f = 0", rows),
        towards: Reals = argument("what f = 1 adds to it", rows),
        y: Reals = argument("the solution; untouched where the result is -1", count, direction="inout"),
    ) -> float:
        """Largest f of 0 to 1 for which W y = start + f towards has a solution within the bounds; -1: none has."""
        tableau = reals(rows, n + 2)  # columns: (y - low) / (high - low), then f, then the values of the basis
        upper = reals(n + 1)  # upper bounds of the variables; the lower ones are 0
        at_upper = ints(n + 1)  # 1 where a variable outside the basis is at its upper bound
        inside = ints(n + 1)  # 1 where a variable is in the basis
        basis = ints(rows)  # variable of each row; -1: its artificial one
        size = reals(rows)  # largest element of each row before the rows are scaled
        set_up(W, low, high, start, towards, tableau, upper, size)
        for j in range(n + 1):
            at_upper[j] = 0
            inside[j] = 0
        for i in range(rows):
            basis[i] = -1
        raising: int = 0  # 0: artificial variables fall; 1: f rises
        going: int = 1
        for pass_ in range(PASSES * (n + 1 + rows)):  # at most, far more than needed
            if going > 0:
                enter = entering(tableau, upper, at_upper, inside, basis, raising, pass_ >= bland, pivot)
                if enter < 0:
                    if raising > 0:
                        going = 0
                    else:
                        left: float = 0.0
                        for i in range(rows):
                            if basis[i] < 0:
                                left += tableau[i][n + 1]
                        if left > tolerance:
                            return OUT_OF_REACH
                        raising = 1
                else:
                    exchange(tableau, upper, at_upper, inside, basis, raising, enter, pivot)
        # out of passes before the start was reached
        if raising == 0:
            return OUT_OF_REACH
        answer = reals(count)
        read_answer(tableau, at_upper, basis, low, high, answer)
        share: float = 1.0 if at_upper[n] > 0 else 0.0
        for i in range(rows):
            if basis[i] == n:
                share = tableau[i][n + 1]
        share = 1.0 if share > 1 else 0.0 if share < 0 else share
        error = error_of(W, start, towards, answer, share, size)
        if error > 2 * tolerance:
            return OUT_OF_REACH
        for j in range(n):
            y[j] = answer[j]
        return share

    return largest_share


@inline
def set_up(
    W: Reals, low: Reals, high: Reals, start: Reals, towards: Reals, tableau: Reals, upper: Reals, size: Reals
) -> None:
    """Tableau of z = (y - low) / (high - low) and f: rows of largest element 1, with values that are not negative.

    Both are scaled, so that a coefficient near zero is one that cannot move its row, whatever the units of y are.
    `size` keeps what each row was divided by.
    """
    rows, n = len(tableau), len(low)
    for j in range(n):
        upper[j] = 1.0 if high[j] > low[j] else 0.0
    upper[n] = 1
    for i in range(rows):
        value: float = start[i]
        largest: float = abs(towards[i])
        for j in range(n):
            tableau[i][j] = W[i * n + j] * (high[j] - low[j])
            value -= W[i * n + j] * low[j]
            largest = abs(tableau[i][j]) if abs(tableau[i][j]) > largest else largest
        tableau[i][n] = -towards[i]
        tableau[i][n + 1] = value
        largest = abs(value) if abs(value) > largest else largest
        size[i] = largest if largest > 0 else 1.0
        factor = -1 / size[i] if value < 0 else 1 / size[i]
        for j in range(n + 2):
            tableau[i][j] = tableau[i][j] * factor


@inline
def entering(
    tableau: Reals, upper: Reals, at_upper: Ints, inside: Ints, basis: Ints, raising: int, first: bool, pivot: float
) -> int:
    """The variable to enter the basis: that of the largest gain, or the first with a gain; -1: none has."""
    rows, n = len(tableau), len(upper) - 1
    enter: int = -1
    best: float = pivot
    for j in range(n + 1):
        if inside[j] == 0 and upper[j] > 0:
            gain: float = 1.0 if raising > 0 and j == n else 0.0
            for i in range(rows):
                if raising > 0 and basis[i] == n:
                    gain = -tableau[i][j]
                if raising == 0 and basis[i] < 0:
                    gain += tableau[i][j]
            gain = -gain if at_upper[j] > 0 else gain
            if gain > best and not (first and enter >= 0):
                best = gain
                enter = j
    return enter


@inline
def exchange(
    tableau: Reals, upper: Reals, at_upper: Ints, inside: Ints, basis: Ints, raising: int, enter: int, pivot: float
) -> None:
    """Move the entering variable as far as the basis allows, and exchange it for the one that stops it.

    Of variables that stop it at once, the steepest makes the largest pivot.
    """
    rows, n = len(tableau), len(upper) - 1
    direction = -1.0 if at_upper[enter] > 0 else 1.0
    reach: float = upper[enter]
    leave: int = -1
    steepest: float = 0.0
    for i in range(rows):
        slope = tableau[i][enter] * direction
        value = tableau[i][n + 1]
        top: float = 0.0
        if not basis[i] < 0:
            top = upper[basis[i]]
        room: float = -1.0
        if slope > pivot:
            room = (value if value > 0 else 0.0) / slope
        if slope < -pivot and (basis[i] >= 0 or raising > 0):
            room = (top - value if top > value else 0.0) / -slope
        if room >= 0 and (room < reach or (not room > reach and (leave >= 0 and abs(slope) > steepest))):
            reach = room
            leave = i
            steepest = abs(slope)
    moved = direction * reach
    for i in range(rows):
        tableau[i][n + 1] -= tableau[i][enter] * moved
    if leave < 0:
        at_upper[enter] = 1 - at_upper[enter]
    else:
        if basis[leave] >= 0:
            inside[basis[leave]] = 0
            at_upper[basis[leave]] = 1 if tableau[leave][enter] * direction < 0 and upper[basis[leave]] > 0 else 0
        begun = float(at_upper[enter]) * upper[enter]
        basis[leave] = enter
        inside[enter] = 1
        unit = tableau[leave][enter]
        for j in range(n + 1):
            tableau[leave][j] = tableau[leave][j] / unit
        tableau[leave][n + 1] = begun + moved
        for i in range(rows):
            if not i == leave:
                share = tableau[i][enter]
                for j in range(n + 1):
                    tableau[i][j] -= share * tableau[leave][j]


@inline
def read_answer(tableau: Reals, at_upper: Ints, basis: Ints, low: Reals, high: Reals, y: Reals) -> None:
    """y of the basis, inside its bounds despite rounding."""
    n = len(low)
    for j in range(n):
        y[j] = high[j] if at_upper[j] > 0 else low[j]
    for i in range(len(tableau)):
        if basis[i] >= 0 and basis[i] < n:
            value = low[basis[i]] + tableau[i][n + 1] * (high[basis[i]] - low[basis[i]])
            y[basis[i]] = (
                high[basis[i]] if value > high[basis[i]] else low[basis[i]] if value < low[basis[i]] else value
            )


@inline
def error_of(W: Reals, start: Reals, towards: Reals, answer: Reals, share: float, size: Reals) -> float:
    """Sum of the errors of the rows of W y = start + share towards, in rows of largest element 1."""
    n = len(answer)
    error: float = 0.0
    for i in range(len(start)):
        rest: float = start[i] + share * towards[i]
        for j in range(n):
            rest -= W[i * n + j] * answer[j]
        error += abs(rest) / size[i]
    return error
