"""Minimax polynomials of generator/mahovik/routines, by Remez exchange. Prints coefficients and their error.

    python tools/minimax.py

A development tool (needs mpmath); nothing imports it but the tests, which derive the coefficients again.

Each polynomial P has the variable z = r^2 and is the best one for max |weight (P - target)| on 0 < z <= span^2:
the error printed is that of P with its coefficients rounded to the element type.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import mpmath as mp
import numpy as np

Real = Any  # an mpmath number; mpmath has no types
DIGITS = 50


@dataclass(frozen=True)
class Problem:
    """What P approximates: `target` and `weight` are functions of r, `span` the largest |r|, `terms` the count."""

    name: str
    form: str
    error: str
    target: Callable[[Real], Real]
    weight: Callable[[Real], Real]
    span: float
    terms: dict[str, int]


def _sine(r: Real) -> Real:
    return (mp.sin(r) - r) / r**3


def _cosine(r: Real) -> Real:
    return (mp.cos(r) - 1 + r**2 / 2) / r**4


def _arc_tangent(r: Real) -> Real:
    return (mp.atan(r) - r) / r**3


def _hyperbolic_sine(r: Real) -> Real:
    return (mp.sinh(r) - r) / r**3


def _hyperbolic_cosine(r: Real) -> Real:
    return (mp.cosh(r) - 1 - r**2 / 2) / r**4


# Reduction by pi/2 leaves |r| <= pi/4, and a little more where x*(2/pi) is rounded to the wrong side of a tie:
# in float, half an ulp of 637 quarter turns.
REDUCED = 0.7855
# Two cases of the arc tangent meet at 1/2, where comparison and subtraction are exact.
HALVED = 0.5
# Reduction by ln 2 leaves (ln 2)/2, and in float half an ulp of 126 of them.
HALF_LN_2 = 0.3466

PROBLEMS = (
    Problem(
        "sine",
        "sin r = r + r^3 P(z)",
        "relative",
        _sine,
        lambda r: r**3 / mp.sin(r),
        REDUCED,
        {"double": 6, "float": 3},
    ),
    Problem(
        "cosine",
        "cos r = 1 - z/2 + z^2 P(z)",
        "absolute",
        _cosine,
        lambda r: r**4,
        REDUCED,
        {"double": 6, "float": 3},
    ),
    Problem(
        "arc tangent",
        "atan r = r + r^3 P(z)",
        "relative",
        _arc_tangent,
        lambda r: r**3 / mp.atan(r),
        HALVED,
        {"double": 12, "float": 5},
    ),
    Problem(
        "hyperbolic sine",
        "sinh r = r + r^3 P(z)",
        "relative",
        _hyperbolic_sine,
        lambda r: r**3 / mp.sinh(r),
        HALF_LN_2,
        {"double": 5, "float": 3},
    ),
    Problem(
        "hyperbolic cosine",
        "cosh r = 1 + z/2 + z^2 P(z)",
        "absolute",
        _hyperbolic_cosine,
        lambda r: r**4,
        HALF_LN_2,
        {"double": 5, "float": 2},
    ),
)


def horner(coefficients: Sequence[Real], z: Real) -> Real:
    """Sum of coefficients[i] z^i, exact to the working precision."""
    total = mp.mpf(0)
    for c in reversed(coefficients):
        total = total * z + mp.mpf(c)
    return total


def deviation(problem: Problem, coefficients: Sequence[Real], r: Real) -> Real:
    """weight (P - target) at r."""
    return problem.weight(r) * (horner(coefficients, r**2) - problem.target(r))


def largest_deviation(problem: Problem, coefficients: Sequence[Real], samples: int = 400) -> Real:
    """max |weight (P - target)| over a dense grid."""
    with mp.workdps(DIGITS):
        grid = (mp.mpf(problem.span) * i / samples for i in range(1, samples + 1))
        return max(abs(deviation(problem, coefficients, r)) for r in grid)


def remez(problem: Problem, terms: int, samples: int = 400, rounds: int = 12) -> list[Real]:
    """Coefficients of the best polynomial with that many terms."""
    with mp.workdps(DIGITS):
        span = mp.mpf(problem.span)
        # Chebyshev nodes in z: unknowns are the coefficients and the levelled error.
        points = [mp.sqrt(span**2 * (1 - mp.cos(mp.pi * (2 * i + 1) / (2 * terms + 2))) / 2) for i in range(terms + 1)]
        grid = [span * mp.sqrt(mp.mpf(i) / samples) for i in range(1, samples + 1)]
        coefficients: list[Real] = []
        for _ in range(rounds):
            coefficients, level = _level(problem, terms, points)
            errors = [deviation(problem, coefficients, r) for r in grid]
            points = _extrema(grid, errors, terms + 1)
            if max(map(abs, errors)) < abs(level) * mp.mpf("1.0001"):
                break
        return coefficients


def _level(problem: Problem, terms: int, points: list[Real]) -> tuple[list[Real], Real]:
    """The polynomial whose error alternates between +E and -E at the points, and E."""
    matrix, right = mp.matrix(terms + 1), mp.matrix(terms + 1, 1)
    for row, r in enumerate(points):
        for column in range(terms):
            matrix[row, column] = r ** (2 * column)
        matrix[row, terms] = (-1) ** row / problem.weight(r)
        right[row] = problem.target(r)
    solution = mp.lu_solve(matrix, right)
    return [solution[i] for i in range(terms)], solution[terms]


def _extrema(grid: list[Real], errors: list[Real], count: int) -> list[Real]:
    """The largest error of every run of one sign: where the error alternates."""
    best: list[int] = []
    for i, error in enumerate(errors):
        if best and (error > 0) == (errors[best[-1]] > 0):
            if abs(error) > abs(errors[best[-1]]):
                best[-1] = i
        else:
            best.append(i)
    while len(best) > count:
        best.pop(0 if abs(errors[best[0]]) < abs(errors[best[-1]]) else -1)
    assert len(best) == count, "the error alternates too seldom: take a finer grid"
    return [grid[i] for i in best]


def representable(value: Real, precision: str) -> float:
    """The number of the element type next to `value`, as a Python float."""
    return float(value) if precision == "double" else float(np.float32(float(value)))


def coefficients_of(problem: Problem, precision: str) -> list[float]:
    """The coefficients the routines use: each in turn is rounded, and the best rest is found for what it became."""
    terms = problem.terms[precision]
    chosen: list[float] = []
    with mp.workdps(DIGITS):
        for done in range(terms):
            fixed = tuple(chosen)

            def target(r: Real, fixed: tuple[float, ...] = fixed, done: int = done) -> Real:
                return (problem.target(r) - horner(fixed, r**2)) / r ** (2 * done)

            def weight(r: Real, done: int = done) -> Real:
                return problem.weight(r) * r ** (2 * done)

            rest = replace(problem, target=target, weight=weight)
            chosen.append(representable(remez(rest, terms - done)[0], precision))
    return chosen


def main() -> None:
    """Prints every polynomial the routines use."""
    for problem in PROBLEMS:
        for precision in problem.terms:
            coefficients = coefficients_of(problem, precision)
            error = largest_deviation(problem, coefficients)
            bits = mp.nstr(mp.log(error, 2), 4)
            print(f"{problem.name}, {precision}: {problem.form}, |r| <= {problem.span}")
            print(f"  {problem.error} error {mp.nstr(error, 3)} = 2^{bits}")
            for c in coefficients:
                print(f"    {c:.17g}," if precision == "double" else f"    {c:.9g},")


if __name__ == "__main__":
    main()
