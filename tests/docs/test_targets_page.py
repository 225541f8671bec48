"""docs/results/targets.md holds the table of tools/targets_table.py: all targets, all equal."""

from __future__ import annotations

import re

import targets_table as written

from docs.pages import cells
from mahovik.core.toolchain.targets import TARGETS
from mahovik.proof.verify.targets import REALS, TargetRow, TargetsReport


def report() -> TargetsReport:
    """Of every target, as it would come out well."""
    rows = [
        TargetRow(t.name, t.title, f"{t.compiler[0]} 12.2.0 {t.optimisation}", real, 20, 20, "ok")
        for t in TARGETS.values()
        for real in REALS
    ]
    return TargetsReport("bench8", "0", "1", 20, tuple(rows))


def test_the_table_names_every_target_and_compiler() -> None:
    """Same rows and columns as the tool writes, versions aside; every pair equal, and twelve at least."""
    part = written.PAGE.text()
    expected = written.full(report())
    assert re.sub(r" \d+\.\d+\.\d+", "", part.strip()) == re.sub(r" \d+\.\d+\.\d+", "", expected.strip())
    rows = [cells(line) for line in part.splitlines() if line.startswith("|")][2:]
    assert sum(row.count("equal") for row in rows) >= 12
