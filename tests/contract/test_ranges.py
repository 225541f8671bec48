"""Ranges and statuses that the evaluation contract promises, written out: the data cannot drift from them unseen."""

from __future__ import annotations

import pytest

from mahovik.contract.quantities import QUANTITIES, SINGULAR_BELOW, UNIT_LENGTH
from mahovik.contract.status import STATUS_VALUES, status_words

PROMISED = {
    "position": (1e6,),
    "angles": (1e7,),
    "V": (1e4, 1e4, 1e4, 1e5, 1e5, 1e5),
    "phi": (1e7,),
    "phi_dot": (1e5,),
    "phi_ddot": (1e9,),
    "V_dot": (1e9,),
    "tau": (1e9,),
    "wrench": (1e9,),
}
"""Largest magnitudes in double, SI."""

PROMISED_IN_FLOAT = PROMISED | {"angles": (1e3,), "phi": (1e3,)}


@pytest.mark.parametrize(("real", "promised"), [("double", PROMISED), ("float", PROMISED_IN_FLOAT)])
def test_ranges_are_those_promised(real: str, promised: dict[str, tuple[float, ...]]) -> None:
    assert {row.symbol: row.limits(real) for row in QUANTITIES.values() if row.input} == promised


def test_lengths_and_angles_are_those_promised() -> None:
    assert (UNIT_LENGTH, SINGULAR_BELOW) == (1e-3, 1e-6)


def test_statuses_are_those_promised() -> None:
    assert STATUS_VALUES == {
        "OK": 0,
        "NEAR_SINGULAR": 1,
        "DAMPED": 2,
        "LIMITED": 4,
        "UNREACHABLE": 8,
        "RANK_DEFICIENT": 16,
        "COARSE": 32,
        "EXCESSIVE": 64,
        "NOT_FINITE": -1,
        "RANGE": -2,
        "NOT_POSITIVE_DEFINITE": -3,
        "SINGULAR_ATTITUDE": -4,
        "BAD_ARGUMENT": -5,
    }
    assert status_words(0) == "OK"
    assert status_words(-2) == "RANGE"
    assert status_words(21) == "NEAR_SINGULAR|LIMITED|RANK_DEFICIENT"
