"""Pages of docs/results are rendered from the kept figures beside them, and say rightly by which code these are."""

from __future__ import annotations

import ast
import json
from dataclasses import replace
from importlib import import_module
from pathlib import Path

import code_hash
import pytest
from kept import NOT_SAMPLED, UNKNOWN, Campaign, Columns, Measured, Result, plain
from results import TOOLS, campaigns

from docs.pages import ROOT, prose

FOLDER = ROOT / "docs" / "results"
CAMPAIGNS = list(campaigns())
COMMAND = "run `python tools/results.py`: it renders all pages from their figures, and marks what older code measured"

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


def test_what_is_not_measured_again_says_why() -> None:
    assert {each.name for each in CAMPAIGNS if each.sample is None} == set(NOT_SAMPLED)


@every
def test_code_that_a_campaign_imports_is_declared(each: Campaign) -> None:
    """Whatever its tools import of the package is in the hash."""
    files = code_hash.files_of((*code_hash.COMMON, *each.code))
    tools = [path for path in files if path.parent.name in ("tools", "mahovik_bench") and path.suffix == ".py"]
    assert tools
    for tool in tools:
        for module in _imported(tool):
            place = ROOT / "generator" / Path(*module.split("."))
            source = place / "__init__.py" if place.is_dir() else place.with_suffix(".py")
            assert source in files or not source.is_file() or module == "mahovik", (tool.name, module)


def _imported(tool: Path) -> set[str]:
    tree = ast.parse(tool.read_text(encoding="utf-8"))
    return {
        node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module is not None
        and node.module.startswith("mahovik.") and node.module != "mahovik.__main__"
    }  # fmt: skip


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


def test_the_mark_says_which_code() -> None:
    campaign = CAMPAIGNS[0]
    now = replace(campaign.result(), code=code_hash.code_hash(campaign.code))
    assert "as it is now" in campaign.provenance(now)
    assert "older code (0123abcd)" in campaign.provenance(replace(now, code="0123abcd" * 2))
    assert "**Measured with older code**" in campaign.provenance(replace(now, code=UNKNOWN))


def test_the_hash_follows_the_code_and_not_its_words() -> None:
    first = 'def f(x):\n    """Twice."""\n    return 2 * x\n'
    other = 'def f(x):\n\n    """Two times\n    x."""\n    return 2 * x  # twice\n'
    assert code_hash.meaning(first) == code_hash.meaning(other)
    assert code_hash.meaning(first) != code_hash.meaning(first.replace("2", "3"))
    assert code_hash.meaning('x = "# a"') != code_hash.meaning('x = "# b"')


def test_the_hash_sees_every_file() -> None:
    before = code_hash.code_hash(())
    assert code_hash.code_hash(("use",)) != before
    with pytest.raises(SystemExit, match="no such code"):
        code_hash.code_hash(("nowhere",))


@pytest.mark.parametrize(
    ("measured", "good"),
    [
        (Measured("count", 5, 5), True),
        (Measured("count", 5, 6), False),
        (Measured("word", "equal", "differs", 3.0), False),
        (Measured("error", 1e-15, 2e-15, 3.0), True),
        (Measured("error", 1e-15, 4e-15, 3.0), False),
        (Measured("error", 4e-15, 1e-15, 3.0), False),
        (Measured("error", 0.0, 1e-15, 3.0), False),
        (Measured("verdict", True, False, 3.0), False),
    ],
)
def test_spreads(measured: Measured, good: bool) -> None:
    assert measured.good is good


def test_files_are_read_as_they_are_written() -> None:
    result = Result("python tools/x.py", 3, "0", plain({"rows": [{"a": (1, 2.5), "b": None}], "most": float("nan")}))
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
