"""(13) by IPOPT: bench8 is solved by the partition, and no case is worse than its start."""

from __future__ import annotations

import ocp_campaign as written

ROWS = written.CAMPAIGN.figures()["rows"]


def test_every_case_has_a_row_for_each_method() -> None:
    """bench8 twice, and seeds of three numbers of flywheels."""
    found = [(row["stand"], row["method"]) for row in ROWS]
    names = {name for name, _ in found}
    assert len(found) == len(set(found)) == 2 * len(names)
    assert {"bench8", "bench8, spin"} <= names
    assert all(any(name.startswith(f"N = {N},") for name in names) for N in (7, 8, 10))


def test_the_partition_solves_bench8_or_says_where_it_is_singular() -> None:
    """Regular where it is solved; times where it is not; J is never above that of the start by more than rounding."""
    outcomes = {(row["stand"], row["method"]): row for row in ROWS}
    assert outcomes["bench8", "ocp-partition"]["status"].startswith("OK")
    for (name, method), row in outcomes.items():
        if row["status"].startswith("NO_PROGRAM"):
            assert "SINGULAR_PARTITION" in row["status"] and "det I+ = 0 at t = " in row["status"], name
            continue
        after, before = row["J / J of `fourier`"]
        assert after <= before * 1.0001, name
        assert row["residual"] < 1e-6, name
        assert method == "ocp" or "times" not in row["partition"]
