"""The benchmark: builds, compares, counts and times every contestant, as rows of numbers."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib import import_module
from typing import Any

from mahovik.errors import ToolchainError
from mahovik_bench import counting
from mahovik_bench.agree import differences, failures, slope_differences
from mahovik_bench.build import Built
from mahovik_bench.cases import Case, case
from mahovik_bench.contestant import Contestant, Peer
from mahovik_bench.timing import NUMPY, Times, ratio, times
from mahovik_bench.works import WORKS

PROGRAMS = {
    "mahovik": "own",
    "casadi": "casadi_peer",
    "pinocchio": "pinocchio_peer",
    "mujoco": "mujoco_peer",
    "symforce": "symforce_peer",
}
"""Program to module; each has `peers(case)`."""

SCALAR = "mahovik -O2"
"""What others are compared with: the scalar C, as firmware is built."""

JOBS = 2

Row = dict[str, Any]


def measure(
    sizes: Sequence[int], programs: Sequence[str], repetitions: int, budget: float, say: Callable[[str], None]
) -> Iterator[Row]:
    """A row for each work, number of flywheels and contestant.

    `least`, `median`, `chained`: ns of a state, alone and where each call waits for the one before; `ratio`: how many
    times longer than SCALAR, the median of pairs; `instructions` by callgrind; `difference` from the NumPy reference,
    over the natural scale; `code` bytes, `compiled` and `generated` seconds. None where there is no figure. No
    compiling begins after `budget` seconds. `say` is called with who does not take part, and why. Raises
    ToolchainError where results do not agree: then no figure counts.
    """
    cases = [case(N) for N in sizes]
    built = build(cases, programs, budget, say)
    for one in cases:
        contestants = [Contestant(peer, library, one) for peer, library in built[one.N]]
        agreement = differences(one, contestants) | slope_differences(one, contestants)
        if wrong := failures(agreement):
            raise ToolchainError(f"N = {one.N}: {'; '.join(wrong)}")
        instructions = {c.name: count(c, say) for c in contestants if c.peer.counted}
        timed = [c for c in contestants if c.peer.timed]
        for work in WORKS.values():
            alone = times(one, work, timed, False, repetitions)
            chained = times(one, work, timed, True, repetitions)
            for c in contestants:
                if work.name in c.peer.works:
                    yield {
                        "work": work.name,
                        "flywheels": one.N,
                        "program": c.name,
                        **figures(alone, chained, c.name),
                        "instructions": instructions.get(c.name, {}).get(work.name),
                        "difference": agreement.get(work.name, {}).get(c.name),
                        "code": c.built.text,
                        "compiled": c.built.compiled.seconds,
                        "generated": c.peer.generation.seconds or None,
                    }
            if NUMPY in alone:
                yield {"work": work.name, "flywheels": one.N, "program": NUMPY, **figures(alone, chained, NUMPY)}
        say(f"N = {one.N}: {len(contestants)} libraries agree, counted and timed")


def figures(alone: Mapping[str, Times], chained: Mapping[str, Times], name: str) -> dict[str, float | None]:
    """Times of a contestant in one work."""
    taken = alone.get(name)
    if taken is None:
        return dict.fromkeys(("least", "median", "chained", "ratio"))
    return {
        "least": taken.least,
        "median": taken.median,
        "chained": chained[name].median if name in chained else None,
        "ratio": ratio(taken, alone[SCALAR]) if SCALAR in alone else None,
    }


def count(c: Contestant, say: Callable[[str], None]) -> dict[str, int]:
    """Instructions of a contestant's works, as far as callgrind can count them."""
    if not counting.available():
        say("no instructions are counted: apt-get install valgrind")
        return {}
    try:
        return counting.instructions(c.peer, c.built, c.case)
    except ToolchainError as error:
        say(f"instructions of {c.name}: {error}")
        return {}


def build(
    cases: Sequence[Case], programs: Sequence[str], budget: float, say: Callable[[str], None]
) -> dict[int, list[tuple[Peer, Built]]]:
    """Libraries by number of flywheels, of those programs that are installed and compile within the budget."""
    deadline = time.monotonic() + budget

    def listed(pair: tuple[Case, str]) -> list[tuple[Case, Peer]]:
        one, program = pair
        try:
            return [(one, peer) for peer in import_module(f"mahovik_bench.{PROGRAMS[program]}").peers(one)]
        except (ImportError, OSError, ToolchainError) as error:
            say(f"{program}, N = {one.N}: {error}")
            return []

    def compiled(pair: tuple[Case, Peer]) -> tuple[int, Peer, Built] | None:
        one, peer = pair
        try:
            if peer.recipe.made() or time.monotonic() < deadline:
                return one.N, peer, peer.recipe.build()
            say(f"{peer.name}, N = {one.N}: the budget was over before it was compiled")
        except ToolchainError as error:
            say(f"{peer.name}, N = {one.N}: {error}")
        return None

    with ThreadPoolExecutor(max_workers=JOBS) as pool:
        wanted = [(one, program) for program in programs for one in reversed(cases)]
        pairs = [pair for jobs in pool.map(listed, wanted) for pair in jobs]
        libraries = [made for made in pool.map(compiled, pairs) if made is not None]
    return {one.N: [(peer, library) for N, peer, library in libraries if N == one.N] for one in cases}
