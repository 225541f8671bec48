"""Solve a run-up or run-down: coarse nodes first, then bounds, then nodes fine enough to trust; table and report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from mahovik.core.motion.functions import Samples
from mahovik.core.motion.programme import Programme, RunUpTable
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import CheckError, StateError
from mahovik.use.numeric import Array, Mechanics
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.runup.boundary import NODES, Boundary, Flight, boundary
from mahovik.use.plan.runup.newton import measure, nonzero_mask, reduce_excess, shares, shoot

GOAL = 1e-8
"""Terminal error at the nodes, in amplitudes."""
ACCEPTED_ERROR = 1e-6
"""Accepted terminal error of the table, with nodes twice as dense."""

_ATTEMPTS = ((6, 0.0), (10, 0.0), (10, 0.7), (10, 1.4), (14, 0.0))
"""Splines per flywheel, and range (rad) of the random first angles of rest about those of the plain fade."""
RICHER = (12, 20)
"""Splines per flywheel, tried in order while a bound is exceeded."""
_STEPS, _COARSE = 60, 1e-4

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

    problem: Boundary
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
    budget = budget or Budget(0)
    rng = np.random.default_rng(seed)
    best = np.inf

    def problem(nodes: int, splines: int) -> Boundary:
        return boundary(mechanics, motion, programme, duration, up=up, nodes=nodes, splines=splines)

    which, where = ("run-up", "into the programme") if up else ("run-down", "to rest")
    for number, (splines, spread) in enumerate(_ATTEMPTS):
        if budget.is_spent():
            ended = "interrupted" if budget.interrupted else "cut by time"
            raise CheckError(f"{which}: {ended} after {number} of {len(_ATTEMPTS)} attempts, none was found")
        coarse = problem(NODES, splines)
        c = np.zeros((mechanics.N, coarse.family.P))
        c[:, 0] = spread * rng.uniform(-1.0, 1.0, mechanics.N)
        try:
            flight, steps = shoot(coarse, coarse.fly(c), _COARSE, _STEPS, budget)
            best = min(best, flight.size)
            if flight.size > _COARSE:
                if not budget.is_spent() and is_out_of_reach(coarse, flight):
                    raise CheckError(
                        f"{which}: the surroundings cannot absorb the momentum of the programme, so no "
                        "run-up or run-down exists; a programme of rocking flywheels may have no momentum"
                    )
                continue
            found = _refine_nodes(problem, *_reduce_excess(problem, coarse, flight, motion.bounds, budget))
        except StateError:
            continue
        return RunUpSolution(*found, steps, number + 1)
    ends = f"ends {best:.2g} amplitudes away" if np.isfinite(best) else "moves too violently on the way"
    raise CheckError(
        f"{which}: none of {duration:g} s {where} was found in {len(_ATTEMPTS)} attempts: the carrier {ends}; "
        "make it longer (`runup`)"
    )


def is_out_of_reach(problem: Boundary, flight: Flight) -> bool:
    """Whether the remaining terminal error cannot be reduced by any flywheel motion, to first order."""
    J, _ = problem.sensitivity(problem.linearise_again(flight))
    U, sigma, _ = np.linalg.svd(J)
    lost = U[:, ~nonzero_mask(sigma)].T @ flight.error
    return float(np.linalg.norm(lost)) > 0.5 * float(np.linalg.norm(flight.error))


def _reduce_excess(
    problem: Problems, own: Boundary, flight: Flight, bounds: Bounds, budget: Budget
) -> tuple[Boundary, Flight]:
    """Bring a flight inside the bounds or nearer to them: more splines while bounds are exceeded and time is left."""
    tried = [(own, flight)]
    if shares(own, flight, bounds).excess > 0.0:
        flight = reduce_excess(own, flight, bounds, budget)
        tried.append((own, flight))
    for splines in RICHER:
        if shares(own, flight, bounds).largest <= 1.0:
            return own, flight
        if budget.is_spent():
            break
        richer = problem(NODES, splines)
        added = own.family.basis[0] @ flight.c.T
        c = np.linalg.lstsq(richer.family.basis[0], added, rcond=None)[0].T
        try:
            there = shoot(richer, richer.fly(c), _COARSE, _STEPS, budget)[0]
        except StateError:
            break
        if there.size > _COARSE:
            break
        own, flight = richer, reduce_excess(richer, there, bounds, budget)
        tried.append((own, flight))
    return min(tried, key=lambda each: shares(each[0], each[1], bounds).largest)


def _refine_nodes(problem: Problems, coarse: Boundary, start: Flight) -> tuple[Boundary, Flight, float]:
    """Refine the nodes until the table of the solution ends accurately: problem, flight, terminal error of the table.

    Raises StateError if even the densest table does not.
    """
    before, flight, nodes = coarse, start, 2 * NODES
    splines = coarse.family.P - 1
    own = problem(nodes, splines)
    while nodes <= DENSEST:
        flight = own.fly(flight.c, guess=interpolate_states(before, own, flight.course.y))
        flight = shoot(own, flight, GOAL, 6)[0]
        nodes *= 2
        denser = problem(nodes, splines)
        error = denser.table_error(table_of(own, flight), interpolate_states(own, denser, flight.course.y))
        if error <= ACCEPTED_ERROR:
            return own, flight, error
        before, own = own, denser
    raise StateError("the motion is too rough for the densest nodes")


def table_of(problem: Boundary, flight: Flight) -> Samples:
    """Table with a row at every second node."""
    angles = problem.family.angles(flight.c)
    return Samples(problem.family.t[::2], *(x[::2] for x in angles))


def interpolate_states(own: Boundary, other: Boundary, y: Array) -> Array:
    """States y at the nodes of `own`, interpolated at those of `other`."""
    return np.asarray(CubicSpline(own.family.t, y)(other.family.t))


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
        own = Budget(0, whole.seconds_left(0.5 if up else 1.0), interrupted=whole.interrupted)
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
            tables[key], report[key] = table, runup_figures(found, motion, stand)
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


def runup_figures(found: RunUpSolution, motion: RequiredMotion, stand: Stand) -> dict[str, Any]:
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
