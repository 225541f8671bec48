"""Three ways on stands that nobody chose, and on the example stands: compiled C, reference, second derivation."""

from __future__ import annotations

import pytest
from random_stands import WHAT_MATTERS, random_stands, verify_random

from mahovik.core.stand import Stand, load
from mahovik.proof.verify.report import conclusion
from mahovik.stands import names, path

STANDS = (*random_stands(WHAT_MATTERS), *(load(path(name)) for name in names()))
STATES = 13  # at rest, four of the extreme kinds, ordinary ones with and without run-time wrenches

BOTH = {("momentum", "energy"), ("forward", "V_dot"), ("coupled", "V_dot")}


def test_the_counts_that_matter_are_there() -> None:
    assert [len(stand.flywheels) for stand in STANDS[:WHAT_MATTERS]] == [0, 1, 5, 6, 7, 12, 64]
    assert {stand.angles for stand in STANDS} == {"ship", "aircraft", "euler"}
    assert any(stand.stream for stand in STANDS)
    assert any(s.mount != "carrier" for stand in STANDS for s in stand.flywheels)


QUICK = 2
"""Number of stands tried in `make test`; `make test-slow` tries all of them."""


@pytest.mark.parametrize(
    "stand",
    [*STANDS[:QUICK], *(pytest.param(stand, marks=pytest.mark.slow) for stand in STANDS[QUICK:])],
    ids=lambda stand: f"{stand.name}, {len(stand.flywheels)}",
)
def test_three_ways_agree(stand: Stand) -> None:
    found = verify_random(stand, STATES)
    assert found.passed, conclusion(found)
    three = {(row.want, row.quantity): row for row in found.rows if row.second is not None}
    assert set(three) >= BOTH
    assert (("torque", "tau") in three) == bool(stand.flywheels)
    assert (("points", "points") in three) == bool(stand.points or stand.instruments)
    assert all(row.states and row.between is not None for row in three.values())
    if stand.flywheels:
        assert {"phi_ddot", "residual"} <= {row.quantity for row in found.rows if row.want == "inverse"}


def test_the_campaign_is_the_same_every_time_and_each_stand_another() -> None:
    assert [*random_stands(4)] == [*random_stands(12)][:4]
    assert len(set(random_stands(12))) == 12
