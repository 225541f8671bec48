"""Quantities that are wrong by one constant factor at all states, such as those with the wrong sign or unit."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.proof.diagnose.answer_vector import AnswerVector
from mahovik.proof.reference.array import Array

LEAST_NUMBERS = 5
"""Numbers beyond rounding that must have the factor: of one number any factor explains any error."""

SAME = 1e-5
"""Relative difference within which factors are equal; constants of units are often written with six digits."""

UNITS = {
    math.pi / 180: "pi/180, degrees in place of radians",
    180 / math.pi: "180/pi, degrees in place of radians",
    math.pi / 30: "pi/30, revolutions a minute in place of rad/s",
    30 / math.pi: "30/pi, revolutions a minute in place of rad/s",
}
"""Factors between units, in words."""


@dataclass(frozen=True)
class WholeFactor:
    """Quantities that are the right ones times a factor, in all components and at all states, in some wants."""

    quantities: tuple[str, ...]
    wants: tuple[str, ...]
    factor: float

    @property
    def is_plain(self) -> bool:
        """Whether the factor is a sign or one between units, which no wrong quantity of the stand gives."""
        return self.factor == 0.0 or _is(self.factor, -1.0) or any(_is(abs(self.factor), each) for each in UNITS)

    def sentence(self) -> str:
        """The factor in a line."""
        many = len(self.quantities) > 1
        if self.factor == 0.0:
            what = f"{'are' if many else 'is'} zero at every state"
        elif _is(self.factor, -1.0):
            what = f"{'have' if many else 'has'} the wrong sign throughout"
        else:
            unit = next((f" ({words})" for each, words in UNITS.items() if _is(abs(self.factor), each)), "")
            what = f"{'are' if many else 'is'} {self.factor:.6g} times the right value throughout{unit}"
        return f"{join(self.quantities)} {what}, in {join(self.wants)}"


def whole_factors(vector: AnswerVector, found: Array, wrong: Sequence[str], noise: Array) -> tuple[WholeFactor, ...]:
    """The factors that explain all of the `wrong` quantities, as want: quantity, to rounding; none if one has none.

    `found`: numbers of the vector, NaN where missing; `noise`: rounding of each, in units of its scale.
    """
    by_quantity: dict[str, list[tuple[str, float]]] = {}
    answered, right = vector.over_scale(found), vector.over_scale(vector.expected)
    for block, (want, quantity) in enumerate(vector.quantities):
        if f"{want}: {quantity}" not in wrong:
            continue
        there = (vector.block == block) & np.isfinite(answered)
        factor = _factor(answered[there], right[there], noise[there])
        if factor is None:
            return ()
        by_quantity.setdefault(quantity, []).append((want, factor))
    groups: list[WholeFactor] = []
    for quantity, each in by_quantity.items():
        for factor in _distinct([c for _, c in each]):
            wants = tuple(want for want, c in each if _is(c, factor))
            same = [x for x in groups if x.wants == wants and _is(x.factor, factor)]
            if same:
                groups[groups.index(same[0])] = WholeFactor((*same[0].quantities, quantity), wants, same[0].factor)
            else:
                groups.append(WholeFactor((quantity,), wants, factor))
    return tuple(groups)


def _factor(answered: Array, right: Array, noise: Array) -> float | None:
    """The factor by which all numbers differ from the right ones, in units of their scales; None: there is no one."""
    if np.count_nonzero(np.abs(right) > noise) < LEAST_NUMBERS:
        return None
    if (np.abs(answered) <= noise).all():
        return 0.0
    factor = float(answered @ right) / float(right @ right)
    left = np.abs(answered - factor * right)
    return factor if bool((left <= noise * (1.0 + abs(factor))).all()) else None


def _distinct(factors: Sequence[float]) -> list[float]:
    kept: list[float] = []
    for each in factors:
        if not any(_is(each, other) for other in kept):
            kept.append(each)
    return kept


def _is(factor: float, other: float) -> bool:
    return abs(factor - other) <= SAME * abs(other)


def join(names: Sequence[str]) -> str:
    """`a, b and c`."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
