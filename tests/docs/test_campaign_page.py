"""docs/results/verification.md holds what tools/verify_campaign.py --write says."""

from __future__ import annotations

import verify_campaign as written

from docs.pages import ROOT, cells


def test_the_campaign_on_the_page() -> None:
    text = written.BLOCK.text()
    assert text.startswith("50 of 50 stands passed, 60 states each; accepted is 1e-12. ")
    head, _, *rows = [cells(line) for line in text.splitlines() if line.startswith("|")]
    assert tuple(head) == written.HEAD
    assert {"0", "1", "5", "6", "7", "12", "64"} <= {row[0] for row in rows}
    assert sum(int(row[1]) for row in rows) == sum(int(row[2]) for row in rows) == 50
    assert all(0.0 < float(number) <= 1e-12 for row in rows for number in row[3:])
    assert written.BLOCK.page_with(text) == (ROOT / "docs" / "results" / "verification.md").read_text(encoding="utf-8")


def test_the_summary() -> None:
    good = written.Verdict(5, "", True, (1e-15, 2e-15, 3e-15), "")
    bad = written.Verdict(5, "", False, (1e-11, 2e-16, 1e-11), "{}")
    other = written.Verdict(64, "", True, (1e-16, 2e-16, 3e-16), "")
    text = written.summary([good, other, bad], 9)
    assert text.startswith("2 of 3 stands passed, 9 states each")
    assert text.endswith("| 5 | 2 | 1 | 1e-11 | 2e-15 | 1e-11 |\n| 64 | 1 | 1 | 1e-16 | 2e-16 | 3e-16 |\n")
