"""The second derivation against the literal reference, relative to the natural scale of every quantity."""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from mahovik.contract.functions import wants_of, wants_of_carrier
from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.proof.second import Second
from mahovik.proof.verify.check import difference
from mahovik.proof.verify.scales import Scales

WANTS = tuple(want for want in wants_of("second") if want in wants_of_carrier(held=False))

NOT_THERE = ("I0", "J0")  # of `generalized`: matrices of (11), that the second derivation does not form

# what verify asks of every backend; the largest seen is 2e-14, of the solve in `coupled`
AGREEMENT = 1e-12

Expected = dict[str, tuple[dict[str, Any], dict[str, Any]] | None]
"""Results and natural scales by want; None: refused."""


second_of = lru_cache(maxsize=8)(Second)
"""The second derivation of a stand; its functions are kept for the last few stands."""


def evaluate(stand: Stand, state: State, want: Sequence[str]) -> dict[str, Any]:
    """Answers of the second derivation."""
    return second_of(stand).evaluate(state, want)


def expectations(stand: Stand, state: State, wants: Sequence[str] = WANTS) -> Expected:
    """want -> what the reference gives and its natural scales; None where it refuses."""
    answers: Expected = {}
    scales = Scales(stand)
    for want in wants:
        measured = scales.want(state, want)
        answers[want] = None if measured is None else (measured.values, dict(measured.scales))
    return answers


def differences(
    evaluate: Callable[[State, Sequence[str]], dict[str, Any]], state: State, expected: Expected
) -> dict[tuple[str, str], float]:
    """(want, quantity) -> largest difference over natural scale, of all that the reference gives at this state.

    `evaluate(state, want)`. Refusing what the reference evaluates is an infinite difference, and the other way round.
    """
    worst: dict[tuple[str, str], float] = {}
    for want, wanted in expected.items():
        values = attempt(evaluate, state, want)
        if wanted is None and values is None:
            continue
        if wanted is None or values is None:
            worst[want, "refused"] = np.inf
            continue
        for name, value in wanted[0].items():
            if name not in NOT_THERE:
                off, _ = difference(values.get(name), value, wanted[1][name])
                worst[want, name] = np.inf if np.isnan(off) else off
    return worst


def worst_difference(stand: Stand, state: State, *evaluates: Callable[[State, Sequence[str]], dict[str, Any]]) -> float:
    """Largest difference over natural scale between the literal reference and any of these, at one state."""
    expected = expectations(stand, state)
    return max(max(differences(evaluate, state, expected).values()) for evaluate in evaluates)


def attempt(
    evaluate: Callable[[State, Sequence[str]], dict[str, Any]], state: State, want: str
) -> dict[str, Any] | None:
    """Answer of `evaluate`; None where it refuses."""
    try:
        with np.errstate(all="ignore"):
            return evaluate(state, [want])
    except StateError:
        return None
