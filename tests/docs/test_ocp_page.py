"""docs/results/optimal-control.md: the table of tools/ocp_campaign.py; bench8 is solved by the partition."""

from __future__ import annotations

from docs.pages import ROOT, cells


def rows() -> list[list[str]]:
    """Cells of the table."""
    text = (ROOT / "docs" / "results" / "optimal-control.md").read_text(encoding="utf-8")
    table = text.split("<!-- campaign: tools/ocp_campaign.py --write -->")[1].split("<!-- end of campaign -->")[0]
    lines = [line for line in table.splitlines() if line.startswith("| ")]
    return [cells(line) for line in lines[1:]]


def test_every_case_has_a_row_for_each_method() -> None:
    """bench8 twice, and seeds of three numbers of flywheels."""
    found = [(row[0], row[1]) for row in rows()]
    names = {name for name, _ in found}
    assert len(found) == len(set(found)) == 2 * len(names)
    assert {"bench8", "bench8, spin"} <= names
    assert all(any(name.startswith(f"N = {N},") for name in names) for N in (7, 8, 10))


def test_the_partition_solves_bench8_or_says_where_it_is_singular() -> None:
    """Regular where it is solved; times where it is not; J is never above that of the start by more than rounding."""
    outcomes = {(row[0], row[1]): row for row in rows()}
    assert outcomes["bench8", "`ocp-partition`"][2].startswith("OK")
    for (name, method), row in outcomes.items():
        if row[2].startswith("NO_PROGRAM"):
            assert "SINGULAR_PARTITION" in row[2] and "det I+ = 0 at t = " in row[2], name
            continue
        after, before = (float(x) for x in row[-1].split("/"))
        assert after <= before * 1.0001, name
        assert float(row[7]) < 1e-6, name
        assert method == "`ocp`" or "times" not in row[3]
