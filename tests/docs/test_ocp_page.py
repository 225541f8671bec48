"""(13) by IPOPT: bench8 is solved, and no case is worse than its start."""

from __future__ import annotations

import ocp_campaign as written

ROWS = {row["stand"]: row for row in written.CAMPAIGN.figures()["rows"]}


def test_every_case_has_a_row() -> None:
    """bench8 twice, and seeds of three numbers of flywheels."""
    assert len(ROWS) == len(written.CAMPAIGN.figures()["rows"])
    assert {"bench8", "bench8, spin"} <= set(ROWS)
    assert all(any(name.startswith(f"N = {N},") for name in ROWS) for N in (7, 8, 10))


def test_no_programme_is_worse_than_its_start() -> None:
    """J is never above that of the start by more than rounding."""
    for name, row in ROWS.items():
        assert row["status"].startswith("OK"), name
        after, before = row["J / J of `fourier`"]
        assert after <= before * 1.0001, name
        assert row["residual"] < 1e-6, name
