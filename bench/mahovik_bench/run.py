"""The whole benchmark, as plain data: what page and tables are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict
from typing import Any

from mahovik.errors import ToolchainError
from mahovik_bench import counting, machine
from mahovik_bench.agree import differences, failures, slope_differences
from mahovik_bench.cases import case
from mahovik_bench.loaded import Contestant
from mahovik_bench.roster import Roster
from mahovik_bench.timing import Times, ratio, times
from mahovik_bench.works import WORKS

OWN = "mahovik"


def run(
    Ns: Sequence[int], programs: Sequence[str], repetitions: int, budget: float, say: Callable[[str], None]
) -> dict[str, Any]:
    """Builds, compares, counts and times. Raises ToolchainError where results do not agree: then no figure counts."""
    cases = {N: case(N) for N in Ns}
    roster = Roster(list(cases.values()), programs, budget, say)
    before = machine.load()
    found: dict[str, Any] = {
        "machine": machine.machine(),
        "versions": machine.versions(),
        "repetitions": repetitions,
        "absent": roster.absent,
        "flags": {},
        "cases": {},
    }
    for N, each in cases.items():
        contestants = [Contestant(peer, built, each) for peer, built in roster.built[N]]
        agreement = differences(each, contestants) | slope_differences(each, contestants)
        if wrong := failures(agreement):
            raise ToolchainError(f"N = {N}: {'; '.join(wrong)}")
        timed = [c for c in contestants if c.peer.timed]
        found["flags"] |= {c.name: shown_command(c.peer.recipe.compiler, c.peer.recipe.flags) for c in contestants}
        found["cases"][str(N)] = {
            "agreement": agreement,
            "instructions": _counts(contestants, found["absent"]),
            "made": {c.name: _build_record(c) for c in contestants},
            "times": {
                mode: {
                    name: _table(times(each, work, timed, mode == "chained", repetitions))
                    for name, work in WORKS.items()
                }
                for mode in ("independent", "chained")
            },
        }
        say(f"N = {N}: {len(contestants)} libraries agree, counted and timed")
    found["load"] = {"before": before, "after": machine.load()}
    return found


def shown_command(compiler: str, flags: Sequence[str]) -> str:
    """The command that matters: without the case's definitions and folders."""
    return " ".join([compiler, *(f for f in flags if not f.startswith(("-D", "-I", "-isystem")))])


def _counts(contestants: Sequence[Contestant], absent: dict[str, str]) -> dict[str, dict[str, int]]:
    if not counting.available():
        absent["instruction counts"] = "no valgrind with its header: apt-get install valgrind"
        return {}
    found = {}
    for c in contestants:
        if c.peer.counted:
            try:
                found[c.name] = counting.instructions(c.peer, c.built, c.case)
            except ToolchainError as error:
                absent[f"instructions of {c.name}"] = str(error)
    return found


def _build_record(c: Contestant) -> dict[str, Any]:
    return {
        "text": c.built.text,
        "data": c.built.data,
        "compiled": asdict(c.built.compiled),
        "generated": asdict(c.peer.generation),
    }


def _table(taken: Any) -> dict[str, Any]:
    """Figures of each contestant; `ratios`: how many times slower than each of our builds, paired."""
    own: dict[str, Times] = {name: t for name, t in taken.items() if name.startswith(f"{OWN} ")}
    return {
        name: {
            "least": t.least,
            "median": t.median,
            "spread": t.spread,
            "ratios": {build: ratio(t, ours) for build, ours in own.items()},
        }
        for name, t in taken.items()
    }
