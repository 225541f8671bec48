"""Mutants of every program function and what notices them; docs/results/traceability.md, equation by equation.

python tools/traceability.py [--jobs 2] [--functions forward,step] | --page

Without --page, mutants are made and tests run: a quarter of an hour. --page writes the page from what was found
before, with the lines of generated/ as they are now.
"""

from __future__ import annotations

import os
import sys

import campaign

sys.path.insert(0, str(campaign.ROOT / "tests"))


def main() -> None:
    parser = campaign.parser(__doc__, jobs=2, page=False)
    parser.add_argument("--functions", help="comma-separated; default: all")
    given = parser.parse_args()
    os.chdir(campaign.ROOT)
    from traceability import page

    if not given.page:
        from traceability import campaign as mutants
        from traceability.lines import functions

        def say(found: mutants.Found) -> None:
            caught = found.comparison + found.tests
            print(f"{found.function}: {caught} of {found.mutants} noticed {'; '.join(found.survivors)}", flush=True)

        mutants.collected()
        wanted = given.functions.split(",") if given.functions else list(functions())
        for found in mutants.campaign(wanted, given.jobs, say):
            page.keep(found, list(functions().values()))
    page.write()


if __name__ == "__main__":
    main()
