"""README and docs/results/judges.md hold the tables of tools/judges_table.py; their numbers are the judges'."""

from __future__ import annotations

import re

import campaign
import judges_table as written

from docs.pages import ROOT, cells
from mahovik.proof.verify.judges.compare import ALL, JUDGES, MOTION
from mahovik.stands import names


def lines_of(text: str) -> list[list[str]]:
    return [cells(line) for line in text.splitlines() if line.startswith("|")]


def check_numbers(rows: list[list[str]]) -> None:
    for row in rows:
        given = [number for number in row[1:] if number]  # none for a stand without points
        assert given, row
        assert all(re.fullmatch(r"\de[+-]\d\d", number) for number in given), row
        assert all(float(number) <= 1e-10 for number in given), row


def test_the_table_of_the_readme() -> None:
    text = written.BLOCK.text()
    head, _, *rows = lines_of(text)
    assert head[0] == "generated C against"
    assert [name.split()[0] for name in head[1:]] == list(ALL)
    assert [row[0] for row in rows] == list(written.WORDS)
    check_numbers(rows)
    assert text.strip() + "\n" == campaign.table(head, rows) + "\n" + written.NOTE


def test_the_page() -> None:
    page = (ROOT / "docs" / "results" / "judges.md").read_text(encoding="utf-8")
    for judge, part in zip(JUDGES, page.split("\n## ")[1:-1], strict=True):
        assert part.startswith(judge)
        head, _, *rows = lines_of(part)
        assert head == ["quantity", *names()]
        assert [row[0] for row in rows] == list(written.WORDS)
        check_numbers(rows)


def test_basilisk_where_it_is_exact_and_where_not() -> None:
    page = (ROOT / "docs" / "results" / "judges.md").read_text(encoding="utf-8")
    part = page.split("\n## ")[-1]
    assert part.startswith("basilisk")
    exact, _, off = part.partition("### Where its model is not exact")
    head, _, *rows = lines_of(exact)
    assert head == ["quantity", *names()]
    assert [row[0] for row in rows] == list(written.ITS_WORDS)
    check_numbers(rows)
    asymmetric, simple = (lines_of(text) for text in off.split("**Unbalance as a force"))
    check_difference(asymmetric, {"demo3", "shaker2"}, 1e-6)
    check_difference(simple, {"demo3"}, 1e-8)
    assert "as in `demo3`, `shaker2`, the model" in off.replace("\n", " ")
    assert "as in `demo3`, the model" in off.replace("\n", " ")


def check_difference(table: list[list[str]], exact: set[str], least: float) -> None:
    """The motion differs by at least that on every stand but those where the model is exact."""
    head, *rows = table
    (motion,) = [row for row in rows if row[0] == MOTION]
    for name, number in zip(head[1:], motion[1:], strict=True):
        assert (float(number) <= 1e-10) if name in exact else (float(number) >= least), name
