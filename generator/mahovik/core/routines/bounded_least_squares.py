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

from mahovik.core.program.function import Function
from mahovik.core.program.kernel import Ints, Reals, Result, argument, inline, ints, kernel, reals
from mahovik.core.program.types import NamedCount
from mahovik.core.routines import ldl

ROUNDS = 3
"""Solutions of a pass, two of them for what the one before has left."""


def passes(count: int) -> int:
    """Number of passes: each unknown may be held and released again. Tests against SciPy need at most half."""
    return 4 + 6 * count


def bounded_least_squares(rows: int, count: NamedCount, regular: float) -> Function:
    """`bounded_least_squares` for a matrix of `rows` x `count`; `regular`: lambda, relative to the largest row."""

    @kernel(f"bounded_least_squares_{rows}")
    def bounded_least_squares(
        W: Reals = argument("rows of the equations, one after the other", rows * int(count)),
        r: Reals = argument("wanted W y", rows),
        low: Reals = argument("lower bounds of y", count),
        high: Reals = argument("upper bounds; not below the lower ones", count),
        weight: Reals = argument("Omega, greater than 0", count),
        y: Reals = argument("the solution", count, direction="out"),
        held: Ints = argument("-1 at its lower bound, 1 at its upper one, 0 between", count, direction="out"),
    ) -> None:
        """Least error of W y = r within bounds, then least weighted norm of y."""
        begin(low, high, y, held)
        gram = reals(rows, rows)  # of rows, or of fewer free unknowns; then its factors
        z = reals(rows)  # (r - W y)/lambda
        left = reals(rows)  # right-hand side, and what solves it
        free = ints(rows)  # free unknowns where these are fewer than rows
        many = ints()  # number of free unknowns
        goal = reals(count)  # solution of the free unknowns
        largest = largest_diagonal(W, weight, rows)
        lambda_ = regular * largest if largest > 0 else 1.0
        going: int = 1
        for pass_ in range(passes(int(count))):  # at most: each unknown is held and released again
            if going > 0:
                make_gram(W, weight, held, gram, free, many, lambda_)
                unknowns = many if many < rows else rows
                ldl.factor(gram, unknowns, lambda pivot: 2.0**-52 * pivot + 2.0**-20 * lambda_)  # may be singular
                solve_free(W, r, weight, y, held, gram, z, left, free, many, goal, unknowns, lambda_)
                stopped = advance(low, high, y, held, goal)
                if stopped < 0:
                    freed = unknown_to_release(W, weight, y, held, z)
                    if freed < 0:
                        going = 0
                    else:
                        held[freed] = 0

    return bounded_least_squares


@inline
def begin(low: Reals, high: Reals, y: Reals, held: Ints) -> None:
    """Begin at the place within the bounds that is nearest to zero; unknowns without room are held."""
    for s in range(len(y)):
        y[s] = low[s] if low[s] > 0 else high[s] if high[s] < 0 else 0.0
        held[s] = 1 if not low[s] < high[s] else 0


@inline
def largest_diagonal(W: Reals, weight: Reals, rows: int) -> float:
    """The largest diagonal element of W Omega^-1 W^T: lambda is a small part of it."""
    count = len(weight)
    largest: float = 0.0  # diagonal element of W Omega^-1 W^T
    for i in range(rows):
        whole: float = 0.0
        for s in range(count):
            whole += W[i * count + s] * W[i * count + s] / weight[s]
        largest = whole if whole > largest else largest
    return largest


