"""Judge of `wrap`: angles with fifty digits."""

from __future__ import annotations

import math

import mpmath
import numpy as np

from mahovik.contract.quantities import limits_of
from mahovik.proof.verify.functions.case import Case, Rows

_DIGITS = mpmath.MPContext()
_DIGITS.dps = 50

PROMISE = 2.5
"""Promised error, in units in the last place of 1: 5e-16 rad in double."""


def judge_wrap(case: Case, rows: Rows) -> None:
    """An angle, but for whole turns, within half a turn."""
    check, turn = rows.check("phi, of the promised error"), 2 * _DIGITS.pi
    for phi in _angles(case, case.random(len(rows.function))):
        (found,) = case.call(rows.function, {"phi": phi}).values()
        off = _DIGITS.mpf(found) - _DIGITS.mpf(phi)
        off -= turn * _DIGITS.nint(off / turn)
        off = abs(off) + max(0.0, abs(found) - math.pi * (1 + case.unit))
        check.note(float(off) / (PROMISE * case.unit), f"{rows.function} of {phi}")


def _angles(case: Case, rng: np.random.Generator) -> list[float]:
    """Angles in the range, among them odd multiples of pi: there the nearest number of turns hangs on rounding."""
    (most,) = limits_of("phi", case.real)
    edges = (2 * rng.integers(-100, 100, 100) + 1) * math.pi
    angles = [0.0, math.pi, -math.pi, most, -most, *edges, *rng.uniform(-most, most, 200), *rng.normal(size=50)]
    found: list[float] = np.clip(case.nearest_numbers(angles), -most, most).tolist()
    return found
