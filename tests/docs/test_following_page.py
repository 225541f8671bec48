"""How well bench8 follows its programmes: what must hold."""

from __future__ import annotations

import following_campaign as written


def test_what_must_hold_is_there() -> None:
    """Rocking programmes within 5 %; with trim both within 1 %."""
    found = written.CAMPAIGN.figures()
    kinds = {row["programme"].split(",")[0]: row for row in found["rows"]}
    assert set(kinds) == {"spin", "rock"}
    assert kinds["rock"]["worst"] <= 100 * written.LIMIT
    assert all(row["with trim: worst"] <= 100 * written.TRIMMED for row in kinds.values())
    assert all(row["within 1 %"] == [found["seeds"]] * 2 for row in kinds.values())
