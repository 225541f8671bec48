"""Inputs that every function must refuse, not finite or out of range, with its outputs untouched."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from mahovik.contract.quantities import QUANTITIES
from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.function import Program
from mahovik.proof.verify.compare import Row

Call = Callable[[str, Mapping[str, Any]], tuple[int, bool]]
"""Function name, inputs by argument name; status, and whether its outputs are untouched."""


def refusals(program: Program, inputs: Mapping[str, Any], call: Call) -> Row:
    """Every function of a state with one bad number at a time. `inputs` is a good state by argument name."""
    real = program.precision.name
    limits = {row.symbol: row.limits(real) for row in QUANTITIES.values() if row.input}
    limits |= {"sine": (2.0,), "cosine": (2.0,)}
    row = Row("", "bad inputs refused, outputs untouched", verdict="ok")
    for function in program.functions:
        names = {a.name for a in function.arguments if a.direction == "in"}
        if not function.public or not names & {"x", "angles"}:
            continue
        for where, value, bad, expected in bad_inputs({n: v for n, v in inputs.items() if n in names}, limits):
            if where.startswith("attitude") and "angles" in names:
                continue  # not read
            status, untouched = call(function.name, bad)
            row.states += 1
            words = f"{function.name}: {where} = {value:g}"
            if status != STATUS_VALUES[expected]:
                row.verdict, row.state, row.reason = "FAILED", words, f"status {status}, expected {expected}"
            elif not untouched:
                row.verdict, row.state, row.reason = "FAILED", words, "refused, but outputs were written"
    return row


def bad_inputs(
    inputs: Mapping[str, Any], limits: Mapping[str, tuple[float, ...]]
) -> Iterator[tuple[str, float, dict[str, Any], str]]:
    """Copies of the inputs with one bad number each: where, the number, the inputs, the status that is due."""
    paths = [("x", name) for name in inputs.get("x", {})] + [(name,) for name in inputs if name in limits]
    for path in paths:
        name = path[-1]
        count = len(_at(inputs, path))
        if name == "attitude":
            yield _with(inputs, path, None, 1.01)
            yield _with(inputs, path, None, 0.99)
        for index in range(count):
            bad = [math.nan, math.inf, -math.inf]
            given = limits.get(name)
            if given is not None:
                limit = given[index % len(given)] * (1 + 1e-6)
                bad += [limit, -limit]
            for value in bad:
                yield _with(inputs, path, index, value)


def _with(
    inputs: Mapping[str, Any], path: tuple[str, ...], index: int | None, value: float
) -> tuple[str, float, dict[str, Any], str]:
    """One number replaced; without index, all of them multiplied."""
    changed = dict(inputs)
    if path[0] == "x":
        changed["x"] = dict(inputs["x"])
    old = list(_at(inputs, path))
    new = [x * value for x in old] if index is None else [*old[:index], value, *old[index + 1 :]]
    holder = changed["x"] if path[0] == "x" else changed
    holder[path[-1]] = new
    where = path[-1] + ("" if index is None else f"[{index}]")
    return where, value, changed, "RANGE" if math.isfinite(value) else "NOT_FINITE"


def _at(inputs: Mapping[str, Any], path: tuple[str, ...]) -> Any:
    found: Any = inputs
    for name in path:
        found = found[name]
    return found
