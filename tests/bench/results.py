"""Made-up results of a run, as the page takes them; nothing is timed."""

from __future__ import annotations

from typing import Any

from mahovik_bench.works import WORKS

OWN = ("mahovik -O2", "mahovik -O3 native")
NUMPY = "numpy reference"


def row(ns: float, ours: dict[str, float]) -> dict[str, Any]:
    """Figures of a contestant that takes `ns`, always."""
    return {
        "least": ns,
        "median": ns,
        "spread": 0.02,
        "ratios": {name: ns / own for name, own in ours.items()},
    }


def results(peer: float = 10.0, load: float = 0.5) -> dict[str, Any]:
    """N = 2, 6, 8; a peer that takes `peer` times as long as our scalar build."""
    cases = {}
    for N in (2, 6, 8):
        ours = dict(zip(OWN, (20.0 + 10 * N, 15.0 + 8 * N), strict=True))
        lines = {**{name: row(ns, ours) for name, ns in ours.items()}, "casadi ldl -O2": row(peer * ours[OWN[0]], ours)}
        times = dict.fromkeys(WORKS, lines)
        counts = dict.fromkeys(WORKS, 100 + 300 * N)
        effort = {"seconds": 1.5, "memory": 80.0}
        cases[str(N)] = {
            "agreement": {"forward": dict.fromkeys(lines, 1e-16)},
            "instructions": {OWN[0]: counts},
            "made": {OWN[0]: {"text": 50_000, "data": 2_000, "compiled": effort, "generated": effort}},
            "times": {
                "independent": {**times, "forward": {**lines, NUMPY: row(1e6, ours)}},
                "chained": times,
            },
        }
    return {
        "machine": {"processor": "made up", "vectors": "AVX2", "cores": "2", "system": "none"},
        "versions": {"mahovik": "0", "gcc": "gcc 0"},
        "repetitions": 10,
        "absent": {"sympy": "not installed"},
        "flags": {OWN[0]: "gcc -std=c99 -O2"},
        "cases": cases,
        "load": {"before": load, "after": load},
    }
