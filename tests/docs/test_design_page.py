"""docs/design.md: keys are the reader's, the file is read; docs/results/design.md has the campaign's table."""

from __future__ import annotations

import re

import design_campaign as tool
import pytest

from docs.pages import ROOT, blocks, cells, tables
from mahovik import stands
from mahovik.core.stand import load
from mahovik.use.design import read
from mahovik.use.design.freedom import PARTS

PAGE = ROOT / "docs" / "design.md"


def keys(first: str) -> set[str]:
    """Keys in the first column of the table whose head begins with `first`."""
    (found,) = (lines for lines in tables(PAGE) if cells(lines[0])[0] == first)
    return {name for line in found[2:] for name in re.findall(r"`([^`]+)`", cells(line)[0])}


def test_the_file_is_read_and_all_keys_are_told() -> None:
    (example,) = (block for block in blocks(PAGE) if block.language == "toml" and not block.file)
    found = read.read_freedom(example.text, load(stands.path("shaker2")))
    assert found.number == (1, 2)
    assert found.ties[0].mirror == "y"
    assert keys("key of `[[free]]`") == set(PARTS)
    assert keys("other key") | {"free"} == set(read.FreedomTable.model_fields)


def test_the_figures_have_the_rows_of_the_campaign() -> None:
    """Eight of ten and more, within what was asked and the time."""
    rows = tool.CAMPAIGN.figures()["rows"]
    assert [(row["motion"], row["flywheels"], row["relative residual asked"]) for row in rows] == [
        (r.name, r.N, r.quality) for r in tool.ROWS
    ]
    for row in rows:
        some, of = row["found"]
        assert some >= 0.8 * of
        assert row["median residual"] <= row["worst"] <= row["relative residual asked"]
        assert row["median, s"] <= row["longest, s"]


@pytest.mark.slow
def test_a_small_sample_of_the_campaign() -> None:
    """One axis with two flywheels, exact."""
    found, seconds = tool.outcome(tool.ROWS[0], 31)
    assert found.status == "OK"
    assert tool.good(tool.ROWS[0], found, seconds)
