"""Mutants of every program function and what notices them; docs/results/traceability.md, equation by equation.

python tools/traceability.py [--jobs 2] [--functions forward,step] | --page

Without --page, mutants are made and tests run: a quarter of an hour. --page writes the page from what was found
before, with the lines of generated/ as they are now.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--functions", help="comma-separated; default: all")
    parser.add_argument("--page", action="store_true")
    given = parser.parse_args()
    os.chdir(ROOT)
    from traceability import page

    if not given.page:
        from traceability.campaign import Found, campaign, collected
        from traceability.lines import functions

        def say(found: Found) -> None:
            caught = found.comparison + found.tests
            print(f"{found.function}: {caught} of {found.mutants} noticed {'; '.join(found.survivors)}", flush=True)

        collected()
        wanted = given.functions.split(",") if given.functions else list(functions())
        for found in campaign(wanted, given.jobs, say):
            page.keep(found, list(functions().values()))
    page.write()


if __name__ == "__main__":
    main()
