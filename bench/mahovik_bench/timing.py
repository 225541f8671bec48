"""Interleaved timing: every repetition runs one short block of each contestant, so that all see the same machine."""

from __future__ import annotations

import random
import statistics
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from mahovik.proof.reference import pieces
from mahovik.proof.reference.evaluate import evaluate
from mahovik_bench.cases import Case
from mahovik_bench.contestant import Contestant
from mahovik_bench.works import Work

BLOCK = 40_000.0
"""Nanoseconds of a block: short against a time slice, long against the clock's reading."""
FEW = 9
"""Repetitions in which NumPy takes part."""
NUMPY = "numpy reference"


@dataclass(frozen=True)
class Times:
    """Times of one contestant in one work: ns per state in each repetition."""

    rounds: tuple[float, ...]

    @property
    def least(self) -> float:
        """The fastest repetition."""
        return min(self.rounds)

    @property
    def median(self) -> float:
        """The usual one."""
        return statistics.median(self.rounds)

    @property
    def spread(self) -> float:
        """How far the usual one is above the fastest, as a part of it: the load of the machine."""
        return self.median / self.least - 1.0


def ratio(slow: Times, fast: Times) -> float:
    """How many times faster: the median of paired repetitions."""
    return statistics.median(a / b for a, b in zip(slow.rounds, fast.rounds, strict=False))


def times(
    case: Case, work: Work, contestants: Sequence[Contestant], chained: bool, repetitions: int
) -> Mapping[str, Times]:
    """All that have the work, in a new order every repetition; NumPy too, where the reference has it.

    States of a batch do not wait for one another: no batch is chained.
    """
    taking = [c for c in contestants if work.name in c.peer.works and not (chained and c.peer.states > 1)]
    blocks = {c.name: c.block(work, chained) for c in taking}
    calls = {c.name: _calls(blocks[c.name], c.peer.states) for c in taking}
    order = random.Random(0)
    seconds: dict[str, list[float]] = {name: [] for name in blocks}
    slow: list[float] = []
    for repetition in range(repetitions):
        names = list(blocks)
        order.shuffle(names)
        for name in names:
            seconds[name].append(blocks[name](calls[name]))
        if work.parts and not chained and repetition < FEW:
            slow.append(_numpy(case, work, repetition))
    taken = {name: Times(tuple(rounds)) for name, rounds in seconds.items()}
    return {**taken, NUMPY: Times(tuple(slow))} if slow else taken


def _calls(block: Callable[[int], float], states: int) -> int:
    """Number of calls, each of a number of states, that fill a block."""
    block(1)
    return max(1, int(BLOCK / (states * min(block(4) for _ in range(3)))))


def _numpy(case: Case, work: Work, repetition: int) -> float:
    """One evaluation of the reference, ns."""
    state = case.states[repetition % len(case.states)]
    start = time.perf_counter_ns()
    if work.name == "forward":
        from mahovik.proof.reference.motion import forward

        at = pieces(case.stand, state)
        forward(at, at.phi_dot)
    else:
        evaluate(case.stand, state, [work.name])
    return float(time.perf_counter_ns() - start)
