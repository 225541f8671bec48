"""docs/results/following.md holds the table that tools/following_campaign.py writes, and what must hold."""

from __future__ import annotations

from docs.pages import ROOT, rows

PAGE = ROOT / "docs" / "results" / "following.md"


def per_cent(cell: str) -> float:
    return float(cell.removesuffix("%"))


def test_what_must_hold_is_there() -> None:
    """Rocking programmes within 5 %; with trim both within 1 %."""
    lines = rows(PAGE, "programme")
    kinds = {line[0].split(",")[0]: line for line in lines if "winding" in line[0]}
    assert set(kinds) == {"spin", "rock"}
    assert per_cent(kinds["rock"][2]) <= 5.0
    assert all(per_cent(line[5]) <= 1.0 for line in kinds.values())
    assert all(line[6].split(" of ")[0] == line[6].split(" of ")[1] for line in kinds.values())
