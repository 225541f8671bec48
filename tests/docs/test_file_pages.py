"""Pages on files: their examples are read, and their tables name the keys, signals and limits of the code."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from docs.pages import ROOT, blocks, rows
from mahovik.core.motion.motion_file import (
    MotionTable,
    SlewEnd,
    SlewStart,
    SlewTable,
    read_motion,
    read_motion_or_slew,
)
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Bounds, Objective, Slew
from mahovik.core.stand import load
from mahovik.core.stand.tables import keys_of
from mahovik.out.campaign.file import load_campaign
from mahovik.out.campaign.quantities import SIGNALS, STATISTICS
from mahovik.out.campaign.runs import KINDS as RUNS
from mahovik.out.campaign.vary import DESIGNS, KINDS
from mahovik.proof.verify.programme.verification import JOINT, TABLE, tolerance_for
from mahovik.stands import path

DOCS = ROOT / "docs"


def names(page: str, head: str) -> set[str]:
    """Names in the first column of all tables of a page whose head begins with a cell."""
    return {name for row in rows(DOCS / page, head) for name in re.findall(r"`\"?([\w.-]+)\"?`", row[0])}


def fields(*tables: type) -> set[str]:
    """Keys of tables of a file."""
    return {key for table in tables for key in keys_of(table)}


@pytest.mark.parametrize(
    ("page", "head", "keys"),
    [
        ("campaigns.md", "distribution", {*KINDS}),
        ("campaigns.md", "design", {*DESIGNS}),
        ("campaigns.md", "key of `[over]`", {*RUNS}),
        ("campaigns.md", "signal", {*SIGNALS}),
        ("campaigns.md", "statistic", {*STATISTICS}),
    ],
)
def test_a_table_has_the_keys_of_the_reader(page: str, head: str, keys: set[str]) -> None:
    assert names(page, head) == keys


def test_keys_of_motions_programmes_and_slews_are_documented() -> None:
    motion = {*fields(MotionTable, Bounds, Objective), "schema"}
    slew = fields(SlewTable, SlewStart, SlewEnd)
    text = (DOCS / "planning.md").read_text(encoding="utf-8")
    documented = set(re.findall(r"`(\w+)`", text))
    assert motion | slew | fields(Programme) - {"report"} <= documented


def test_units_of_signals_are_those_of_the_code() -> None:
    for row in rows(DOCS / "campaigns.md", "signal"):
        for name in re.findall(r"`(\w+)`", row[0]):
            assert SIGNALS[name].dimension.si.replace("^", "") in ["", *row[1].split(", ")], name


def test_motions_are_read() -> None:
    motion, turn = (block.text for block in blocks(DOCS / "planning.md") if block.language == "json")
    assert read_motion(motion, load(path("bench8"))).name == json.loads(motion)["name"]
    slew = read_motion_or_slew(turn, load(path("sat4")))
    assert isinstance(slew, Slew) and slew.name == json.loads(turn)["name"]


def test_campaigns_give_rows(tmp_path: Path) -> None:
    """Every sample has all quantities, which differ from sample to sample."""
    (text,) = (block.text for block in blocks(DOCS / "campaigns.md") if block.file)
    (tmp_path / "tolerances.toml").write_text(text, encoding="utf-8")
    campaign = load_campaign(tmp_path / "tolerances.toml")
    rows = campaign.rows(0, 3)
    assert rows["error"] == [""] * 3
    for quantity in campaign.quantities:
        assert len(np.unique(rows[quantity.name])) == 3 and np.isfinite(rows[quantity.name]).all()


def test_limits_of_the_verification_of_programmes() -> None:
    accepted = {
        name: [float(x) for x in re.findall(r"\d[\de.-]*", row[2])]
        for row in rows(DOCS / "planning.md", "item")
        for name in re.findall(r"`([^`]+)`", row[0])
    }
    smooth, kinked = (tolerance_for(load(path(name)), None) for name in ("bench8", "auv6"))
    assert accepted["residual"] == [smooth.residual]
    assert accepted["simulation"] == [smooth.error]
    assert accepted["table"] == accepted["periodicity"] == [TABLE]
    assert accepted["run-up table"] == [TABLE, JOINT]
    assert accepted["run-up end"] == [smooth.runup]
    text = (DOCS / "planning.md").read_text(encoding="utf-8")
    for size in (kinked.residual, kinked.error):
        assert f"accepted to {size:.0e}".replace("e-0", "e-") in text
