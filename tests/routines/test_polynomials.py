"""The polynomials of the routines: derived again by tools/minimax.py, and within the error they claim."""

from typing import Any

import minimax
import mpmath as mp
import pytest

from mahovik.core.routines import arc_tangent
from mahovik.core.routines.exponential import POLYNOMIALS as EXPONENTIAL
from mahovik.core.routines.sincos import POLYNOMIALS as SINCOS


def used(name: str, precision: str) -> tuple[list[Any], float]:
    """Coefficients a routine uses, as numbers of the element type, and the error it claims for them."""
    if name == "sine":
        coefficients, error = SINCOS[precision].sine, SINCOS[precision].sine_error
    elif name == "cosine":
        coefficients, error = SINCOS[precision].cosine, SINCOS[precision].cosine_error
    elif name == "hyperbolic sine":
        coefficients, error = EXPONENTIAL[precision].sine, EXPONENTIAL[precision].sine_error
    elif name == "hyperbolic cosine":
        coefficients, error = EXPONENTIAL[precision].cosine, EXPONENTIAL[precision].cosine_error
    else:
        fit = arc_tangent.POLYNOMIALS[precision]
        coefficients, error = fit.coefficients, fit.error
    return [minimax.representable(c, precision) for c in coefficients], error


EACH = pytest.mark.parametrize("precision", ("double", "float"))
PROBLEMS = pytest.mark.parametrize("problem", minimax.PROBLEMS, ids=lambda p: p.name)


@EACH
@PROBLEMS
def test_polynomial_keeps_the_error_it_claims(problem: minimax.Problem, precision: str) -> None:
    coefficients, claimed = used(problem.name, precision)
    found = float(minimax.largest_deviation(problem, coefficients, samples=1500))
    assert 0.9 * claimed < found <= claimed


@pytest.mark.slow
@EACH
@PROBLEMS
def test_coefficients_are_those_the_tool_derives(problem: minimax.Problem, precision: str) -> None:
    coefficients, _ = used(problem.name, precision)
    assert coefficients == minimax.coefficients_of(problem, precision)


@PROBLEMS
def test_error_alternates_as_chebyshev_demands(problem: minimax.Problem) -> None:
    """A best polynomial of n terms has n + 1 extrema of one size and alternating sign."""
    terms = problem.terms["float"]
    with mp.workdps(minimax.DIGITS):
        best = minimax.remez(problem, terms)
        samples = 1000
        errors = [minimax.deviation(problem, best, problem.span * mp.mpf(i) / samples) for i in range(1, samples + 1)]
    extrema, run = [], errors[0]
    for error in errors:
        if (error > 0) != (run > 0):
            extrema.append(abs(run))
            run = error
        run = max(run, error, key=abs)
    extrema.append(abs(run))
    assert len(extrema) == terms + 1
    assert max(extrema) < 1.001 * min(extrema)
