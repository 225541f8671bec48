"""The same bits on every target: writes the tables of docs/results/targets.md, and a short one into README.md.

python tools/targets_table.py [--states 20]
"""

from __future__ import annotations

from collections.abc import Sequence

import campaign

from mahovik.core.stand import load
from mahovik.proof.verify.targets import REALS, SWEEP, TargetRow, TargetsReport, asked, verify_targets
from mahovik.stands import path

README, PAGE = (
    campaign.Block(name, "targets: tools/targets_table.py") for name in ("README.md", "docs/results/targets.md")
)
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


def short(report: TargetsReport) -> str:
    """A line a processor, with its compilers."""
    lines = []
    for title in dict.fromkeys(_processor(row) for row in report.rows):
        own = [row for row in report.rows if _processor(row) == title]
        compilers: dict[str, list[str]] = {}
        for row in own:
            command, level = row.built_with.rsplit(" ", 1)
            levels = compilers.setdefault(command, [])
            levels += [level] if level not in levels else []
        words = ", ".join(f"{command} {' '.join(sorted(levels))}" for command, levels in compilers.items())
        lines.append([title, words, *(verdict([row for row in own if row.real == real]) for real in REALS)])
    return campaign.table(["processor", "compiler", *REALS], lines, None)


def _processor(row: TargetRow) -> str:
    return "x86-64, with and without AVX2, AVX-512" if row.target.startswith("host") else row.title


def main() -> None:
    """Run every target, write both pages. Exit status 1 where bits differ or a target was not run."""
    states = campaign.parser(__doc__, states=SWEEP).parse_args().states
    report = verify_targets(load(path(STAND)), asked("all"), states)
    README.write(short(report))
    PAGE.write(full(report))
    print(report.conclusion)
    raise SystemExit(0 if report.passed else 1)


if __name__ == "__main__":
    main()
