"""The figures that the project has set itself, and whether they are reached in a run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mahovik_bench.slopes import slope

SCALAR = "mahovik -O2"
LANES = "mahovik lanes native"
BATCH = "mahovik batch native"
NARROW = 2 / 3
"""Fraction of the required factors of lanes and batch on a processor without AVX-512."""

FACTORS: tuple[tuple[str, str, dict[int, float]], ...] = (
    ("forward", SCALAR, {2: 2.5, 6: 7, 8: 8, 12: 8, 64: 9}),
    ("forward", LANES, {2: 3, 6: 9, 8: 15, 12: 15, 64: 25}),
    ("coupled", SCALAR, {2: 1.6, 6: 4, 8: 4.5, 12: 4.3, 64: 4.2}),
    ("coupled", LANES, {2: 1.8, 6: 5.5, 8: 9, 12: 7.5, 64: 12}),
    ("torque", SCALAR, {2: 1.6, 6: 1.7, 8: 1.8, 12: 1.8, 64: 2.5}),
    ("torque", LANES, {2: 2.5, 6: 4, 8: 10, 12: 8, 64: 18}),
    ("forward", BATCH, {2: 20, 6: 37, 8: 40, 12: 42, 64: 44}),
)
"""Times faster than the best build of the best peer, by work, build and N."""
INSTRUCTIONS = {"forward": 3300, "coupled": 6200, "torque": 2300}
"""At most, at N = 8, of SCALAR."""
SLOPES = {("forward", SCALAR): 15.0, ("coupled", SCALAR): 28.0, ("forward", BATCH): 4.0}
"""At most, ns a further flywheel."""


@dataclass(frozen=True)
class Verdict:
    """One figure: what, for which N, what was asked and what was found; None where it was not measured."""

    what: str
    N: str
    asked: str
    found: str
    reached: bool | None


BY_HAND = "casadi table"
"""Peer with harmonics found by hand, which the figures of the targets did not know."""


def best_ratio(table: dict[str, Any], build: str) -> tuple[float, str] | None:
    """How many times faster `build` is than the peer that comes nearest, and who that is; BY_HAND does not count."""
    found = [
        (row["ratios"][build], name)
        for name, row in table.items()
        if not name.startswith(("mahovik ", BY_HAND)) and build in row["ratios"]
    ]
    return min(found) if found else None


def verdicts(results: dict[str, Any]) -> Iterator[Verdict]:
    """All figures of the issue, in its order."""
    part = 1.0 if results["machine"]["vectors"] == "AVX-512" else NARROW
    for work, build, wanted in FACTORS:
        for N, factor in wanted.items():
            asked = factor * (1.0 if build == SCALAR else part)
            table = results["cases"].get(str(N), {}).get("times", {}).get("independent", {}).get(work, {})
            found = best_ratio(table, build)
            what = f"`{work}`, {build.removeprefix('mahovik ')}"
            if found is None:
                yield Verdict(what, str(N), f"{asked:.1f} x", "", None)
            else:
                yield Verdict(what, str(N), f"{asked:.1f} x", f"{found[0]:.2f} x {found[1]}", found[0] >= asked)
    counts = results["cases"].get("8", {}).get("instructions", {}).get(SCALAR, {})
    for work, most in INSTRUCTIONS.items():
        count = counts.get(work)
        shown = "" if count is None else f"{count:,}"
        yield Verdict(
            f"`{work}`, -O2, instructions", "8", f"at most {most:,}", shown, None if count is None else count <= most
        )
    for (work, build), limit in SLOPES.items():
        line = slope(least(results, work, build))
        what = f"`{work}`, {build.removeprefix('mahovik ')}, ns a further flywheel"
        shown = "" if line is None else f"{line[0]:.1f}"
        yield Verdict(what, "slope", f"at most {limit:g}", shown, None if line is None else line[0] <= limit)


def least(results: dict[str, Any], work: str, name: str) -> dict[int, float]:
    """Least ns by N, of independent calls."""
    tables = {int(N): one["times"]["independent"][work] for N, one in results["cases"].items()}
    return {N: table[name]["least"] for N, table in tables.items() if name in table}


def counted(results: dict[str, Any], work: str, name: str) -> dict[int, float]:
    """Instructions by N."""
    tables = {int(N): one["instructions"].get(name, {}) for N, one in results["cases"].items()}
    return {N: float(table[work]) for N, table in tables.items() if work in table}
