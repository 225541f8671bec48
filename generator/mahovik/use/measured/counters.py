"""Counters and angles that wrap, as numbers that go on; counts as angles."""

from __future__ import annotations

import numpy as np

from mahovik.use.measured.recording import Array

REGISTERS = (1 << 8, 1 << 16, 1 << 32)
"""Moduli of counters that hold no whole number of turns."""

NEAR = 0.4
"""Part of a modulus between two samples, above which the direction of the step is not sure."""


def modulus_of(counts: Array, turn: int | None) -> int | None:
    """Modulus at which a counter wraps; None if it does not.

    That of a turn where all counts are inside one turn, else that of the smallest register that holds them, signed or
    not. A counter wraps where it steps by more than half of its modulus. `turn`: counts a turn.
    """
    finite = counts[np.isfinite(counts)]
    if len(finite) < 2:
        return None
    low, high, largest = finite.min(), finite.max(), np.abs(np.diff(finite)).max()
    moduli = ((abs(turn),) if turn else ()) + REGISTERS
    for modulus in moduli:
        inside = (low >= 0 and high < modulus) or (low >= -modulus // 2 and high < modulus // 2)
        if inside and largest > modulus / 2:
            return modulus
    return None


def unwrap(values: Array, modulus: float, expected: Array | None = None) -> tuple[Array, int, int]:
    """Numbers that go on, the number of wraps, and of steps whose direction is not sure.

    Each step is the one nearest to `expected` (T - 1,), zero without. NaN stays; a step over it is taken whole.
    """
    found = values.copy()
    places = np.flatnonzero(np.isfinite(values))
    steps = np.diff(values[places])
    if expected is None:
        guess = np.zeros(len(steps))
    else:
        total = np.concatenate([[0.0], np.cumsum(np.nan_to_num(expected))])
        guess = np.diff(total[places])
    wraps = np.round((guess - steps) / modulus)
    off = np.abs(steps + wraps * modulus - guess)
    found[places[1:]] += modulus * np.cumsum(wraps)
    return found, int((wraps != 0).sum()), int((off > NEAR * modulus).sum())
