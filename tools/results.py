"""Render every page of docs/results from the figures that are kept beside it, `docs/results/*.json`.

python tools/results.py [--check]

A second or two. `--check`: writes nothing, exit status 1 where a page is not what its figures say.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from importlib import import_module

import campaign
from kept import Campaign

TOOLS = (
    "verify_campaign",
    "float_bounds",
    "jitter_campaign",
    "identify_campaign",
    "linear_campaign",
    "plan_campaign",
    "refusal_campaign",
    "runup_campaign",
    "ocp_campaign",
    "design_campaign",
    "excite_campaign",
    "quiet_campaign",
    "balance_campaign",
    "measured_speed",
    "following_campaign",
    "attitude_loop",
    "control_loop",
    "pil",
    "api_speed",
    "tables_speed",
    "campaign_speed",
    "campaign_scale",
    "campaign_faults",
    "held_cost",
    "generation_time",
    "install_size",
    "fuzz_campaign",
    "static_checks",
    "targets_table",
    "proofs",
    "math_campaign",
    "explain_campaign",
    "terms_campaign",
    "audits_campaign",
    "rounding_campaign",
    "short_steps",
    "judges_table",
    "planted_faults",
    "traceability_campaign",
    "bench_campaign",
)
"""Modules that hold campaigns."""


def campaigns() -> Iterator[Campaign]:
    """All campaigns, in the order of TOOLS."""
    for tool in TOOLS:
        for value in vars(import_module(tool)).values():
            if isinstance(value, Campaign):
                yield value


def outdated_pages() -> list[str]:
    """Pages with a part that is not what the kept figures say."""
    found = []
    for each in campaigns():
        parts = [(each.block, each.text()), *((block, page(each.figures())) for block, page in each.also)]
        found += [block.page for block, text in parts if block.text() != text.strip("\n")]
    return found


def main() -> None:
    """Render or check."""
    asked = campaign.parser(__doc__, check=False).parse_args()
    if asked.check:
        print(*outdated_pages(), sep="\n")
        sys.exit(1 if outdated_pages() else 0)
    for each in campaigns():
        each.render()


if __name__ == "__main__":
    main()
