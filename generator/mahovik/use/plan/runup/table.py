"""Run-up and run-down of a programme: solution, table, and report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.runup.limits import measure, shares
from mahovik.use.plan.runup.solve import Found, solve, table_of

UNITS = {"speed": "rad/s", "acceleration": "rad/s2", "torque": "N m"}


def with_runup(
    stand: Stand,
    motion: RequiredMotion,
    programme: Programme,
    seed: int = 0,
    budget: Budget | None = None,
    say: Callable[[str], None] | None = None,
) -> Programme:
    """The programme with the tables `runup` and `rundown` that the motion file requests, and their report.

    A table that was not found is left out; its report has the reason under `reason`. Without `runup` in the motion file
    nothing changes. The same arguments give the same result, unless time or Ctrl-C ends the `budget`: then a table not
    found yet is left out. The run-up has half of the remaining seconds. `say` receives the name of the current search.
    """
    if motion.runup is None or not programme.periodic:
        return programme
    mechanics = Mechanics.of(stand)
    tables: dict[str, RunUpTable | None] = {}
    report: dict[str, Any] = dict(programme.report)
    whole = budget or Budget(0)
    for key, up in (("runup", True), ("rundown", False)):
        own = Budget(0, whole.left(0.5 if up else 1.0), interrupted=whole.interrupted)
        if say is not None:
            say("run-up" if up else "run-down")
        try:
            found = solve(mechanics, motion, programme, motion.runup, up=up, seed=seed, budget=own)
        except KeyboardInterrupt:
            whole.interrupted = True
            tables[key], report[key] = None, {"reason": f"{'run-up' if up else 'run-down'}: interrupted"}
        except CheckError as error:
            tables[key], report[key] = None, {"reason": str(error)}
        else:
            table = RunUpTable(motion.runup, table_of(found.problem, found.flight))
            tables[key], report[key] = table, figures(found, motion, stand)
    return replace(programme, runup=tables["runup"], rundown=tables["rundown"], report=report)


def shortcomings(programme: Programme) -> tuple[str, ...]:
    """Problems of run-up and run-down, one per line: not found, or a bound exceeded."""
    lines = []
    for key in ("runup", "rundown"):
        told = programme.report.get(key, {})
        if "reason" in told:
            lines.append(told["reason"])
        lines += told.get("exceeded", ())
    return tuple(lines)


def figures(found: Found, motion: RequiredMotion, stand: Stand) -> dict[str, Any]:
    """Report of a run-up: terminal error, largest deviation and its time, peaks, exceeded bounds."""
    values, t = measure(found.problem, found.flight), found.problem.family.t
    name = "run-up" if found.problem.up else "run-down"
    at = np.argmax(values["deviation"], axis=0)
    exceeded = []
    for bound, share in shares(found.problem, found.flight, motion.bounds).by_name.items():
        i, k = np.unravel_index(int(np.argmax(share)), share.shape)
        if share[i, k] > 1.0:
            value = abs(float(values[bound][i, k]))
            unit = ("m", "rad")[k] if bound == "deviation" else UNITS[bound]
            whose = "" if bound == "deviation" else f" of {stand.flywheels[k].name}"
            exceeded.append(
                f"{name}: {bound}{whose} {value:.4g} {unit} at t = {t[i]:.4g} s exceeds its bound, "
                f"{value / share[i, k]:.4g} {unit}"
            )
    return {
        "terminal_error": found.error,
        "steps": found.steps,
        "attempts": found.attempts,
        "deviation": {
            kind: {"largest": float(values["deviation"][i, k]), "t": float(t[i])}
            for k, (kind, i) in enumerate(zip(("linear", "angular"), at, strict=True))
        },
        "peak": {key: np.abs(values[key]).max(axis=0).tolist() for key in UNITS},
        "exceeded": exceeded,
    }
