"""docs/architecture.md: its table of functions is the contract, its list of stages is the package."""

from __future__ import annotations

import contract_page as written

from docs.pages import ROOT, prose
from mahovik.contract.laws import BODY_LAWS, LAWS

PACKAGE = ROOT / "generator" / "mahovik"


def test_the_functions_are_those_of_the_contract() -> None:
    """`python tools/contract_page.py` rewrites the table."""
    assert written.PAGE.text() == written.table().strip("\n")


def test_every_stage_is_on_the_page() -> None:
    text = prose(written.PAGE.path)
    for wing in ("core", "proof", "use", "out"):
        for stage in (path.parent.name for path in (PACKAGE / wing).glob("*/__init__.py")):
            assert f"`{wing}/{stage}`" in text, (wing, stage)


def test_every_law_is_on_the_page() -> None:
    text = prose(written.PAGE.path)
    assert [law for law in (*BODY_LAWS, *LAWS) if f"`laws/{law}`" not in text] == []


def test_the_page_is_short() -> None:
    """A newcomer reads it whole."""
    words = written.PAGE.path.read_text(encoding="utf-8").split()
    assert sum(any(map(str.isalnum, word)) for word in words) <= 1500
