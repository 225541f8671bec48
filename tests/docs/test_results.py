"""Pages of docs/results are rendered from the kept figures beside them."""

from __future__ import annotations

import json
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest
from kept import Campaign, Columns, Result, plain
from results import TOOLS, campaigns

from docs.pages import ROOT, prose

FOLDER = ROOT / "docs" / "results"
CAMPAIGNS = list(campaigns())
COMMAND = "run `python tools/results.py`: it renders all pages from their figures"

NO_FIGURES = {"index.md"}
"""Pages of docs/results without figures."""

every = pytest.mark.parametrize("each", CAMPAIGNS, ids=lambda each: each.name)


@every
def test_pages_are_what_their_figures_say(each: Campaign) -> None:
    assert each.block.text() == each.text().strip("\n"), COMMAND
    for block, page in each.also:
        assert block.text() == page(each.figures()).strip("\n"), COMMAND


def test_every_page_has_kept_figures() -> None:
    pages = {path.name for path in FOLDER.glob("*.md")}
    assert pages == {Path(each.block.page).name for each in CAMPAIGNS} | NO_FIGURES
    assert {path.stem for path in FOLDER.glob("*.json")} == {each.name for each in CAMPAIGNS}


@pytest.mark.parametrize("page", sorted(FOLDER.glob("*.md")), ids=lambda page: page.name)
def test_tables_stand_in_what_is_rendered(page: Path) -> None:
    """A table outside of the marks would be typed."""
    text = prose(page)
    for each in CAMPAIGNS:
        if each.block.path == page:
            text = text.replace(each.block.text(), "")
    assert [line for line in text.splitlines() if line.startswith("|")] == []


@every
def test_the_command_is_one_of_the_tools(each: Campaign) -> None:
    words = each.result().command.split()
    assert words[0] == "python"
    assert words[1] == "-m" or (ROOT / words[1]).is_file()


def test_a_changed_figure_changes_the_page() -> None:
    """Every number of the tables of a kept file is shown."""
    campaign = CAMPAIGNS[0]
    figures = campaign.figures()
    figures["rows"][1]["C - reference"] *= 3.0
    assert campaign.page(figures) != campaign.page(campaign.figures())


def test_the_line_on_top_says_how_it_was_measured() -> None:
    campaign = CAMPAIGNS[0]
    result = replace(campaign.result(), command="python x.py", commit="0123abcd", date="2026-01-02", processor="A 1")
    assert "`python x.py`" in campaign.provenance(result)
    assert "Measured 2026-01-02, commit 0123abcd, A 1." in campaign.provenance(result)


def test_files_are_read_as_they_are_written() -> None:
    result = Result(
        "python tools/x.py",
        3,
        "0",
        "2026-01-02",
        "",
        plain({"rows": [{"a": (1, 2.5), "b": None}], "most": float("nan")}),
    )
    assert json.loads(result.text()) == vars(result)
    assert result.figures == {"rows": [{"a": [1, 2.5], "b": None}], "most": None}


def test_cells() -> None:
    table = Columns({"name": "`{}`", "found": "{} of {}", "error": "{:.0e}", "least": lambda x: f"<{x}>"})
    (row,) = table.rows([("a", (3, 4), 2e-9, 5)])
    assert table.line(row) == ["`a`", "3 of 4", "2e-09", "<5>"]
    assert table.line({**row, "found": None})[1] == ""


def test_every_tool_holds_a_campaign() -> None:
    assert {Path(vars(import_module(tool))["__file__"]).parent.name for tool in TOOLS} == {"tools"}
    assert [t for t in TOOLS if not any(isinstance(x, Campaign) for x in vars(import_module(t)).values())] == []
    assert len({each.name for each in CAMPAIGNS}) == len(CAMPAIGNS) >= len(TOOLS)
