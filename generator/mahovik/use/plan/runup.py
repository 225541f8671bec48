"""Run-up from rest into a periodic programme, and run-down: by shooting, the carrier free to deviate on the way.

Coarse nodes first, then bounds, then nodes fine enough to trust; the table and its report.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Samples
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, StateError
from mahovik.use.numeric.mechanics import Mechanics
from mahovik.use.plan.objective import UNITS, ExceededBound
from mahovik.use.plan.outcome import Budget
from mahovik.use.plan.step import Range, Rules, descend, size
from mahovik.use.plan.transient import KEEP, NODES, Boundary, Flight

GOAL = 1e-8
"""Terminal error at the nodes, in amplitudes."""
ACCEPTED_ERROR = 1e-6
"""Accepted terminal error of the table, with nodes twice as dense."""
NOTHING = 1e-4
"""Singular value of the derivatives of the terminal error (1/rad), or part of the largest, that counts as zero."""
NEWTON = Rules(60, longest=0.5, span=60, rank=NOTHING, least=1.0, shrink=0.5, corrections=0)
"""Shooting: two equations a freedom and more unknowns, steps of least length, or to the least additions."""
INSIDE = Rules(24, longest=0.5, span=4, stall=0.9, rank=NOTHING, least=1.0)
"""Steps towards the bounds that keep the terminal conditions."""

_ATTEMPTS = ((6, 0.0), (10, 0.0), (10, 0.7), (10, 1.4), (14, 0.0))
"""Splines per flywheel, and range (rad) of the random first angles of rest about those of the plain fade."""
RICHER = (12, 20)
"""Splines per flywheel, tried in order while a bound is exceeded."""
_COARSE, _NO_LIMIT = 1e-4, 10**9

Problems = Callable[[int, int], Boundary]
"""Problem for given numbers of nodes and splines."""
DENSEST = 8 * NODES
"""Most nodes per period of the fastest part; half as many rows."""


@dataclass(frozen=True, eq=False)
class RunUpSolution:
    """A solution of the boundary-value problem, and the terminal error of its table with nodes twice as dense.

    steps     Newton steps of the successful attempt
    attempts  1: the first
    """

    flight: Flight
    error: float
    steps: int
    attempts: int


def solve(
    mechanics: Mechanics,
    motion: RequiredMotion,
    programme: Programme,
    duration: float,
    *,
    up: bool,
    seed: int = 0,
    budget: Budget | None = None,
) -> RunUpSolution:
    """A run-up (`up`) into the programme, or a run-down from it, in `duration` s.

    It keeps the motion's bounds if possible. The same programme and seed give the same result, unless the time of
    `budget` is over: then no attempt begins, and no step is taken towards the bounds.

    Raises CheckError: there is no rest, or no run-up was found.
    """
    budget = budget or Budget(_NO_LIMIT)
    rng = np.random.default_rng(seed)
    best = np.inf

    def problem(nodes: int, splines: int) -> Boundary:
        return Boundary.of(mechanics, motion, programme, duration, up=up, nodes=nodes, splines=splines)

    which, where = ("run-up", "into the programme") if up else ("run-down", "to rest")
    for number, (splines, spread) in enumerate(_ATTEMPTS):
        if budget.is_spent():
            ended = "interrupted" if budget.interrupted else "cut by time"
            raise CheckError(f"{which}: {ended} after {number} of {len(_ATTEMPTS)} attempts, none was found")
        coarse = problem(NODES, splines)
        added = np.zeros((mechanics.N, coarse.family.P))
        added[:, 0] = spread * rng.uniform(-1.0, 1.0, mechanics.N)
        try:
            flight, steps = shoot(coarse.fly(added), _COARSE, budget)
            best = min(best, flight.size)
            if flight.size > _COARSE:
                if not budget.is_spent() and is_out_of_reach(flight):
                    raise CheckError(
                        f"{which}: the surroundings cannot absorb the momentum of the programme, so no "
                        "run-up or run-down exists; a programme of rocking flywheels may have no momentum"
                    )
                continue
            result, error = _refine_nodes(problem, _keep_bounds(problem, flight, motion.bounds, budget))
        except StateError:
            continue
        return RunUpSolution(result, error, steps, number + 1)
    ends = f"ends {best:.2g} amplitudes away" if np.isfinite(best) else "moves too violently on the way"
    raise CheckError(
        f"{which}: none of {duration:g} s {where} was found in {len(_ATTEMPTS)} attempts: the carrier {ends}; "
        "make it longer (`runup`)"
    )


def shoot(start: Flight, goal: float, budget: Budget) -> tuple[Flight, int]:
    """Newton steps until the terminal error meets the goal or falls no more: the best flight, number of steps."""
    run = descend(start.with_bounds(Bounds()), NEWTON, budget, lambda flight: flight.size <= goal)
    return run.point, run.steps


def is_out_of_reach(flight: Flight) -> bool:
    """Whether the remaining terminal error cannot be reduced by any flywheel motion, to first order."""
    A = flight.model().A
    left = flight.c - A @ Range.of(A, NOTHING, 1.0, null=False).least(flight.c)
    return size(left) > 0.5 * size(flight.c)


def _keep_bounds(problem: Problems, flight: Flight, bounds: Bounds, budget: Budget) -> Flight:
    """A flight inside the bounds or nearer to them: more splines while bounds are exceeded and time is left."""
    tried = [flight]
    for splines in (0, *RICHER):
        if flight.largest(bounds) <= (1.0 if splines else KEEP) or budget.is_spent():
            break
        if splines:
            richer = problem(NODES, splines)
            added = flight.problem.family.basis[0] @ flight.added.T
            added = np.linalg.lstsq(richer.family.basis[0], added, rcond=None)[0].T
            try:
                flight = shoot(richer.fly(added), _COARSE, budget)[0]
            except StateError:
                break
            if flight.size > _COARSE:
                break
        inside = descend(flight.with_bounds(bounds), INSIDE, budget, lambda point: point.largest(bounds) <= KEEP).point
        inside = shoot(inside, _COARSE, budget)[0]
        if inside.size <= _COARSE and inside.largest(bounds) < flight.largest(bounds):
            flight = inside
        tried.append(flight)
    return min(tried, key=lambda candidate: candidate.largest(bounds))


def _refine_nodes(problem: Problems, coarse: Flight) -> tuple[Flight, float]:
    """Refine the nodes until the table of the solution ends accurately: flight, terminal error of the table.

    Raises StateError if even the densest table does not.
    """
    flight, nodes, splines = coarse, 2 * NODES, coarse.problem.family.P - 1
    boundary = problem(nodes, splines)
    while nodes <= DENSEST:
        flight = boundary.fly(flight.added, guess=flight.problem.interpolate(flight.course.y, boundary))
        flight = shoot(flight, GOAL, Budget(6))[0]
        nodes *= 2
        denser = problem(nodes, splines)
        error = denser.table_error(table_of(flight), boundary.interpolate(flight.course.y, denser))
        if error <= ACCEPTED_ERROR:
            return flight, error
        boundary = denser
    raise StateError("the motion is too rough for the densest nodes")


def table_of(flight: Flight) -> Samples:
    """Table with a row at every second node."""
    return Samples(flight.problem.family.t[::2], *(x[::2] for x in flight.angles))


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
        limited = Budget(_NO_LIMIT, whole.seconds_left(0.5 if up else 1.0), interrupted=whole.interrupted)
        if say is not None:
            say("run-up" if up else "run-down")
        try:
            solution = solve(mechanics, motion, programme, motion.runup, up=up, seed=seed, budget=limited)
        except KeyboardInterrupt:
            whole.interrupted = True
            tables[key], report[key] = None, {"reason": f"{'run-up' if up else 'run-down'}: interrupted"}
        except CheckError as error:
            tables[key], report[key] = None, {"reason": str(error)}
        else:
            table = RunUpTable(motion.runup, table_of(solution.flight))
            tables[key], report[key] = table, runup_figures(solution, motion, stand)
    return replace(programme, runup=tables["runup"], rundown=tables["rundown"], report=report)


def shortcomings(programme: Programme) -> tuple[str, ...]:
    """Problems of run-up and run-down, one per line: not found, or a bound exceeded."""
    lines = []
    for key in ("runup", "rundown"):
        report = programme.report.get(key, {})
        if "reason" in report:
            lines.append(report["reason"])
        lines += report.get("exceeded", ())
    return tuple(lines)


def runup_figures(solution: RunUpSolution, motion: RequiredMotion, stand: Stand) -> dict[str, Any]:
    """Report of a run-up: terminal error, largest deviation and its time, peaks, exceeded bounds."""
    values, t = solution.flight.values, solution.flight.problem.family.t
    name = "run-up" if solution.flight.problem.up else "run-down"
    at = np.argmax(values["deviation"], axis=0)
    exceeded = []
    for bound, share in solution.flight.shares(motion.bounds).items():
        i, k = np.unravel_index(int(np.argmax(share)), share.shape)
        if share[i, k] > 1.0:
            value, used = abs(float(values[bound][i, k])), float(share[i, k])
            of, unit = "the carrier", ("m", "rad")[k]
            if bound != "deviation":
                of, unit = stand.flywheels[k].name, UNITS[bound]
            excess = ExceededBound(bound, of, value, value / used, used, unit, float(t[i]))
            exceeded.append(f"{name}: {excess.words}")
    return {
        "terminal_error": solution.error,
        "steps": solution.steps,
        "attempts": solution.attempts,
        "deviation": {
            kind: {"largest": float(values["deviation"][i, k]), "t": float(t[i])}
            for k, (kind, i) in enumerate(zip(("linear", "angular"), at, strict=True))
        },
        "peak": {key: np.abs(values[key]).max(axis=0).tolist() for key in ("speed", "acceleration", "torque")},
        "exceeded": exceeded,
    }
