"""The same bits on every target: writes docs/results/targets.md.

python tools/targets_table.py [--states 20]
"""

from __future__ import annotations

from collections.abc import Sequence

import campaign
from kept import Campaign, Columns, Figures

from mahovik.core.stand import load
from mahovik.proof.verify.targets import REALS, SWEEP, TargetRow, TargetsReport, parse_targets, verify_targets
from mahovik.stands import path

STAND = "bench8"


def verdict(rows: Sequence[TargetRow]) -> str:
    """Verdict of the rows that share a cell, with the reason of a failure."""
    return "; ".join(dict.fromkeys("equal" if r.verdict == "ok" else f"{r.verdict}: {r.reason}" for r in rows))


TABLE = Columns({"target": "`{}`", "processor": "{}", "compiler": "{}", **dict.fromkeys(REALS, "{}")}, None)


def figures(report: TargetsReport) -> Figures:
    """The figures to keep: one row per target."""
    lines = []
    for name in dict.fromkeys(row.target for row in report.rows):
        own = [row for row in report.rows if row.target == name]
        verdicts = [verdict([row for row in own if row.real == real]) for real in REALS]
        lines.append((name, own[0].title, own[0].built_with, *verdicts))
    return {"stand": STAND, "states": report.sweep, "rows": TABLE.rows(lines)}


def page(found: Figures) -> str:
    """The table."""
    return TABLE.text(found["rows"])


CAMPAIGN = Campaign(
    "targets",
    campaign.Block("docs/results/targets.md", "targets: tools/targets_table.py"),
    page,
)


def main() -> None:
    """Run every target, write the page. Exit status 1 where bits differ or a target was not run."""
    states = campaign.parser(__doc__, states=SWEEP).parse_args().states
    report = verify_targets(load(path(STAND)), parse_targets("all"), states)
    CAMPAIGN.keep(figures(report))
    print(report.conclusion)
    raise SystemExit(0 if report.passed else 1)


if __name__ == "__main__":
    main()
