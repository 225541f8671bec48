"""Nanoseconds a state of `Model.forward`, beside the same batch C on arrays that lie ready: docs/results/python.md.

python tools/api_speed.py [--print]
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from measure_speed import measure_speed

import mahovik
from mahovik.out.api.compiled import compile_library

COUNTS = (1, 10, 100, 1000, 10_000, 100_000)
ROUNDS = 40
ROUND = 0.01  # s, of each candidate


def seconds(candidates: Sequence[Callable[[], object]]) -> list[float]:
    """Time of one call of each: the least of rounds in which they take turns, so that a busy machine hits all alike."""
    repeats = []
    for call in candidates:
        call()
        begin = time.perf_counter()
        call()
        repeats.append(max(1, int(ROUND / (time.perf_counter() - begin))))
    best = [float("inf")] * len(candidates)
    for _ in range(ROUNDS):
        for i, (call, times) in enumerate(zip(candidates, repeats, strict=True)):
            begin = time.perf_counter()
            for _ in range(times):
                call()
            best[i] = min(best[i], (time.perf_counter() - begin) / times)
    return best


def rows() -> list[tuple[float, ...]]:
    """One row for each number of states."""
    stand = mahovik.example("bench8")
    model, library = mahovik.build(stand), compile_library(stand, "double", np.dtype(np.float64), None, parallel=False)
    rng = np.random.default_rng(1)
    count = len(stand.flywheels)
    found = []
    for n in COUNTS:
        x = model.states(n, V=rng.normal(size=(n, 6)), phi=rng.uniform(-3, 3, (n, count)), phi_dot=100.0)
        by_state = rng.normal(size=(n, count))
        by_component = np.asfortranarray(by_state)
        arrays = [
            library.tables["table"],
            np.ascontiguousarray(x.array.T),
            np.ascontiguousarray(by_state.T),
            np.empty((6, n)),
        ]
        status = np.zeros(n, dtype=np.int32)
        alone, ready, turned = seconds(
            [
                lambda n=n, arrays=arrays, status=status: library.library.call("forward", n, arrays, status),
                lambda x=x, a=by_component: model.forward(x, a),
                lambda x=x, a=by_state: model.forward(x, a),
            ]
        )
        found.append((n, *(t / n * 1e9 for t in (alone, ready, turned)), turned / alone - 1))
    return found


TABLE = Columns(
    {
        "states": "{:,}", "C, ns a state": "{:,.0f}", "`forward`, by component": "{:,.0f}",
        "`forward`, by state": "{:,.0f}", "more than C": "{:.0%}",
    },
    0,
)  # fmt: skip


def page(found: Figures) -> str:
    """The table."""
    return (
        f"`forward` of `bench8`, one thread; {found['compiler']}, {found['processor']}.\n\n{TABLE.text(found['rows'])}"
    )


CAMPAIGN = Campaign(
    "python",
    campaign.Block("docs/results/python.md", "speed"),
    page,
)


if __name__ == "__main__":
    measure_speed(__doc__, CAMPAIGN, TABLE, rows)
