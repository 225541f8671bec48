"""docs/results/control-loop.md: the tables of tools/control_loop.py; its estimates follow from its counts."""

from __future__ import annotations

import control_loop as written

from docs.pages import ROOT, rows

PAGE = ROOT / "docs" / "results" / "control-loop.md"


def test_estimates_follow_from_counts() -> None:
    boards = {f"{b.name} at {b.mhz} MHz": b for b in written.BOARDS}
    lines = rows(PAGE, "tick")
    assert len(lines) == 5 * len(boards)
    for _, processor, count, estimate, *shares in lines:
        time = boards[processor].microseconds(int(count.replace(",", "")))
        assert estimate == f"{time:.0f}"
        for rate, share in zip(written.RATES, shares, strict=True):
            number, _, verdict = share.partition(" ")
            part = time * 1e-6 * rate
            assert number == f"{part:.0%}"
            assert verdict == ("no" if part > 1 else "tight" if part > written.ROOM else "")


def test_the_page_says_what_an_estimate_is() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert "**estimate** of time" in text
    assert "time is not measured" in text


def test_a_tick_is_no_more_than_its_stages() -> None:
    """And the fast inverse of eight flywheels stays within its budget."""
    stages = {line[0]: [int(n.replace(",", "")) for n in line[1:]] for line in rows(PAGE, "stage")}
    ticks = {(line[0], line[1][:9]): int(line[2].replace(",", "")) for line in rows(PAGE, "tick")}
    parts = ("encoders", "points", "servo", "inverse_fast", "torque", "step, order 2")
    for column, board in enumerate(("STM32H743", "STM32F407")):
        assert ticks["inverse_fast, step of order 2", board] <= sum(stages[p][column] for p in parts)
        assert stages["inverse_fast"][column] <= 20_000
