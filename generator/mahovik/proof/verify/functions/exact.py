"""Judge of `wrap`: angles, exact, and pi with fifty digits."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from mahovik.contract.quantities import limits_of
from mahovik.proof.verify.case import Case, Rows

TURN = 2 * Fraction("3.1415926535897932384626433832795028841971693993751")
"""2 pi; the angles are rounded to 17 digits, and have at most eight before the point."""

PROMISE = 2.5
"""Promised error, in units in the last place of 1: 5e-16 rad in double."""


def judge_wrap(case: Case, rows: Rows) -> None:
    """An angle, but for whole turns, within half a turn."""
    check = rows.check("phi, of the promised error")
    for phi in _angles(case, case.random(len(rows.function))):
        (found,) = case.call(rows.function, {"phi": phi}).values()
        off = Fraction(found) - Fraction(phi)
        off -= TURN * round(off / TURN)
        beyond = max(0.0, abs(found) - math.pi * (1 + case.unit))
        check.note((abs(float(off)) + beyond) / (PROMISE * case.unit), f"{rows.function} of {phi}")


def _angles(case: Case, rng: np.random.Generator) -> list[float]:
    """Angles in the range, among them odd multiples of pi: there the nearest number of turns hangs on rounding."""
    (most,) = limits_of("phi", case.real)
    edges = (2 * rng.integers(-100, 100, 100) + 1) * math.pi
    angles = [0.0, math.pi, -math.pi, most, -most, *edges, *rng.uniform(-most, most, 200), *rng.normal(size=50)]
    found: list[float] = np.clip(case.nearest_numbers(angles), -most, most).tolist()
    return found
