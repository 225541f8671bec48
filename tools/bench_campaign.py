"""The campaign of `python -m mahovik_bench`: docs/results/benchmarks.md is rendered from its kept figures."""

from __future__ import annotations

import sys

import campaign
from kept import Campaign, Figures

sys.path.insert(0, str(campaign.ROOT / "bench"))


def page(found: Figures) -> str:
    """The figures as Markdown."""
    from mahovik_bench.page import page as tables

    return tables(found)


CAMPAIGN = Campaign(
    "benchmarks",
    campaign.Block("docs/results/benchmarks.md", "figures: bench/mahovik_bench"),
    page,
)
