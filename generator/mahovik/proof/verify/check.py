"""A check: one quantity of what is judged, its largest difference against a limit, and the verdict."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from mahovik.proof.verify.states import Request

FLOOR = 1e-290
"""Least scale of a difference: below it products of inputs are subnormal and have lost their digits."""

MOST_SKIPPED = 0.02
"""Part of the states of a check that may be left out, since no answer is right there or rounding decides it."""


@dataclass
class Check:
    """Largest difference of one quantity over all states at which it was compared, and its limit.

    judged        public function, want, program, judge or item that the quantity belongs to; "" of the whole
    limit         accepted `value`; 0 where only equality is right
    value         largest difference, a share of a scale unless the quantity says otherwise; inf: missing or refused
    verdict       ok, FAILED, "not compared"; of a program also "not offered", MISSING
    words         what there is to say: where `value` was largest, or why nothing was compared
    states        how often it was compared; `skipped`: how often it was not, see MOST_SKIPPED
    state         name of the state where the difference was largest for its limit; `request`: what `eval` takes
    second        largest difference of the second derivation from the reference; None where it has no such quantity
    second_limit  accepted `second`; None: as `limit`
    """

    judged: str
    quantity: str
    limit: float = 0.0
    value: float = 0.0
    verdict: str = "not compared"
    words: str = ""
    states: int = 0
    skipped: int = 0
    state: str = ""
    request: Request | None = None
    second: float | None = None
    second_limit: float | None = None
    floor: float = FLOOR

    @classmethod
    def of(cls, quantity: str, value: float, limit: float, words: str = "") -> Check:
        """A check of one value, with words about it whatever the verdict."""
        made = cls("", quantity, limit)
        made.note(float(value), words=words)
        return made

    @property
    def failed(self) -> bool:
        """Whether this check makes the whole verification fail."""
        return self.verdict not in ("ok", "not offered", "not compared")

    @property
    def share(self) -> float:
        """The larger of both differences over its limit; above 1 the check fails."""
        return max(_share(self.value, self.limit), _share(self.second or 0.0, self.accepted_of_second))

    @property
    def accepted_of_second(self) -> float:
        """Limit of `second`."""
        return self.limit if self.second_limit is None else self.second_limit

    def note(
        self,
        value: float,
        state: str = "",
        words: str = "",
        request: Request | None = None,
        second: float | None = None,
    ) -> None:
        """Count one state with its difference; state, words and request are kept where it is largest for the limit."""
        share = max(_share(value, self.limit), _share(second or 0.0, self.accepted_of_second))
        if not self.states or share > self.share:
            self.state, self.words, self.request = state, words, request
        self.states += 1
        self.value = max(self.value, math.inf if math.isnan(value) else value)
        if second is not None:
            self.second = max(self.second or 0.0, second)
        self._decide()

    def compare(self, found: Any, expected: Any, scale: Any, state: str = "") -> None:
        """Count one state: |found - expected| over the scale; equal values are demanded where the scale is None."""
        off, words = difference(found, expected, scale, self.floor)
        self.note(off, state, words)

    def demand(self, right: bool, state: str = "", words: str = "") -> None:
        """Count one state that is right or wrong, for the reason in `words`."""
        self.note(0.0 if right else math.inf, state, "" if right else words)

    def refuse(self, error: Exception, state: str = "") -> None:
        """Count a state that what is judged refused, though it has an answer."""
        self.note(math.inf, state, str(error))

    def skip(self, words: str, state: str = "") -> None:
        """Leave a state out."""
        self.skipped += 1
        if not self.states:
            self.state, self.words = state, words
        self._decide()
        if self.failed and self.share <= 1:
            self.state, self.words = state, f"{self.skipped} of {self.states + self.skipped} states left out: {words}"

    def _decide(self) -> None:
        if self.states:
            few = self.skipped <= MOST_SKIPPED * (self.states + self.skipped)
            self.verdict = "ok" if self.share <= 1 and few else "FAILED"


def _share(value: float, limit: float) -> float:
    if value == 0.0:
        return 0.0
    return value / limit if limit else math.inf


def difference(found: Any, expected: Any, scale: Any, floor: float = FLOOR) -> tuple[float, str]:
    """Largest |found - expected| / scale over the components, and a reason if the values cannot be compared."""
    if found is None:
        return math.inf, "missing"
    if isinstance(expected, dict):
        return _of_parts(found, expected, scale, floor)
    if scale is None:
        same = np.asarray(found).tolist() == np.asarray(expected).tolist()
        return (0.0, "") if same else (math.inf, f"{found} where the reference has {expected}")
    try:
        numbers = np.array(found, dtype=np.float64)
    except (ValueError, TypeError, OverflowError):
        return math.inf, "no array of numbers"
    wanted = np.asarray(expected, dtype=np.float64)
    if not numbers.size and not wanted.size:
        return 0.0, ""  # an empty list in JSON has no second length
    if numbers.shape != wanted.shape:
        return math.inf, f"shape {list(numbers.shape)}, expected {list(wanted.shape)}"
    if not np.isfinite(numbers).all():
        return math.inf, "not finite"
    with np.errstate(over="ignore"):
        relative = np.abs(numbers - wanted) / np.maximum(scale, floor)
    return float(relative.max()), ""


def _of_parts(found: Any, expected: dict[str, Any], scale: Any, floor: float) -> tuple[float, str]:
    """Difference of the worst part of a nested object, and its words with the name of the part."""
    if not isinstance(found, Mapping):
        return math.inf, "no object"
    worst, words = 0.0, ""
    for name, value in expected.items():
        off, reason = difference(found.get(name), value, scale[name], floor)
        if off > worst:
            worst, words = off, f"{name}: {reason}" if reason else name
    return worst, words
