"""docs/campaign-quantities.md: its campaign gives rows; signals, statistics, runs and arrays are those of the code."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from docs.pages import ROOT, blocks, cells, tables
from mahovik.out.campaign.campaign import Campaign
from mahovik.out.campaign.file import load_campaign
from mahovik.out.campaign.over import KINDS
from mahovik.out.campaign.signals import SIGNALS
from mahovik.out.campaign.wanted import STATISTICS

PAGE = ROOT / "docs" / "campaign-quantities.md"


def write(folder: Path) -> Path:
    """The files of the page; returns the campaign."""
    for block in blocks(PAGE):
        (folder / block.file).write_text(block.text, encoding="utf-8")
    return folder / "shake.toml"


def first_column(head: str) -> list[str]:
    """First cells of the table whose head begins so."""
    (found,) = (lines for lines in tables(PAGE) if cells(lines[0])[0] == head)
    return [cells(line)[0] for line in found[2:]]


def test_the_campaign_gives_rows(tmp_path: Path) -> None:
    """Every sample has all quantities, which differ from sample to sample, but for the time of settling."""
    rows = Campaign.load(write(tmp_path)).rows(0, 3)
    assert list(rows.reason) == [""] * 3
    for name, column in rows.quantities.items():
        assert np.isfinite(column).all()
        assert len(np.unique(column)) == 3 or name in ("settled", "tilt")
    assert load_campaign(tmp_path / "shake.toml").table.quantity.keys() == rows.quantities.keys()


def test_tables_are_those_of_the_code() -> None:
    """Signals with their units, statistics, runs."""
    signals = [name for cell in first_column("signal") for name in re.findall(r"`(\w+)`", cell)]
    assert signals == list(SIGNALS)
    statistics = [name for cell in first_column("statistic") for name in re.findall(r"`(\w+)`", cell)]
    assert set(statistics) == {*STATISTICS, "band"}
    runs = [name for cell in first_column("`[over]`") for name in re.findall(r"`(\w+)`", cell)]
    assert list(dict.fromkeys(runs)) == ["regime", "speeds", "programme", "servo", "states"]
    assert {*runs} - {"servo"} == {*KINDS}
    (lines,) = (lines for lines in tables(PAGE) if cells(lines[0])[0] == "signal")
    for line in lines[2:]:
        names, units = (cells(line)[i] for i in (0, 1))
        for name in re.findall(r"`(\w+)`", names):
            if name not in ("sigma", "error"):
                assert SIGNALS[name].unit in units.split(", "), name


def test_a_function_gets_the_arrays_of_the_page() -> None:
    """The names of `Records.sample`."""
    import inspect

    from mahovik.out.campaign.records import Records

    told = {name for cell in first_column("name") for name in re.findall(r"`([^`]+)`", cell)}
    source = inspect.getsource(Records.sample)
    for name in told:
        word = name.split()[0]
        assert re.search(rf"\"{word}\b|\b{word}\b", source), name
