"""Results against the reference: the worst difference of every quantity, relative to its natural scale."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik import reference
from mahovik.errors import StateError
from mahovik.stand.model import Stand
from mahovik.stand.state import State
from mahovik.verify.scales import scales
from mahovik.verify.states import Request

TOLERANCE = {"double": 1e-12, "float": 1e-3}
"""Accepted difference relative to the natural scale (docs/verification.md), by element type."""

UNDERFLOW = 1e-290
"""Floor of every scale: below it products of inputs are subnormal and have lost their digits."""


@dataclass
class Row:
    """One line of the verdict. `worst` is a relative difference; `state` is where it occurred."""

    want: str
    quantity: str
    states: int = 0
    worst: float = 0.0
    state: str = ""
    request: Request | None = None
    verdict: str = ""
    reason: str = ""

    @property
    def failed(self) -> bool:
        """Whether the whole verification fails by this row."""
        return self.verdict not in ("ok", "not offered", "not compared")

    def note(self, difference: float, request: Request, reason: str = "") -> None:
        """Count one state."""
        self.states += 1
        if difference > self.worst or self.request is None:
            self.worst, self.request, self.reason = difference, request, reason
            self.state = str(request.id).partition(",")[0]


class Judge:
    """Compares results of one stand with the reference and keeps the worst of every quantity.

    A state that the reference refuses is no test of anybody, and `expected` is None there; so is a state of
    `inverse` whose rank or status hangs on the last digits of a singular value.
    """

    def __init__(self, stand: Stand, tolerance: float) -> None:
        self._stand = stand
        self.tolerance = tolerance
        self._rows: dict[tuple[str, str], Row] = {}
        self._last: tuple[State | None, str, dict[str, Any] | None] = (None, "", None)
        self._pieces: tuple[State | None, reference.Pieces | None] = (None, None)

    def expected(self, state: State, want: str) -> dict[str, Any] | None:
        """What the reference gives, or None."""
        if self._last[0] is not state or self._last[1] != want:
            self._last = (state, want, self._evaluated(state, want))
        return self._last[2]

    def _evaluated(self, state: State, want: str) -> dict[str, Any] | None:
        try:
            found = reference.evaluate(self._stand, state, [want], self._at(state))
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return None
        return None if want == "inverse" and _ambiguous(found) else found

    def compare(self, request: Request, want: str, found: Mapping[str, Any]) -> float:
        """Note the differences of one state; returns the largest."""
        expected = self.expected(request.state, want)
        if expected is None:
            return 0.0
        natural = self._scales(request.state, want)
        largest = 0.0
        for quantity, value in expected.items():
            off, reason = difference(found.get(quantity), value, natural[quantity])
            self._row(want, quantity).note(off, request, reason)
            largest = max(largest, off)
        return largest

    def refused(self, request: Request, want: str, reason: str) -> None:
        """Note a state that was refused though the reference evaluates it."""
        expected = self.expected(request.state, want)
        for quantity in expected or {}:
            self._row(want, quantity).note(math.inf, request, reason)

    def rows(self) -> list[Row]:
        """All rows with their verdicts, in the order in which the quantities came."""
        for row in self._rows.values():
            row.verdict = "ok" if row.states and row.worst <= self.tolerance else "FAILED"
        return list(self._rows.values())

    def _scales(self, state: State, want: str) -> dict[str, Any]:
        with np.errstate(all="ignore"):
            return scales(self._stand, state, self._at(state), want)

    def _at(self, state: State) -> reference.Pieces:
        """Pieces of a state, kept for all that is wanted of it."""
        known, at = self._pieces
        if known is not state or at is None:
            with np.errstate(all="ignore"):
                at = reference.pieces(self._stand, state)
            self._pieces = (state, at)
        return at

    def _row(self, want: str, quantity: str) -> Row:
        return self._rows.setdefault((want, quantity), Row(want, quantity))


def difference(found: Any, expected: Any, natural: Any) -> tuple[float, str]:
    """Largest |found - expected| / scale over the components, and words where there is more to say than that."""
    if found is None:
        return math.inf, "missing"
    if isinstance(expected, dict):
        return _of_parts(found, expected, natural)
    if natural is None:
        return (0.0, "") if found == expected else (math.inf, f"{found} where the reference has {expected}")
    try:
        numbers = np.array(found, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        return math.inf, "no array of numbers"
    wanted = np.asarray(expected, dtype=np.float64)
    if numbers.shape != wanted.shape:
        return math.inf, f"shape {list(numbers.shape)}, expected {list(wanted.shape)}"
    if not numbers.size:
        return 0.0, ""
    if not np.isfinite(numbers).all():
        return math.inf, "not finite"
    with np.errstate(over="ignore"):
        relative = np.abs(numbers - wanted) / np.maximum(natural, UNDERFLOW)
    return float(relative.max()), ""


def _of_parts(found: Any, expected: dict[str, Any], natural: Any) -> tuple[float, str]:
    """Of a nested object: the worst part, and its name in the words."""
    if not isinstance(found, Mapping):
        return math.inf, "no object"
    worst, words = 0.0, ""
    for name, value in expected.items():
        off, reason = difference(found.get(name), value, natural[name])
        if off > worst:
            worst, words = off, f"{name}: {reason}" if reason else name
    return worst, words


def same_bits(first: Any, second: Any) -> bool:
    """Whether two results hold the same numbers, bit for bit."""
    if isinstance(first, Mapping):
        return first.keys() == second.keys() and all(same_bits(first[name], second[name]) for name in first)
    if isinstance(first, Sequence | np.ndarray) and not isinstance(first, str):
        return len(first) == len(second) and all(map(same_bits, first, second))
    if isinstance(first, float | np.floating):
        return np.float64(first).tobytes() == np.float64(second).tobytes()
    return bool(first == second)


def _ambiguous(found: Mapping[str, Any]) -> bool:
    """Whether rank or status of `inverse` hangs on rounding: a singular value near one of its thresholds."""
    sigma = np.asarray(found["sigma"])
    if not sigma.size or sigma[0] == 0.0:
        return False
    ratios = sigma / sigma[0]
    return any(bool(np.any((ratios > limit / 10) & (ratios < limit * 10))) for limit in (1e-9, 1e-6))
