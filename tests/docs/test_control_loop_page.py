"""docs/results/control-loop.md: its estimates follow from its counts."""

from __future__ import annotations

import control_loop as written

from docs.pages import ROOT, rows

PAGE = ROOT / "docs" / "results" / "control-loop.md"
FOUND = written.CAMPAIGN.figures()
BOARDS = {each["board"]: board for each, board in zip(FOUND["runs"], written.BOARDS, strict=True)}


def test_estimates_follow_from_counts() -> None:
    lines = iter(rows(PAGE, "tick"))
    assert len(FOUND["whole ticks"]) == 5
    for tick in FOUND["whole ticks"]:
        for title, board in BOARDS.items():
            name, _, count, estimate, *shares = next(lines)
            time = tick[title] * FOUND["cycles an instruction, assumed"] / board.mhz
            assert (name, count, estimate) == (tick["tick"], f"{tick[title]:,}", f"{time:.0f}")
            for rate, share in zip(written.RATES, shares, strict=True):
                number, _, verdict = share.partition(" ")
                part = time * 1e-6 * rate
                assert number == f"{part:.0%}"
                assert verdict == ("no" if part > 1 else "tight" if part > written.ROOM else "")


def test_a_tick_is_no_more_than_its_stages() -> None:
    """The fast inverse of eight flywheels stays within its budget, too."""
    stages = {row["stage"]: row for row in FOUND["stages"]}
    ticks = {row["tick"]: row for row in FOUND["whole ticks"]}
    parts = ("encoders", "points", "servo", "inverse_fast", "torque", "step, order 2")
    for title in BOARDS:
        assert ticks["inverse_fast, step of order 2"][title] <= sum(stages[part][title] for part in parts)
        assert stages["inverse_fast"][title] <= 20_000
