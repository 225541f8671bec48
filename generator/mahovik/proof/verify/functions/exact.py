"""Judges of `wrap` and of the encoder's functions: exact integers, and angles with fifty digits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

import mpmath
import numpy as np

from mahovik.contract.quantities import limits_of
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case

_DIGITS = mpmath.MPContext()
_DIGITS.dps = 50

WRAP_ERROR = 2.5
"""Promised error of `wrap`, in units in the last place of 1: 5e-16 rad in double."""

PHASE_ERROR, SPEED_ERROR = 2.0, 4.0
"""Promised errors of `phase_of_counts` and `speed_of_counts`, in units in the last place of their results."""


def _distance(found: float, angle: mpmath.mpf) -> float:
    """Smallest distance (rad) between an angle and the angles that are equal to the other but for whole turns."""
    turn = 2 * _DIGITS.pi
    off = (_DIGITS.mpf(found) - angle) / turn
    return float(abs(off - _DIGITS.nint(off)) * turn)


def _beyond_half_a_turn(found: float, unit: float) -> float:
    """Excess over pi, as the element type has it."""
    return max(0.0, abs(found) - math.pi * (1 + unit))


def wrap_checks(case: Case, _: str) -> Iterator[Check]:
    """The equal angle within half a turn."""
    row = Check("wrap", "wrapped, of the promised error", case.limits.promise)
    rng, (most,) = case.random(3), limits_of("phi", case.real)
    edges = (2 * rng.integers(-100, 100, 100) + 1) * math.pi  # there the nearest number of turns hangs on rounding
    angles = [0.0, math.pi, -math.pi, most, -most, *edges, *rng.uniform(-most, most, 200), *rng.normal(size=50)]
    for angle in angles:
        phi = float(np.float32(angle)) if case.real == "float" else float(angle)
        phi = max(-most, min(most, phi))
        found = case.call("wrap", {"phi": phi})["wrapped"]
        off = _distance(found, _DIGITS.mpf(phi)) + _beyond_half_a_turn(found, case.unit)
        row.note(off / (WRAP_ERROR * case.unit), f"phi = {phi:g}")
    yield row


def phase_checks(case: Case, _: str) -> Iterator[Check]:
    """2 pi (count - zero) / per_turn, but for whole turns."""
    row = Check("phase_of_counts", "phi, of the promised error", case.limits.promise)
    rng = case.random(4)
    for number in range(200):
        per_turn = int(rng.integers(1, 1 << 12 if number % 2 else 1 << 22)) * (-1 if number % 5 == 0 else 1)
        count = int(rng.integers(-(1 << 31), 1 << 31))
        zero = int(rng.integers(-min(abs(per_turn), 1000), min(abs(per_turn), 1000) + 1))
        found = case.call("phase_of_counts", {"count": count, "per_turn": per_turn, "zero": float(zero)})["phi"]
        exact = Fraction(count - zero, per_turn)
        angle = 2 * _DIGITS.pi * _DIGITS.mpf(exact.numerator) / exact.denominator
        off = _distance(found, angle) / max(abs(found), float(np.finfo(np.float32).tiny))
        off = 0.0 if abs(found) < case.unit and _distance(found, angle) < case.unit else off
        row.note(
            (off + _beyond_half_a_turn(found, case.unit)) / (PHASE_ERROR * case.unit), f"count {count} of {per_turn}"
        )
    yield row


def speed_checks(case: Case, _: str) -> Iterator[Check]:
    """2 pi moved / (per_turn dt)."""
    row = Check("speed_of_counts", "phi_dot, of the promised error", case.limits.promise)
    rng = case.random(5)
    for number in range(100):
        per_turn = int(rng.integers(100, 10000)) * (-1 if number % 3 == 0 else 1)
        moved, dt = int(rng.integers(-abs(per_turn), abs(per_turn) + 1)), 2.0 ** -int(rng.integers(4, 12))
        found = case.call("speed_of_counts", {"moved": moved, "per_turn": per_turn, "dt": dt})["phi_dot"]
        exact = 2 * math.pi * moved / (per_turn * dt)
        row.compare(found, exact, SPEED_ERROR * case.unit * abs(exact), f"{moved} of {per_turn} in {dt:g} s")
    yield row


def accumulate_checks(case: Case, _: str) -> Iterator[Check]:
    """Place and counts moved of an encoder that turns at random, its counter wrapping; exact."""
    row = Check("accumulate", "place, moved, counter", 0.0)
    rng = case.random(6)
    for per_turn, bits in ((4096, 16), (-4096, 16), (1000, 12), (-360, 0), (512, 0), (10000, 32)):
        size = abs(per_turn) if bits == 0 else 1 << bits
        true = int(rng.integers(0, abs(per_turn)))
        encoder = {"counter": _counter(true, bits, size), "place": true, "moved": 0}
        for number in range(40):
            moved = int(rng.integers(-(min(size, 1 << 16) // 2) + 1, min(size, 1 << 16) // 2))
            true += moved
            counter = _counter(true, bits, size)
            given = {"encoder": encoder, "counter": counter, "bits": bits, "per_turn": per_turn}
            encoder = case.call("accumulate", given)["encoder"]
            expected = {"counter": counter, "place": true % abs(per_turn), "moved": moved}
            off = 0.0 if encoder == expected else math.inf
            reason = "" if not off else f"{encoder} where exact integers give {expected}"
            row.note(off, f"reading {number}, {per_turn} a turn, {bits} bits", reason)
    yield row


def _counter(true: int, bits: int, size: int) -> int:
    """A count as a counter of that size shows it; of 32 bits as a signed number."""
    shown = true % size
    return shown - (1 << 32) if bits == 32 and shown >= 1 << 31 else shown
