"""Three ways on stands that nobody chose, and on the example stands: compiled C, reference, second derivation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from random_stands import COUNTS, FLOW_FROM, WHAT_MATTERS, random_stands, verify_random

from mahovik.core.stand import Stand, dumps, load, loads
from mahovik.core.stand.random import Features, random_stand
from mahovik.laws.control.data import ControlDerivatives
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.laws.fading.data import FadingDamping
from mahovik.laws.fin.data import Fins
from mahovik.laws.propeller.data import Propellers
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
"""Number of stands tried in `make test`; `make test-all` tries all of them."""


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


FLOWING = [*random_stands(FLOW_FROM + len(COUNTS))][FLOW_FROM:]
LATER_LAWS = (CrossFlow, Fins, Propellers, FadingDamping, ControlDerivatives)


def test_stands_after_those_of_kept_results_have_every_law_of_fluid() -> None:
    """Their files come back, so their numbers are possible ones; what else is drawn is drawn as without."""
    for stand in FLOWING:
        assert all(stand.carrier.law(law) is not None for law in LATER_LAWS)
        assert dumps(loads(dumps(stand))) == dumps(stand)
    assert {law for stand in FLOWING for body in stand.flywheels for law in map(type, body.laws)} >= {
        CrossFlow, FadingDamping
    }  # fmt: skip
    features = Features(instruments=1)
    plain = random_stand(np.random.default_rng(3), 2, features)
    flowing = random_stand(np.random.default_rng(3), 2, replace(features, flow=True))
    bodies = zip(plain.bodies, flowing.bodies, strict=True)
    assert all(body.without_laws(*LATER_LAWS) == before for before, body in bodies)
    assert not any(body.law(law) for body in plain.bodies for law in LATER_LAWS)


@pytest.mark.slow
@pytest.mark.parametrize("stand", FLOWING, ids=lambda stand: f"{stand.name}, {len(stand.flywheels)}")
def test_three_ways_agree_in_a_flow(stand: Stand) -> None:
    found = verify_random(stand, STATES)
    assert found.passed, conclusion(found)
