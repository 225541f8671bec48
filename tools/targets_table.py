"""The same bits on every target: writes docs/results/targets.md.

python tools/targets_table.py [--states 20]
"""

from __future__ import annotations

from collections.abc import Sequence

import campaign

from mahovik.core.stand import load
from mahovik.proof.verify.targets import REALS, SWEEP, TargetRow, TargetsReport, asked, verify_targets
from mahovik.stands import path

PAGE = campaign.Block("docs/results/targets.md", "targets: tools/targets_table.py")
STAND = "bench8"


def verdict(rows: Sequence[TargetRow]) -> str:
    """Of rows that share a cell: their verdict, and why not."""
    return "; ".join(dict.fromkeys("equal" if r.verdict == "ok" else f"{r.verdict}: {r.reason}" for r in rows))


def full(report: TargetsReport) -> str:
    """A line a target."""
    lines = []
    for name in dict.fromkeys(row.target for row in report.rows):
        own = [row for row in report.rows if row.target == name]
        cells = [verdict([row for row in own if row.real == real]) for real in REALS]
        lines.append([f"`{name}`", own[0].title, own[0].built_with, *cells])
    return campaign.table(["target", "processor", "compiler", *REALS], lines, None)


def main() -> None:
    """Run every target, write the page. Exit status 1 where bits differ or a target was not run."""
    states = campaign.parser(__doc__, states=SWEEP).parse_args().states
    report = verify_targets(load(path(STAND)), asked("all"), states)
    PAGE.write(full(report))
    print(report.conclusion)
    raise SystemExit(0 if report.passed else 1)


if __name__ == "__main__":
    main()
