"""Nanoseconds a state of `Model.forward`, beside the same batch C on arrays that lie ready: docs/results/python.md.

python tools/api_speed.py [--print]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from marked import put
from processor import processor

import mahovik
from mahovik.core.toolchain.board import version
from mahovik.core.toolchain.compiler import find_compiler
from mahovik.out.api.compiled import compiled

PAGE = Path(__file__).resolve().parents[1] / "docs" / "results" / "python.md"
BEGIN, END = "<!-- speed -->", "<!-- end of speed -->"
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


def rows() -> list[str]:
    """A row a number of states."""
    stand = mahovik.example("bench8")
    model, library = mahovik.build(stand), compiled(stand, "double", np.dtype(np.float64), None, parallel=False)
    rng = np.random.default_rng(1)
    count = len(stand.flywheels)
    found = []
    for n in COUNTS:
        x = model.states(n, V=rng.normal(size=(n, 6)), phi=rng.uniform(-3, 3, (n, count)), phi_dot=100.0)
        by_state = rng.normal(size=(n, count))
        by_component = np.asfortranarray(by_state)
        arrays = [
            library.tables["stand"],
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
        cells = [f"{n:,}", *(f"{t / n * 1e9:,.0f}" for t in (alone, ready, turned)), f"{turned / alone - 1:.0%}"]
        found.append(f"| {' | '.join(cells)} |")
    return found


def main() -> None:
    """Writes the table between the marks of the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--print", action="store_true", help="to the terminal, not into the page")
    given = parser.parse_args()
    head = [
        "",
        f"`forward` of `bench8`, one thread; {version(find_compiler()[0])}, {processor()}.",
        "",
        "| states | C, ns a state | `forward`, by component | `forward`, by state | more than C |",
        "|---:|---:|---:|---:|---:|",
    ]
    lines = [*head, *rows(), ""]
    if given.print:
        print("\n".join(lines))
    else:
        put(PAGE, BEGIN, END, lines)


if __name__ == "__main__":
    main()
