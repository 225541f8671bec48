"""No function may become more expensive: instructions, stack and code on x86-64 against accepted figures."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from mahovik.core.toolchain.targets import TARGETS
from mahovik.proof.cost.check import Comparison, compare
from mahovik.proof.cost.measure import Costs, measure
from mahovik.proof.cost.page import as_json, read_accepted_costs
from mahovik_bench.build import ROOT
from mahovik_bench.cases import case

ACCEPTED = ROOT / "bench" / "accepted.json"
SIZES = (2, 8)
TARGET, REAL = "host", "double"


def costs(sizes: Sequence[int] = SIZES) -> dict[int, Costs]:
    """Costs of the stands of the benchmark, as `mahovik cost` measures them, by N."""
    return {N: measure(case(N).stand, [(TARGETS[TARGET], REAL)]) for N in sizes}


def text(found: dict[int, Costs]) -> str:
    """The accepted figures as they are kept."""
    kept = {str(N): json.loads(as_json(each)) for N, each in found.items()}
    return json.dumps(kept, indent=1) + "\n"


def compared(found: dict[int, Costs], kept: str) -> dict[int, Comparison]:
    """Comparison of measured with accepted costs, by number of flywheels."""
    before: dict[str, Any] = json.loads(kept)
    return {
        N: compare(each, read_accepted_costs(json.dumps(before[str(N)]), str(ACCEPTED)))
        for N, each in found.items()
        if str(N) in before
    }


def gate(accept: bool) -> list[str]:
    """Figures that have risen; with `accept` the figures of today are kept instead."""
    found = costs()
    if accept:
        ACCEPTED.write_text(text(found), encoding="utf-8")
        return []
    result = compared(found, ACCEPTED.read_text(encoding="utf-8"))
    for N, each in result.items():
        for line in each.other:
            print(f"N = {N}: not compared: {line}")
    return [f"N = {N}: {line}" for N, each in result.items() for line in each.rises]
