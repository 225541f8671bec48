"""The figures that the project has set itself, and whether they are reached in a run: ratios within it, and counts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

SCALAR = "mahovik -O2"
NATIVE = "mahovik -O3 native"
BATCH = "mahovik batch native"

INSTRUCTIONS: dict[tuple[str, int], int] = {
    ("forward", 8): 2850,
    ("coupled", 8): 5300,
    ("torque", 8): 1920,
    ("inverse_fast", 8): 9315,
    ("forward_jacobian", 8): 17531,
    ("coupled_jacobian", 8): 47079,
    ("forward", 2): 1020,
}
"""At most, of SCALAR, by work and N. The last three at N = 8 are a tenth less than before."""
SPOILED = 1.05
"""Flags that a user tries first, NATIVE, take at most this share of the time of SCALAR, in every work at every N."""
BATCHES: dict[str, float] = {"coupled": 1.42, "torque": 0.50}
"""At most this share of the time of `forward`, by BATCH at N = 8."""


@dataclass(frozen=True)
class Verdict:
    """One figure: what, for which N, what was asked and what was found; None where it was not measured."""

    what: str
    N: str
    asked: str
    found: str
    reached: bool | None


def verdicts(results: dict[str, Any]) -> Iterator[Verdict]:
    """All figures: instructions, then ratios of times."""
    for (work, N), most in INSTRUCTIONS.items():
        count = results["cases"].get(str(N), {}).get("instructions", {}).get(SCALAR, {}).get(work)
        shown = "" if count is None else f"{count:,}"
        reached = None if count is None else count <= most
        yield Verdict(f"`{work}`, -O2, instructions", str(N), f"at most {most:,}", shown, reached)
    for N, one in results["cases"].items():
        for work, table in one["times"]["independent"].items():
            if NATIVE in table:
                share = table[NATIVE]["ratios"][SCALAR]
                yield _ratio(f"`{work}`, -O3 native over -O2", N, share, SPOILED)
    for work, limit in BATCHES.items():
        own, other = (least(results, each, BATCH).get(8) for each in (work, "forward"))
        share = None if own is None or other is None else own / other
        yield _ratio(f"`{work}` over `forward`, batch native", "8", share, limit)


def _ratio(what: str, N: str, share: float | None, most: float) -> Verdict:
    """A verdict on a ratio of times."""
    if share is None:
        return Verdict(what, N, f"at most {most:.2f}", "", None)
    return Verdict(what, N, f"at most {most:.2f}", f"{share:.2f}", share <= most)


def least(results: dict[str, Any], work: str, name: str) -> dict[int, float]:
    """Least ns by N, of independent calls."""
    tables = {int(N): one["times"]["independent"][work] for N, one in results["cases"].items()}
    return {N: table[name]["least"] for N, table in tables.items() if name in table}


def counted(results: dict[str, Any], work: str, name: str) -> dict[int, float]:
    """Instructions by N."""
    tables = {int(N): one["instructions"].get(name, {}) for N, one in results["cases"].items()}
    return {N: float(table[work]) for N, table in tables.items() if work in table}
