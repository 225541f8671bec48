"""Random stands, compiled, against both derivations: a line a stand; exit status 1 where any of them disagree.

python tools/verify_campaign.py [--stands 50] [--states 60] [--jobs 2]
"""

from __future__ import annotations

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor

from mahovik.verify.campaign import random_stands, verify_random
from mahovik.verify.report import conclusion, worst_lines


def judged(number: int, states: int) -> tuple[str, bool, str]:
    """A line on one stand, whether it passed, and the states at which it did not."""
    *_, stand = random_stands(number + 1)
    found = verify_random(stand, states)
    line = f"{stand.name:10} {len(stand.flywheels):3} flywheels, {stand.angles:8} {conclusion(found)}"
    return line, found.passed, "" if found.passed else worst_lines(found)


def main() -> None:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--stands", type=int, default=50)
    parser.add_argument("--states", type=int, default=60)
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    failed = 0
    with ProcessPoolExecutor(given.jobs) as pool:
        for line, passed, states in pool.map(judged, range(given.stands), [given.states] * given.stands):
            print(line, flush=True)
            failed += not passed
            sys.stdout.write(states)
    print(f"{given.stands - failed} of {given.stands} passed")
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
