"""Random stands, compiled, against both derivations: one line per stand; exit status 1 where any of them disagree.

python tools/verify_campaign.py [--stands 62] [--states 60] [--jobs 2] [--write]

With --write the summary goes into docs/results/verification.md as well.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass

import campaign
from kept import Campaign, Columns, Figures
from random_stands import random_stands, verify_random

from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.report import conclusion, worst_lines

PAIRS = ("C - reference", "second - reference", "C - second")
TABLE = Columns({"flywheels": "{}", "stands": "{}", "passed": "{}", **dict.fromkeys(PAIRS, "{:.0e}")}, 0)


@dataclass(frozen=True)
class Verdict:
    """Result for one stand: the largest differences of the three pairs, and the states at which it failed."""

    flywheels: int
    line: str
    passed: bool
    pairs: tuple[float, float, float]
    states: str


def verdict_on(number: int, states: int) -> Verdict:
    """The verdict on the stand of that number."""
    *_, stand = random_stands(number + 1)
    found = verify_random(stand, states)
    line = f"{stand.name:10} {len(stand.flywheels):3} flywheels, {stand.angles:8} {conclusion(found)}"
    pairs = (
        max(row.worst for row in found.rows),
        max(row.second or 0.0 for row in found.rows),
        max(row.between or 0.0 for row in found.rows),
    )
    return Verdict(len(stand.flywheels), line, found.passed, pairs, "" if found.passed else worst_lines(found))


def figures(verdicts: Sequence[Verdict], states: int) -> Figures:
    """The figures to keep: a row for each number of flywheels, with the largest differences."""
    rows = []
    for count in sorted({each.flywheels for each in verdicts}):
        of_it = [each for each in verdicts if each.flywheels == count]
        worst = (max(pair) for pair in zip(*(each.pairs for each in of_it), strict=True))
        rows.append((count, len(of_it), sum(each.passed for each in of_it), *worst))
    return {"states": states, "accepted": BOUNDS["double"].default, "rows": TABLE.rows(rows)}


def page(found: Figures) -> str:
    """A sentence, and a table by the number of flywheels."""
    passed, stands = (sum(row[key] for row in found["rows"]) for key in ("passed", "stands"))
    return (
        f"{passed} of {stands} stands passed, {found['states']} states each; accepted is {found['accepted']:.0e}. "
        f"Largest differences, relative to\nthe natural scale:\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "verification",
    campaign.Block("docs/results/verification.md", "campaign: tools/verify_campaign.py --write"),
    page,
)


def main() -> None:
    """Run it."""
    given = campaign.parser(__doc__, stands=62, states=60, jobs=campaign.cores(), write=False).parse_args()
    verdicts = []
    for verdict in campaign.map_rows(verdict_on, given.jobs, range(given.stands), [given.states] * given.stands):
        print(verdict.line, flush=True)
        sys.stdout.write(verdict.states)
        verdicts.append(verdict)
    found = figures(verdicts, given.states)
    print(f"\n{page(found)}", end="")
    if given.write:
        CAMPAIGN.keep(found, 0)
    raise SystemExit(0 if all(each.passed for each in verdicts) else 1)


if __name__ == "__main__":
    main()
