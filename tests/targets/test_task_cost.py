"""A task of three rows costs much less than all six."""

from __future__ import annotations

import pytest

from mahovik.core.stand import load
from mahovik.proof.cost.measure import measure
from mahovik.stands import path
from targets.boards import target


@pytest.mark.slow
@pytest.mark.parametrize(("name", "real"), [("m7", "double"), ("m4", "float")])
def test_pointing_takes_at_most_three_fifths_of_the_instructions(name: str, real: str) -> None:
    (found,) = measure(load(path("sat4")), [(target(name), real)]).targets
    cost = {f.function: f.instructions for f in found.functions}
    assert 0 < cost["inverse_pointing"] <= 0.6 * cost["inverse"]
    assert cost["inverse_fast_pointing"] > 0
    if cost["inverse_fast"]:  # float refuses the six rows of sat4 without damping
        assert cost["inverse_fast_pointing"] <= 0.6 * cost["inverse_fast"]
