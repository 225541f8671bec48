"""Judges of `wrap` and of the encoder's functions: exact integers, and angles with fifty digits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np

from mahovik.contract.quantities import limits_of
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case

_DIGITS = mpmath.MPContext()
_DIGITS.dps = 50

PROMISES = {"wrap": 2.5, "phase_of_counts": 2.0, "speed_of_counts": 4.0}
"""Promised errors, in units in the last place: of 1 (5e-16 rad in double) of `wrap`, of the result elsewhere."""

Asked = tuple[Mapping[str, Any], Any]
"""Arguments, and the exact answer."""


def angle_checks(case: Case, function: str) -> Iterator[Check]:
    """An angle, but for whole turns within half a turn, or a speed: 2 pi moved / (per_turn dt)."""
    asked = {"wrap": _angles, "phase_of_counts": _phases, "speed_of_counts": _speeds}[function]
    name = "phi_dot" if function == "speed_of_counts" else "phi"
    row, turn = Check(function, f"{name}, of the promised error", case.limits.promise), 2 * _DIGITS.pi
    for given, exact in asked(case, case.random(len(function))):
        (found,) = case.call(function, given).values()
        off, size = _DIGITS.mpf(found) - exact, 1.0
        if name == "phi":
            off -= turn * _DIGITS.nint(off / turn)
            off = abs(off) + max(0.0, abs(found) - math.pi * (1 + case.unit))
        if function != "wrap":
            size = max(abs(found), float(np.finfo(np.float32).tiny))
            off = 0.0 if abs(found) < case.unit and abs(off) < case.unit else off
        row.note(float(abs(off) / size) / (PROMISES[function] * case.unit), f"{function} of {dict(given)}")
    yield row


def _angles(case: Case, rng: np.random.Generator) -> Iterator[Asked]:
    """Angles in the range, among them odd multiples of pi: there the nearest number of turns hangs on rounding."""
    (most,) = limits_of("phi", case.real)
    edges = (2 * rng.integers(-100, 100, 100) + 1) * math.pi
    angles = [0.0, math.pi, -math.pi, most, -most, *edges, *rng.uniform(-most, most, 200), *rng.normal(size=50)]
    for phi in np.clip(case.nearest_numbers(angles), -most, most).tolist():
        yield {"phi": phi}, _DIGITS.mpf(phi)


def _phases(_: Case, rng: np.random.Generator) -> Iterator[Asked]:
    """2 pi (count - zero) / per_turn."""
    for number in range(200):
        per_turn = int(rng.integers(1, 1 << 12 if number % 2 else 1 << 22)) * (-1 if number % 5 == 0 else 1)
        most = min(abs(per_turn), 1000)
        count, zero = int(rng.integers(-(1 << 31), 1 << 31)), int(rng.integers(-most, most + 1))
        turns = Fraction(count - zero, per_turn)
        exact = 2 * _DIGITS.pi * turns.numerator / turns.denominator
        yield {"count": count, "per_turn": per_turn, "zero": float(zero)}, exact


def _speeds(_: Case, rng: np.random.Generator) -> Iterator[Asked]:
    """2 pi moved / (per_turn dt)."""
    for number in range(100):
        per_turn = int(rng.integers(100, 10000)) * (-1 if number % 3 == 0 else 1)
        moved, dt = int(rng.integers(-abs(per_turn), abs(per_turn) + 1)), 2.0 ** -int(rng.integers(4, 12))
        exact = 2 * _DIGITS.pi * moved / (per_turn * _DIGITS.mpf(dt))
        yield {"moved": moved, "per_turn": per_turn, "dt": dt}, exact


def accumulate_checks(case: Case, _: str) -> Iterator[Check]:
    """Place and counts moved of an encoder that turns at random, its counter wrapping; exact."""
    row, rng = Check("accumulate", "place, moved, counter", 0.0), case.random(6)
    for per_turn, bits in ((4096, 16), (-4096, 16), (1000, 12), (-360, 0), (512, 0), (10000, 32)):
        size = abs(per_turn) if bits == 0 else 1 << bits
        true, half = int(rng.integers(0, abs(per_turn))), min(size, 1 << 16) // 2
        encoder: dict[str, int] = {}
        for number in range(41):
            moved = int(rng.integers(-half + 1, half)) if number else 0
            true += moved
            counter = true % size
            counter -= 1 << 32 if bits == 32 and counter >= 1 << 31 else 0  # of 32 bits it is a signed number
            expected = {"counter": counter, "place": true % abs(per_turn), "moved": moved}
            if number:
                given = {"encoder": encoder, "counter": counter, "bits": bits, "per_turn": per_turn}
                found = case.call("accumulate", given)["encoder"]
                where = f"reading {number}, {per_turn} a turn, {bits} bits"
                row.demand(found == expected, where, f"{found} where exact integers give {expected}")
            encoder = expected
    yield row
