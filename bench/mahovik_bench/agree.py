"""Do all give the same? Differences to the NumPy reference over the natural scale."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik_bench.cases import Array, Case
from mahovik_bench.contestant import Contestant
from mahovik_bench.works import WORKS

ACCEPTED = 1e-11


def differences(case: Case, contestants: Sequence[Contestant]) -> dict[str, dict[str, float]]:
    """The largest difference, by work and contestant; of works that the reference has."""
    worst: dict[str, dict[str, float]] = {}
    for work in WORKS.values():
        having = [c for c in contestants if work.name in c.peer.works]
        if not work.parts or not having:
            continue
        expected, scale = case.expected(work)
        worst[work.name] = {
            c.name: float(np.max(np.abs(c.results(work) - expected) / np.maximum(scale, 1e-300))) for c in having
        }
    return worst


def slope_differences(case: Case, contestants: Sequence[Contestant]) -> dict[str, dict[str, float]]:
    """Differences of the Jacobians: peers against our first build, relative to the largest of each block."""
    differences: dict[str, dict[str, float]] = {}
    for name, rows in (("forward_jacobian", 6), ("coupled_jacobian", 6 + case.N)):
        having = [c for c in contestants if name in c.peer.works]
        tables = {c.name: [_matrix(c, row, rows) for row in c.results(WORKS[name])] for c in having}
        first = next(iter(tables), "")
        differences[name] = {
            other: max(_block_difference(a, b, case.N) for a, b in zip(table, tables[first], strict=True))
            for other, table in tables.items()
            if other != first
        }
    return differences


def _matrix(c: Contestant, numbers: Array, rows: int) -> Array:
    """Slopes of `rows` results by V and three times N inputs: ours lie block by block, those of others by columns."""
    N = c.case.N
    if c.peer.program != "mahovik":
        return numbers.reshape(6 + 3 * N, rows).T
    parts, at = [], 0
    for height in (6, rows - 6):
        blocks = []
        for width in (6, N, N, N):
            blocks.append(numbers[at : at + height * width].reshape(height, width))
            at += height * width
        parts.append(np.hstack(blocks))
    return np.vstack(parts)


def _block_difference(a: Array, b: Array, N: int) -> float:
    """The largest difference over the largest element of its block."""
    worst = 0.0
    for rows in (slice(0, 6), slice(6, None)):
        for start, width in ((0, 6), (6, N), (6 + N, N), (6 + 2 * N, N)):
            block = (rows, slice(start, start + width))
            if a[block].size:
                worst = max(worst, float(np.max(np.abs(a[block] - b[block])) / np.max(np.abs(b[block]))))
    return worst


def failures(differences: dict[str, dict[str, float]]) -> list[str]:
    """Differences beyond the accepted ones, and NaN, one line each."""
    return [
        f"{work}: {name} is {worst:.1e} off"
        for work, by_name in differences.items()
        for name, worst in by_name.items()
        if not worst <= ACCEPTED
    ]
