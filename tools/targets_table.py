"""The same bits on every target: writes docs/results/targets.md.

python tools/targets_table.py [--states 20]
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random

import campaign
from kept import Campaign, Columns, Figures, Measured

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


def sample(found: Figures, rng: Random) -> Iterator[Measured]:
    """A target again: the same bits; the compiler may be another release."""
    for row in rng.sample(found["rows"], 1):
        report = verify_targets(load(path(STAND)), parse_targets(row["target"]), found["states"])
        (now,) = figures(report)["rows"]
        for key in ("processor", *REALS):
            yield Measured(f"{row['target']}, {key}", row[key], now[key])
        for number in (0, -1):
            kept, word = row["compiler"].split()[number], now["compiler"].split()[number]
            yield Measured(f"{row['target']}, compiler", kept, word)


CAMPAIGN = Campaign(
    "targets",
    campaign.Block("docs/results/targets.md", "targets: tools/targets_table.py"),
    page,
    ("proof/verify", "targets_table.py"),
    sample,
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
