"""Mutants of every program function and what notices them; docs/results/traceability.md, equation by equation.

python tools/traceability_campaign.py [--jobs 2] [--functions forward,step] | --page

Without --page, mutants are made and tests run: a quarter of an hour. --page writes the page from what was found
before, with the lines of generated/ as they are now.
"""

from __future__ import annotations

import os
import sys

import campaign
from kept import Campaign, Figures

sys.path.insert(0, str(campaign.ROOT / "tests"))


def page(found: Figures) -> str:
    """Equations, functions with the lines of generated/ as they are now, survivors."""
    from traceability import page as tables

    return tables.text(found["functions"])


CAMPAIGN = Campaign(
    "traceability",
    campaign.Block("docs/results/traceability.md", "mutants: tools/traceability_campaign.py"),
    page,
)


def main() -> None:
    """Makes mutants, or renders the page alone."""
    parser = campaign.parser(__doc__, jobs=2, page=False)
    parser.add_argument("--functions", help="comma-separated; default: all")
    given = parser.parse_args()
    os.chdir(campaign.ROOT)
    if given.page:
        CAMPAIGN.render()
        return
    from traceability import campaign as mutants
    from traceability.equations import subjects
    from traceability.lines import functions

    def say(found: mutants.Found) -> None:
        caught = found.comparison + found.tests
        print(f"{found.function}: {caught} of {found.mutants} noticed {'; '.join(found.survivors)}", flush=True)

    mutants.collected()
    known = functions()
    wanted = given.functions.split(",") if given.functions else list(known)
    old = CAMPAIGN.result()
    found = old.figures["functions"] | {each["function"]: each for each in mutants.campaign(wanted, given.jobs, say)}
    kept = {name: {**found[name], "subjects": subjects(known[name])} for name in known if name in found}
    CAMPAIGN.keep({"functions": kept})


if __name__ == "__main__":
    main()
