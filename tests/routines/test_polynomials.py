"""The polynomials of the routines keep the errors that they claim, and claim no more than they have."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from mahovik.core.routines import arc_tangent
from mahovik.core.routines.exponential import POLYNOMIALS as EXPONENTIAL
from mahovik.core.routines.sincos import POLYNOMIALS as SINCOS
from routines.run import BITS

Real = Any
"""An mpmath number."""

REDUCED = 0.7855
"""Reduction by pi/2 leaves |r| <= pi/4, and in float half an ulp of 637 quarter turns more."""

HALF_LN_2 = 0.3466
"""Reduction by ln 2 leaves (ln 2)/2, and in float half an ulp of 126 of them more."""

SAMPLES = 1500


def relative(function: Callable[[Real], Real]) -> Callable[[Real, Real], Real]:
    """Relative error of r + r^3 P."""
    return lambda r, P: (r + r**3 * P) / function(r) - 1


def absolute(function: Callable[[Real], Real], sign: int) -> Callable[[Real, Real], Real]:
    """Error of 1 +- r^2/2 + r^4 P."""
    return lambda r, P: 1 + sign * r**2 / 2 + r**4 * P - function(r)


CASES = [
    (f"{what}, {real}", [float(scalar(c)) for c in coefficients], claimed, span, error)
    for real, scalar in (("double", np.float64), ("float", np.float32))
    for what, coefficients, claimed, span, error in (
        ("sine", SINCOS[real].sine, SINCOS[real].sine_error, REDUCED, relative(mp.sin)),
        ("cosine", SINCOS[real].cosine, SINCOS[real].cosine_error, REDUCED, absolute(mp.cos, -1)),
        ("sinh", EXPONENTIAL[real].sine, EXPONENTIAL[real].sine_error, HALF_LN_2, relative(mp.sinh)),
        ("cosh", EXPONENTIAL[real].cosine, EXPONENTIAL[real].cosine_error, HALF_LN_2, absolute(mp.cosh, 1)),
        (
            "arc tangent",
            arc_tangent.POLYNOMIALS[real].coefficients,
            arc_tangent.POLYNOMIALS[real].error,
            0.5,
            relative(mp.atan),
        ),
    )
]


@pytest.mark.parametrize(
    ("coefficients", "claimed", "span", "error"), [case[1:] for case in CASES], ids=[c[0] for c in CASES]
)
def test_polynomial_has_the_error_it_claims(
    coefficients: Sequence[float], claimed: float, span: float, error: Callable[[Real, Real], Real]
) -> None:
    with mp.workprec(BITS):
        grid = [mp.mpf(span) * i / SAMPLES for i in range(1, SAMPLES + 1)]
        worst = max(abs(error(r, mp.polyval([mp.mpf(c) for c in reversed(coefficients)], r**2))) for r in grid)
    assert 0.9 * claimed < worst <= claimed
