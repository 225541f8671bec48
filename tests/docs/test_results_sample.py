"""A sample of the kept figures of docs/results is measured again; each must be inside its spread."""

from __future__ import annotations

import os
from random import Random

import pytest
from kept import Campaign
from results import campaigns

SEED = os.environ.get("MAHOVIK_SAMPLE_SEED", "18")
"""Another seed samples other figures."""


@pytest.mark.slow
@pytest.mark.parametrize("each", [each for each in campaigns() if each.sample], ids=lambda each: each.name)
def test_a_sample_is_measured_again(each: Campaign) -> None:
    assert each.sample is not None
    found = list(each.sample(each.figures(), Random(f"{SEED} {each.name}")))
    assert found
    assert [measured for measured in found if not measured.good] == []
