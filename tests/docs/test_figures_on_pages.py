"""Figures in the prose of pages are those of the constants in the code, or of kept results."""

from __future__ import annotations

import re
from pathlib import Path

import following_campaign
import pytest

from docs.pages import ROOT, prose, rows
from fuzz.conftest import ROOM
from fuzz.reading import SECONDS
from mahovik.core.stand import load
from mahovik.out.cli.evidence import FUZZ_SECONDS
from mahovik.proof.cost.check import RISE
from mahovik.proof.evidence.piece import Subject
from mahovik.proof.evidence.pieces import PIECES
from mahovik.proof.verify.functions.carries import SHORT_STEPS
from mahovik.stands import path
from mahovik.use.plan.objective import KNEE
from mahovik.use.plan.ocp.plan import PARTS
from mahovik.use.plan.optimise.improve import LAST, MEANWHILE

FIGURES = [
    ("planning.md", f"hinge rows that begin at {100 * KNEE:g} % of the limit ({100 * LAST * KNEE:g} % if there is no"),
    ("planning.md", f"the objective is weighted by {MEANWHILE**2:.1g}"),
    ("planning.md", f"IPOPT solves again inside {100 * PARTS[1]:g}, then {100 * PARTS[2]:g} % of the bounds"),
    ("proofs.md", f"at most {SECONDS} s, at most {ROOM >> 30} GB"),
    ("verification.md", f"and in {SHORT_STEPS['float']:,} (`double`: {SHORT_STEPS['double']:,})"),
    ("targets.md", f"if a figure is more than {100 * RISE:g} % above the accepted one"),
]


@pytest.mark.parametrize(("page", "words"), FIGURES, ids=[f"{page} {words}" for page, words in FIGURES])
def test_a_figure_is_that_of_the_code(page: str, words: str) -> None:
    assert words in " ".join(prose(ROOT / "docs" / page).split())


def test_what_control_says_of_bench8_is_what_was_measured() -> None:
    """Both limits are those of the campaign, and each claim holds for the kept figures."""
    limit, trimmed = 100 * following_campaign.LIMIT, 100 * following_campaign.TRIMMED
    text = " ".join(prose(ROOT / "docs" / "control.md").split())
    assert f"rocking programmes stay within the required {limit:g} %, and both kinds within {trimmed:g} % with" in text
    assert f"The spinning programme does not keep {limit:g} % for every seed" in text
    found = {row["programme"].split(",")[0]: row for row in following_campaign.CAMPAIGN.figures()["rows"]}
    assert found["rock"]["worst"] <= limit < found["spin"]["worst"]
    assert max(row["with trim: worst"] for row in found.values()) <= trimmed


def test_the_extent_of_evidence_is_that_of_its_commands() -> None:
    """States of a piece, quick and full, and seconds of fuzzing."""
    listed = {cells[0].strip("`"): cells[1:] for cells in rows(ROOT / "docs" / "delivery.md", "piece")}
    assert f", {FUZZ_SECONDS[0]} s (" in listed["fuzz"][0] and listed["fuzz"][1] == f"{FUZZ_SECONDS[1]} s"
    stand, here = load(path("demo3")), Path()
    counted = []
    for piece in PIECES:
        quick, full = (piece.command(Subject(stand, "double", here, here, full=full)) for full in (False, True))
        if states := re.search(r"--states (\d+)", quick):
            counted.append(piece.name)
            assert listed[piece.name][0].endswith(f", {states[1]} states"), piece.name
            assert f"--states {listed[piece.name][1]}" in full, piece.name
    assert counted == ["comparison", "rounding", "judges"]
