"""Nanoseconds a stand: tables of distinct stands and what is computed with them, beside the batch C alone.

python tools/tables_speed.py [--print]

Writes docs/results/tables.md. `bench8`, the unbalance of all flywheels and the mass of the carrier vary.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import campaign
import numpy as np
from kept import Campaign, Columns, Figures
from measure_speed import measure_speed

import mahovik
from mahovik.out.api.compiled import CompiledLibrary, compile_library
from mahovik.out.api.samples import Samples
from mahovik.out.api.tables import prepare_arguments
from mahovik.out.api.variants import variants

COUNTS = (8, 100, 1000, 10_000)
STEP = 1e-4  # s

ROUNDS = 60
ROUND = 0.004  # s, of each candidate

LIMIT = 4.0
"""`forward` of distinct stands, prepare included, takes at most this times the batch `forward` of one stand."""
SHARE = 0.85
"""Part of the speed of the batch C that `step` of Python keeps, in a loop over 1,000 tables."""


def seconds(candidates: Sequence[Callable[[], object]]) -> Any:
    """Time of one call of each, in rounds in which they take turns, (rounds, candidates).

    A busy machine hits the candidates of one round alike: ratios are those of rounds, and of these the median.
    """
    repeats = []
    for call in candidates:
        call()
        begin = time.perf_counter()
        call()
        repeats.append(max(1, int(ROUND / (time.perf_counter() - begin))))
    found = np.empty((ROUNDS, len(candidates)))
    for row in found:
        for i, (call, times) in enumerate(zip(candidates, repeats, strict=True)):
            begin = time.perf_counter()
            for _ in range(times):
                call()
            row[i] = (time.perf_counter() - begin) / times
    return found


def changes(flywheels: tuple[str, ...], mass: float, n: int) -> dict[str, Any]:
    """What differs between the stands."""
    rng = np.random.default_rng(1)
    found: dict[str, Any] = {"carrier.mass": mass * (1 + 1e-2 * rng.uniform(-1, 1, n))}
    for name in flywheels:
        found[f"{name}.unbalance.static"] = 1e-6 * rng.uniform(0.1, 1, n)
        found[f"{name}.unbalance.static_at"] = rng.uniform(-np.pi, np.pi, n)
        found[f"{name}.unbalance.dynamic"] = 1e-8 * rng.uniform(0.1, 1, n)
        found[f"{name}.unbalance.dynamic_at"] = rng.uniform(-np.pi, np.pi, n)
    return found


def rows() -> list[tuple[Any, ...]]:
    """One row for each number of stands."""
    stand = mahovik.example("bench8")
    model = mahovik.build(stand)
    library = compile_library(stand, "double", np.dtype(np.float64), None, parallel=False)
    return [_row(model, library, n) for n in COUNTS]


def _row(model: mahovik.Model, library: CompiledLibrary, n: int) -> tuple[Any, ...]:
    rng, count, element = np.random.default_rng(2), len(model.flywheels), np.dtype(np.float64)
    given = changes(model.flywheels, model.stand.carrier.mass, n)
    found = variants(mahovik.Stand.of(model.stand), "double", Samples.of(given, None))
    tables = model.tables(given)
    x = model.states(n, V=rng.normal(size=(n, 6)), phi=rng.uniform(-3, 3, (n, count)), phi_dot=100.0)
    state, wheel = np.ascontiguousarray(x.array.T), np.asfortranarray(rng.normal(size=(n, count)) * 1e-3)
    turned = np.ascontiguousarray(wheel.T)
    V_dot, later, status = np.empty((6, n)), np.empty_like(state), np.zeros(n, dtype=np.int32)
    locked, dt, order = np.zeros(count, np.int32), np.array([STEP]), np.array([2], np.int32)
    block = tables.block("table")
    ready, _columns = prepare_arguments(library, element, found, {"table": block})

    call, call_of = library.library.call, library.of_tables.call
    rounds = seconds(
        [
            lambda: call("forward", n, [library.tables["table"], state, turned, V_dot], status),
            lambda: call_of("forward_of", n, [block, state, turned, V_dot], status),
            lambda: call_of("prepare", n, ready, status),
            lambda: call_of("step_of", n, [block, state, turned, locked, dt, order, later], status),
            lambda: model.step(x, STEP, wheel, order=2, tables=tables),
            lambda: model.tables(given),
        ]
    )
    alone, each, prepare, step, python, whole = rounds.T
    both, kept = np.median((each + prepare) / alone), np.median(step / python)
    times = [float(np.median(t)) * 1e9 / n for t in (alone, each, prepare, step, python, whole)]
    return (n, *times[:3], float(both), *times[3:5], float(kept), times[5] / 1e3)


TABLE = Columns(
    {
        "stands": "{:,}", "batch `forward`, one stand, ns": "{:,.0f}", "distinct stands, ns": "{:,.0f}",
        "`prepare`, ns": "{:,.0f}", "both, times one stand": "{:.1f}", "ns a step of order 2": "{:,.0f}",
        "by Python, ns": "{:,.0f}", "part kept": "{:.0%}", "`model.tables`, µs": "{:,.1f}",
    },
    0,
)  # fmt: skip


def page(found: Figures) -> str:
    """The table, and whether the limits hold."""
    title = list(TABLE.forms)
    row = next(row for row in found["rows"] if row["stands"] == 1000)
    limits = (
        f"With 1,000 tables: `forward` of distinct stands, `prepare` included, takes {row[title[4]]:.1f} times the "
        f"batch `forward` of one stand (wanted: at most {LIMIT:g}); `model.step(..., tables=tables)` keeps "
        f"{row[title[7]]:.0%} of the speed of the batch C (wanted: at least {SHARE:.0%})."
    )
    head = f"`bench8`, one thread, a stand; {found['compiler']}, {found['processor']}."
    return f"{head}\n\n{TABLE.text(found['rows'])}\n\n{limits}"


CAMPAIGN = Campaign(
    "tables",
    campaign.Block("docs/results/tables.md", "speed"),
    page,
)


if __name__ == "__main__":
    measure_speed(__doc__, CAMPAIGN, TABLE, rows)
