"""docs/results/targets.md: all targets, all equal."""

from __future__ import annotations

import targets_table as written

from mahovik.core.toolchain.targets import TARGETS
from mahovik.proof.verify.targets import REALS


def test_every_target_was_run_with_its_compiler_and_has_the_same_bits() -> None:
    rows = written.CAMPAIGN.figures()["rows"]
    assert [row["target"] for row in rows] == list(TARGETS)
    for row, target in zip(rows, TARGETS.values(), strict=True):
        compiler, *_, optimisation = row["compiler"].split()
        assert (row["processor"], compiler, optimisation) == (target.title, target.compiler[0], target.optimisation)
        assert [row[real] for real in REALS] == ["equal"] * len(REALS)
