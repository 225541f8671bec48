"""docs/results/linear.md and response.md have figures that agree; their numbers are the code's."""

from __future__ import annotations

import linear_campaign as written
import pytest

from docs.pages import ROOT
from mahovik.use.study.response.periodic import KINKED_TAIL, TAIL, UNSTABLE
from mahovik.use.study.response.speeds import EXACT, MOST_TURNS


def test_linear_models_agree() -> None:
    found = written.LINEAR_CAMPAIGN.figures()
    assert found["accepted"] == written.AGREEMENT == 1e-10
    assert [row["flywheels"] for row in found["rows"]] == list(written.FLYWHEELS)
    assert sum(row["stands"] for row in found["rows"]) == 200
    assert all(row[name] <= 1e-10 for row in found["rows"] for name in "ABCD")


def test_steady_states_are_those_of_simulation() -> None:
    found = written.RESPONSE_CAMPAIGN.figures()
    assert found["accepted"] == written.EQUAL == 1e-6
    assert [row["stand"] for row in found["rows"]] == [course.stand for course in written.COURSES]
    assert all(row["apart"] <= 1e-6 for row in found["rows"])


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (EXACT, "to {:.0e}, and the period"),
        (MOST_TURNS, "up to {} turns"),
        (TAIL, "no more than {:.0e} of"),
        (KINKED_TAIL, "({:.0e} with"),
        (1 + UNSTABLE, "above {} a warning"),
    ],
)
def test_numbers_are_those_of_the_code(value: float, words: str) -> None:
    page = " ".join((ROOT / "docs" / "studies.md").read_text(encoding="utf-8").split())
    assert words.format(value).replace("1e-0", "1e-") in page
