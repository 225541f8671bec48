"""docs/planning.md: its tables are those of the campaign and of the refusals; nothing was found that cannot be."""

from __future__ import annotations

import re

import plan_campaign as tool
import pytest
import refusal_campaign as refusals

from docs.pages import cells
from mahovik.core.motion.required.course import Harmonics


def test_the_table_has_the_rows_of_the_campaign() -> None:
    """In order; at most all stands are found; medians do not exceed the longest."""
    text = tool.BLOCK.text()
    rows = [cells(line) for line in text.splitlines() if re.match(r"\| \d", line)]
    assert [(int(row[0]), row[1]) for row in rows] == [(row.N, row.name) for row in tool.ROWS]
    for _, _, found, median, longest, _ in rows:
        some, of = map(int, found.split(" of "))
        assert 0 < some <= of
        assert float(median) <= float(longest)
    assert "verification, which refused 0." in " ".join(text.split())


def test_every_kind_of_refusal_was_put_before_a_search() -> None:
    """All are refused, none is found."""
    text = refusals.BLOCK.text()
    rows = [cells(line) for line in text.splitlines() if line.startswith("| `")]
    assert [row[0].strip("`") for row in rows] == list(refusals.KINDS)
    for _, _, refused, found, _ in rows:
        some, of = map(int, refused.split(" of "))
        assert some == of > 0
        assert found == "0"


def test_stands_and_motions_are_the_same_for_the_same_seed() -> None:
    """And differ with it; they are what the page says."""
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
