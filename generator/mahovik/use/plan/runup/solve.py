"""Solve a run-up or run-down: coarse nodes first, then bounds, then nodes fine enough to trust."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from mahovik.core.motion.programme import Programme, Samples
from mahovik.core.motion.required import Bounds, RequiredMotion
from mahovik.errors import CheckError, StateError
from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.residual import Mechanics
from mahovik.use.plan.runup.boundary import NODES, Boundary, Flight, boundary
from mahovik.use.plan.runup.limits import reduce_excess, shares
from mahovik.use.plan.runup.newton import nonzero, shoot

GOAL = 1e-8
"""Terminal error at the nodes, in amplitudes."""
ACCEPTED = 1e-6
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
class Found:
    """A solution of the boundary-value problem, and the terminal error of its table with nodes twice as dense.

    steps     Newton steps of the successful attempt
    attempts  1: the first
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
) -> Found:
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
        if budget.over():
            ended = "interrupted" if budget.interrupted else "cut by time"
            raise CheckError(f"{which}: {ended} after {number} of {len(_ATTEMPTS)} attempts, none was found")
        coarse = problem(NODES, splines)
        c = np.zeros((mechanics.N, coarse.family.P))
        c[:, 0] = spread * rng.uniform(-1.0, 1.0, mechanics.N)
        try:
            shot = shoot(coarse, coarse.fly(c), _COARSE, _STEPS, budget)
            best = min(best, shot.flight.size)
            if shot.flight.size > _COARSE:
                if not budget.over() and is_out_of_reach(coarse, shot.flight):
                    raise CheckError(
                        f"{which}: the surroundings cannot absorb the momentum of the programme, so no "
                        "run-up or run-down exists; a programme of rocking flywheels may have no momentum"
                    )
                continue
            found = _refine_nodes(problem, *_reduce_excess(problem, coarse, shot.flight, motion.bounds, budget))
        except StateError:
            continue
        return Found(*found, shot.steps, number + 1)
    ends = f"ends {best:.2g} amplitudes away" if np.isfinite(best) else "moves too violently on the way"
    raise CheckError(
        f"{which}: none of {duration:g} s {where} was found in {len(_ATTEMPTS)} attempts: the carrier {ends}; "
        "make it longer (`runup`)"
    )


def is_out_of_reach(problem: Boundary, flight: Flight) -> bool:
    """Whether the remaining terminal error cannot be reduced by any flywheel motion, to first order."""
    J, _ = problem.sensitivity(problem.relinearised(flight))
    U, sigma, _ = np.linalg.svd(J)
    lost = U[:, ~nonzero(sigma)].T @ flight.error
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
        if shares(own, flight, bounds).most <= 1.0:
            return own, flight
        if budget.over():
            break
        richer = problem(NODES, splines)
        added = own.family.basis[0] @ flight.c.T
        c = np.linalg.lstsq(richer.family.basis[0], added, rcond=None)[0].T
        try:
            there = shoot(richer, richer.fly(c), _COARSE, _STEPS, budget).flight
        except StateError:
            break
        if there.size > _COARSE:
            break
        own, flight = richer, reduce_excess(richer, there, bounds, budget)
        tried.append((own, flight))
    return min(tried, key=lambda each: shares(each[0], each[1], bounds).most)


def _refine_nodes(problem: Problems, coarse: Boundary, start: Flight) -> tuple[Boundary, Flight, float]:
    """Refine the nodes until the table of the solution ends accurately: problem, flight, terminal error of the table.

    Raises StateError if even the densest table does not.
    """
    before, flight, nodes = coarse, start, 2 * NODES
    splines = coarse.family.P - 1
    own = problem(nodes, splines)
    while nodes <= DENSEST:
        flight = own.fly(flight.c, guess=interpolate_states(before, own, flight.course.y))
        flight = shoot(own, flight, GOAL, 6).flight
        nodes *= 2
        denser = problem(nodes, splines)
        error = denser.table_error(table_of(own, flight), interpolate_states(own, denser, flight.course.y))
        if error <= ACCEPTED:
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
