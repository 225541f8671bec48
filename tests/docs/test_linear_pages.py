"""docs/results/linear.md and response.md hold what tools/linear_campaign.py writes; their numbers are the code's."""

from __future__ import annotations

import linear_campaign as written
import pytest

from docs.pages import ROOT, cells
from mahovik.use.study.response.periodic import KINKED_TAIL, TAIL, UNSTABLE
from mahovik.use.study.response.speeds import EXACT, MOST_TURNS


def rows(name: str) -> tuple[str, list[list[str]]]:
    """What the tool wrote on a page, and the rows of its table."""
    text = written.BLOCKS[name].text()
    return text, [cells(line) for line in text.splitlines() if line.startswith("|")][2:]


def test_linear_models_agree() -> None:
    text, found = rows("linear")
    assert "accepted is 1e-10" in text
    assert [row[0] for row in found] == [str(N) for N in written.FLYWHEELS]
    assert sum(int(row[1]) for row in found) == 200
    assert all(float(number) <= 1e-10 for row in found for number in row[2:])


def test_steady_states_are_those_of_simulation() -> None:
    text, found = rows("response")
    assert "accepted is 1e-06" in text
    assert [row[0] for row in found] == [course.stand for course in written.COURSES]
    assert all(float(row[4]) <= 1e-6 for row in found)


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
