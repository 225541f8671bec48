"""Do all give the same? Differences to the NumPy reference over the natural scale."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik_bench.cases import Case
from mahovik_bench.loaded import Contestant
from mahovik_bench.works import WORKS

ACCEPTED = 1e-11


def differences(case: Case, contestants: Sequence[Contestant]) -> dict[str, dict[str, float]]:
    """The largest difference, by work and contestant; of works that the reference has."""
    found: dict[str, dict[str, float]] = {}
    for work in WORKS.values():
        having = [c for c in contestants if work.name in c.peer.works]
        if not work.parts or not having:
            continue
        expected, scale = case.expected(work)
        found[work.name] = {
            c.name: float(np.max(np.abs(c.results(work) - expected) / np.maximum(scale, 1e-300))) for c in having
        }
    return found


def failures(found: dict[str, dict[str, float]]) -> list[str]:
    """Those beyond what is accepted, NaN among them."""
    return [
        f"{work}: {name} is {worst:.1e} off the reference"
        for work, by_name in found.items()
        for name, worst in by_name.items()
        if not worst <= ACCEPTED
    ]
