"""docs/results/planning.md: its figures have all rows of the campaign; nothing was found that cannot be."""

from __future__ import annotations

import plan_campaign as tool
import pytest
import refusal_campaign as refusals

from mahovik.core.motion.required.course import Harmonics


def test_the_figures_have_the_rows_of_the_campaign() -> None:
    """In order; at most all stands are found; medians do not exceed the longest; the verification refused none."""
    found = tool.CAMPAIGN.figures()
    assert [(row["flywheels"], row["motion, windings"]) for row in found["rows"]] == [(r.N, r.name) for r in tool.ROWS]
    for row in found["rows"]:
        some, of = row["found"]
        assert 0 < some <= of == found["stands"]
        assert row["median, s"] <= row["longest, s"]
    assert found["refused"] == 0


def test_every_kind_of_refusal_was_put_before_a_search() -> None:
    """All are refused, none is found."""
    found = refusals.CAMPAIGN.figures()
    assert [row["refusal"] for row in found["rows"]] == list(refusals.KINDS)
    for row in found["rows"]:
        assert row["refused"] == [found["stands"]] * 2
        assert row["found by a search"] == 0


def test_stands_and_motions_are_the_same_for_the_same_seed() -> None:
    """Another seed gives others; they are those that the page describes."""
    row = tool.ROWS[0]
    (stand, motion), (again, _), (other, _) = (row.problem(seed) for seed in (1, 1, 2))
    assert stand == again
    assert stand != other
    assert stand.carrier.mass == 12.0
    assert all(0.5 <= wheel.mass <= 1.2 for wheel in stand.flywheels)
    assert motion.harmonics == (1,)
    assert isinstance(motion.course, Harmonics)
    assert abs(motion.course.cos[:, 5]).max() == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("number", [0, 3], ids=["6 rock", "8 spin"])
def test_a_small_sample_of_the_campaign(number: int) -> None:
    """A stand of a row has a programme that the verification accepts."""
    found = tool.outcome(tool.ROWS[number], 31, 60.0, verify=True)
    assert (found.status, found.wrong) == ("OK", "")


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["MEAN_WRENCH", "SPAN", "FIRST_MOMENT", "BOUND_REACH"])
def test_a_small_sample_of_the_refusals(kind: str) -> None:
    """Refused for this reason, and not found."""
    assert refusals.outcome(5.0, kind, 31)[:2] == (True, False)
