"""docs/results/judges.md: all judges agree with the C, where their models are exact."""

from __future__ import annotations

from typing import Any

import judges_table as written

from mahovik.proof.verify.judges.compare import ALL, JUDGES, MOTION
from mahovik.stands import names

FOUND = written.CAMPAIGN.figures()
Rows = list[dict[str, Any]]


def check_numbers(rows: Rows, words: tuple[str, ...]) -> None:
    """Every quantity, every stand; none for a stand without points."""
    assert [row["quantity"] for row in rows] == list(words)
    for row in rows:
        assert list(row) == ["quantity", *names()]
        given = [row[name] for name in names() if row[name] is not None]
        assert given, row
        assert all(0.0 < number <= 1e-10 for number in given), row


def test_every_judge_agrees_on_every_quantity() -> None:
    assert [version.rpartition(" ")[0] for version in FOUND["versions"]] == list(ALL)
    assert len(FOUND["judges"]) == len(JUDGES)
    for rows in FOUND["judges"]:
        check_numbers(rows, written.WORDS)


def test_basilisk_where_it_is_exact_and_where_not() -> None:
    check_numbers(FOUND["basilisk"], written.ITS_WORDS)
    check_numbers(FOUND["rotors"], written.ITS_WORDS)
    assert (FOUND["equal"], FOUND["balanced"]) == (["demo3", "shaker2"], ["demo3"])
    check_difference(FOUND["asymmetric"], FOUND["equal"], 1e-6)
    check_difference(FOUND["simple"], FOUND["balanced"], 1e-8)


def check_difference(rows: Rows, exact: list[str], least: float) -> None:
    """The motion differs by at least that on every stand but those where the model is exact."""
    (motion,) = [row for row in rows if row["quantity"] == MOTION]
    for name in names():
        assert (motion[name] <= 1e-10) if name in exact else (motion[name] >= least), name


def test_the_short_table_has_the_worst_of_all_stands() -> None:
    line = next(line for line in written.short(FOUND).splitlines() if line.startswith("| bias forces"))
    of_first = next(row for row in FOUND["judges"][0] if row["quantity"] == "bias forces")
    assert f"| {max(of_first[name] for name in names()):.0e} |" in line
