"""Random stands, compiled, against both derivations: a line a stand; exit status 1 where any of them disagree.

python tools/verify_campaign.py [--stands 50] [--states 60] [--jobs 2] [--write]

With --write the summary goes into docs/results/verification.md as well.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass

import campaign
from random_stands import random_stands, verify_random

from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.report import conclusion, worst_lines

BLOCK = campaign.Block("docs/results/verification.md", "campaign: tools/verify_campaign.py --write")
HEAD = ("flywheels", "stands", "passed", "C - reference", "second - reference", "C - second")


@dataclass(frozen=True)
class Verdict:
    """Of one stand: the largest differences of the three pairs, and the states at which it failed."""

    flywheels: int
    line: str
    passed: bool
    pairs: tuple[float, float, float]
    states: str


def judged(number: int, states: int) -> Verdict:
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


def summary(verdicts: Sequence[Verdict], states: int) -> str:
    """A sentence, and a Markdown table by the number of flywheels."""
    passed = sum(each.passed for each in verdicts)
    words = (
        f"{passed} of {len(verdicts)} stands passed, {states} states each; accepted is {BOUNDS['double'].default:.0e}. "
        "Largest differences, relative to\nthe natural scale:\n\n"
    )
    rows = []
    for count in sorted({each.flywheels for each in verdicts}):
        of_it = [each for each in verdicts if each.flywheels == count]
        worst = (f"{max(pair):.0e}" for pair in zip(*(each.pairs for each in of_it), strict=True))
        rows.append((count, len(of_it), sum(each.passed for each in of_it), *worst))
    return words + campaign.table(HEAD, rows, 0)


def main() -> None:
    """Run it."""
    given = campaign.parser(__doc__, stands=50, states=60, jobs=campaign.cores(), write=False).parse_args()
    verdicts = []
    for verdict in campaign.each(judged, given.jobs, range(given.stands), [given.states] * given.stands):
        print(verdict.line, flush=True)
        sys.stdout.write(verdict.states)
        verdicts.append(verdict)
    text = summary(verdicts, given.states)
    print(f"\n{text}", end="")
    if given.write:
        BLOCK.write(text)
    raise SystemExit(0 if all(each.passed for each in verdicts) else 1)


if __name__ == "__main__":
    main()
