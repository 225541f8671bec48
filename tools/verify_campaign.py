"""Random stands, compiled, against both derivations: a line a stand; exit status 1 where any of them disagree.

python tools/verify_campaign.py [--stands 50] [--states 60] [--jobs 2] [--write]

With --write the summary goes into docs/results/verification.md as well.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.campaign import random_stands, verify_random
from mahovik.proof.verify.report import conclusion, worst_lines

PAGE = Path(__file__).resolve().parents[1] / "docs" / "results" / "verification.md"
BEGIN, END = "<!-- campaign: tools/verify_campaign.py --write -->", "<!-- end of campaign -->"
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
    rows = [HEAD, ("---:",) * len(HEAD)]
    for count in sorted({each.flywheels for each in verdicts}):
        of_it = [each for each in verdicts if each.flywheels == count]
        worst = (f"{max(pair):.0e}" for pair in zip(*(each.pairs for each in of_it), strict=True))
        rows.append((str(count), str(len(of_it)), str(sum(each.passed for each in of_it)), *worst))
    return words + "".join(f"| {' | '.join(row)} |\n" for row in rows)


def with_summary(page: str, text: str) -> str:
    """The page with the summary between its markers."""
    before, rest = page.split(BEGIN)
    return f"{before}{BEGIN}\n\n{text}\n{END}{rest.split(END)[1]}"


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--stands", type=int, default=50)
    parser.add_argument("--states", type=int, default=60)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--write", action="store_true", help="the summary into docs/results/verification.md as well")
    given = parser.parse_args()
    verdicts = []
    with ProcessPoolExecutor(given.jobs) as pool:
        for verdict in pool.map(judged, range(given.stands), [given.states] * given.stands):
            print(verdict.line, flush=True)
            sys.stdout.write(verdict.states)
            verdicts.append(verdict)
    text = summary(verdicts, given.states)
    print(f"\n{text}", end="")
    if given.write:
        PAGE.write_text(with_summary(PAGE.read_text(encoding="utf-8"), text), encoding="utf-8")
    raise SystemExit(0 if all(each.passed for each in verdicts) else 1)


if __name__ == "__main__":
    main()
