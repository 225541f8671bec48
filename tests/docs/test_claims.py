"""Claims on the pages are those that are checked; functions without a claim are listed."""

from __future__ import annotations

import re
from typing import Any

import pytest

from docs.pages import PAGES, ROOT, prose, rows
from mahovik.contract.functions import ROWS
from mahovik.core.stand.schema import EncoderTable, MotorTable
from mahovik.proof.evidence.pieces.source import EVA

DOCS = ROOT / "docs"
UNCLAIMED = {name for name, row in ROWS.items() if not row.claimed and not name.endswith("_at")}
WORDS = [*PAGES, *sorted((ROOT / "templates").glob("*.j2")), *sorted((ROOT / "generator").rglob("*.py"))]
TOO_MUCH = (r"\bthe proof that\b", r"\bshares? no (formula|code)\b", r"\bwithout a shared formula\b")


@pytest.mark.parametrize("phrase", TOO_MUCH)
def test_nothing_is_claimed_that_is_not_so(phrase: str) -> None:
    """The derivation and the reference begin with the same matrices; evidence is no proof."""
    assert [path.name for path in WORDS if re.search(phrase, path.read_text(encoding="utf-8"))] == []


def test_functions_without_a_claim_are_listed() -> None:
    listed = [cells[0] for cells in rows(DOCS / "proofs.md", "functions") if "nothing is claimed" in cells[1]]
    assert set(re.findall(r"`(\w+)`", " ".join(listed))) == UNCLAIMED
    assert set(re.findall(r"`(\w+)`", EVA.limits)) == UNCLAIMED


def test_mutants_that_were_never_tried_are_counted() -> None:
    text = " ".join(prose(DOCS / "results" / "traceability.md").split())
    let_through, tried, never = map(
        int, re.findall(r"Of the (\d+) that .*?, (\d+) were tried .*?the other (\d+)", text)[0]
    )
    assert never == let_through - tried


def test_equation_13_is_not_claimed_of_verify() -> None:
    for path in (DOCS / "verification.md", ROOT / "templates" / "report_verification.html.j2", DOCS / "chain.svg"):
        assert "(1)-(13)" not in path.read_text(encoding="utf-8"), path


@pytest.mark.parametrize(("head", "model"), [("`motor` key", MotorTable), ("`encoder` key", EncoderTable)])
def test_drives_are_documented_key_by_key(head: str, model: Any) -> None:
    """Each key has a row with its SI unit, its default and its meaning."""
    table = {cells[0].strip("`"): cells[1:] for cells in rows(DOCS / "stand-file.md", head)}
    assert list(table) == list(model.model_fields)
    for name, (unit, default, meaning) in table.items():
        info = model.model_fields[name]
        assert unit and meaning, name
        if info.is_required():
            assert default == "required"
        elif info.default is None:
            assert default in ("no limit", "none", "not known"), name
        else:
            assert float(default) == info.default, name