@inline
def make_gram(W: Reals, weight: Reals, held: Ints, gram: Reals, free: Ints, many: Result, ridge: float) -> None:
    """W Omega^-1 W^T + lambda over the free unknowns; where these are fewer than rows, W^T W + lambda Omega of them."""
    rows, count = len(gram), len(weight)
    for i in range(rows):
        for j in range(i + 1):
            gram[i][j] = 0
    many.value = 0
    for s in range(count):
        if held[s] == 0:
            if many.value < rows:
                free[many.value] = s
            many.value = many.value + 1
    total = reals()
    if many.value < rows:
        for k in range(many.value):
            for l in range(k + 1):
                total = ridge * weight[free[k]] if k == l else 0.0
                for i in range(rows):
                    total += W[i * count + free[k]] * W[i * count + free[l]]
                gram[k][l] = total
    else:
        for i in range(rows):
            for j in range(i + 1):
                total = ridge if i == j else 0.0
                for s in range(count):
                    if held[s] == 0:
                        total += W[i * count + s] * W[j * count + s] / weight[s]
                gram[i][j] = total


@inline
def solve_free(
    W: Reals, r: Reals, weight: Reals, y: Reals, held: Ints, gram: Reals, z: Reals, left: Reals, free: Ints, many: int,
    goal: Reals, size: int, ridge: float,
) -> None:  # fmt: skip
    """The solution of the free unknowns, refined, and the multipliers z."""
    rows, count = len(r), len(y)
    # held unknowns keep their values; the free ones start from 0
    for s in range(count):
        goal[s] = 0.0 if held[s] == 0 else y[s]
    for i in range(rows):
        z[i] = 0
    missing = reals(rows)  # r - W goal
    for round in range(ROUNDS + 1):
        for i in range(rows):
            missing[i] = r[i]
            for s in range(count):
                missing[i] -= W[i * count + s] * goal[s]
        if many >= rows and round < ROUNDS:
            for i in range(rows):
                left[i] = missing[i]
            ldl.solve(gram, left, size)
            for i in range(rows):
                z[i] += left[i]
            for s in range(count):
                if held[s] == 0:
                    for i in range(rows):
                        goal[s] += W[i * count + s] * left[i] / weight[s]
        if many < rows:
            # what the last round leaves of the demand gives the multipliers
            for i in range(rows):
                z[i] = missing[i] / ridge
            if round < ROUNDS:
                for k in range(many):
                    left[k] = 0
                    for i in range(rows):
                        left[k] += W[i * count + free[k]] * missing[i]
                ldl.solve(gram, left, size)
                for k in range(many):
                    goal[free[k]] += left[k]


@inline
def advance(low: Reals, high: Reals, y: Reals, held: Ints, goal: Reals) -> int:
    """Go towards the goal as far as all bounds allow; the unknown that stopped it, or -1."""
    length: float = 1
    stopped: int = -1
    for s in range(len(y)):
        if held[s] == 0:
            if goal[s] > high[s] or goal[s] < low[s]:
                room = high[s] - y[s] if goal[s] > high[s] else low[s] - y[s]
                part = room / (goal[s] - y[s])
                if part < length:
                    length = part if part > 0 else 0.0
                    stopped = s
    for s in range(len(y)):
        if held[s] == 0:
            moved = y[s] + length * (goal[s] - y[s]) if length < 1 else goal[s]
            y[s] = high[s] if moved > high[s] else low[s] if moved < low[s] else moved
    if stopped >= 0:
        up = goal[stopped] > high[stopped]
        y[stopped] = high[stopped] if up else low[stopped]
        held[stopped] = 1 if up else -1
    return stopped


@inline
def unknown_to_release(W: Reals, weight: Reals, y: Reals, held: Ints, z: Reals) -> int:
    """The held unknown that the objective would move inward most, beyond rounding, or -1."""
    freed: int = -1
    best: float = 0
    for s in range(len(y)):
        if not held[s] == 0:
            pull: float = -(weight[s] * y[s])  # W^T z - Omega y: where the objective falls
            size: float = abs(weight[s] * y[s])  # sum of its terms, for rounding
            for i in range(len(z)):
                term = W[i * len(y) + s] * z[i]
                pull += term
                size += abs(term)
            inward = -pull if held[s] > 0 else pull
            if inward > 2.0**-20 * size and inward * inward > best * weight[s]:
                best = inward * inward / weight[s]
                freed = s
    return freed
