"""docs/programmes.md: its keys are those that the readers know, its examples are read, its limits are the code's."""

from __future__ import annotations

import json
import re

from docs.pages import ROOT, blocks, cells, tables
from mahovik import stands
from mahovik.core.motion.programme import read as programme
from mahovik.core.motion.required import Slew, read, slew_file
from mahovik.core.stand import load
from mahovik.proof.verify.programme.finding import Tolerance, tolerance_for

PAGE = ROOT / "docs" / "programmes.md"


def table(first: str, holds: str) -> dict[str, list[str]]:
    """The table whose head begins with `first` and that has a row of `holds`: its other cells by each name."""
    for lines in tables(PAGE):
        found = [cells(line) for line in lines]
        names = {name: row[1:] for row in found[2:] for name in re.findall(r"`([^`]+)`", row[0])}
        if found[0][0] == first and holds in names:
            return names
    raise AssertionError(f"no table of {holds}")


def test_keys_of_both_files() -> None:
    assert set(table("key", "harmonics")) == {*read.MotionTable.model_fields, "schema", "bounds", "objective"}
    assert set(table("key", "fourier")) | {"report"} == set(programme.ProgrammeTable.model_fields)
    text = PAGE.read_text(encoding="utf-8")
    assert all(f"`{key}`" in text for key in (*read.BoundsTable.model_fields, *read.ObjectiveTable.model_fields))


def test_the_motion_is_one() -> None:
    example, turn = (block for block in blocks(PAGE) if block.language == "json")
    motion = read.read_motion(example.text, load(stands.path("bench8")))
    assert motion.name == json.loads(example.text)["name"]
    slew = read.read_motion_or_slew(turn.text, load(stands.path("sat4")))
    assert isinstance(slew, Slew) and slew.name == json.loads(turn.text)["name"]


def test_keys_of_a_slew() -> None:
    text = PAGE.read_text(encoding="utf-8")
    own = (slew_file.SlewTable, slew_file.StartTable, slew_file.EndTable, slew_file.SlewBounds)
    assert all(f"`{key}`" in text for each in own for key in each.model_fields)


def test_limits_are_those_of_the_verification() -> None:
    accepted = {
        name: [float(x) for x in re.findall(r"\d[\de.-]*", row[1])] for name, row in table("item", "bias").items()
    }
    smooth: Tolerance = tolerance_for(load(stands.path("bench8")), None)
    assert accepted["residual"] == [smooth.residual]
    assert accepted["simulation"] == [smooth.error]
    assert accepted["table"] == accepted["periodicity"] == [smooth.table]
    assert accepted["run-up table"] == [smooth.table, smooth.joint]
    assert accepted["run-up end"] == [smooth.runup]
    text = PAGE.read_text(encoding="utf-8")
    kinked = tolerance_for(load(stands.path("auv6")), None)
    assert f"accepted to {kinked.residual:.0e}".replace("e-0", "e-") in text
    assert f"accepted to {kinked.error:.0e}".replace("e-0", "e-") in text
    assert f"above {smooth.multiplier} a warning" in text
