"""The campaign of random stands: what was kept passes, and covers what matters."""

from __future__ import annotations

import verify_campaign as written


def test_all_stands_passed() -> None:
    found = written.CAMPAIGN.figures()
    rows = found["rows"]
    assert {0, 1, 5, 6, 7, 12, 64} <= {row["flywheels"] for row in rows}
    assert sum(row["stands"] for row in rows) == sum(row["passed"] for row in rows) >= 50
    assert all(0.0 < row[pair] <= found["accepted"] for row in rows for pair in written.PAIRS)


def test_the_summary() -> None:
    good = written.Verdict(5, "", True, (1e-15, 2e-15, 3e-15), "")
    bad = written.Verdict(5, "", False, (1e-11, 2e-16, 1e-11), "{}")
    other = written.Verdict(64, "", True, (1e-16, 2e-16, 3e-16), "")
    text = written.page(written.figures([good, other, bad], 9))
    assert text.startswith("2 of 3 stands passed, 9 states each")
    assert text.endswith("| 5 | 2 | 1 | 1e-11 | 2e-15 | 1e-11 |\n| 64 | 1 | 1 | 1e-16 | 2e-16 | 3e-16 |\n")
