"""A run-up or run-down from nothing: coarse nodes first, bounds, then nodes fine enough to be believed."""

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
from mahovik.use.plan.runup.limits import reduced, shares
from mahovik.use.plan.runup.newton import reachable, shoot

GOAL = 1e-8
"""Terminal error at the nodes, share of the amplitude."""
ACCEPTED = 1e-6
"""The same of the table, by nodes twice as dense."""

_ATTEMPTS = ((6, 0.0), (10, 0.0), (10, 0.7), (10, 1.4), (14, 0.0))
"""Splines a flywheel, and how far (rad) the first angles of rest are drawn about those of the plain fade."""
RICHER = (12, 20)
"""Splines a flywheel, in turn, while a bound is exceeded."""
_STEPS, _COARSE = 60, 1e-4

Problems = Callable[[int, int], Boundary]
"""By nodes and splines."""
DENSEST = 8 * NODES
"""A period of the fastest part, and rows half as many."""


@dataclass(frozen=True, eq=False)
class Found:
    """A solution of the boundary-value problem, and the terminal error of its table by nodes twice as dense.

    steps     Newton's, of the attempt that succeeded
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

    Inside the motion's bounds, if that can be reached. The same for the same programme and seed, unless the time of
    `budget` is over: then no attempt is begun, and no step is taken to come nearer to the bounds.

    Raises CheckError: there is no rest, or none was found.
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
                if not budget.over() and out_of_reach(coarse, shot.flight):
                    raise CheckError(
                        f"{which}: what surrounds the stand cannot take up the momentum of the programme, so that no "
                        "run-up or run-down exists; a programme that rocks may have none to take up"
                    )
                continue
            found = _refined(problem, *_within(problem, coarse, shot.flight, motion.bounds, budget))
        except StateError:
            continue
        return Found(*found, shot.steps, number + 1)
    ends = f"ends {best:.2g} of its amplitude away" if np.isfinite(best) else "is thrown about on the way"
    raise CheckError(
        f"{which}: none of {duration:g} s {where} was found in {len(_ATTEMPTS)} attempts: the carrier {ends}; "
        "give it longer (`runup`)"
    )


def out_of_reach(problem: Boundary, flight: Flight) -> bool:
    """Whether the terminal error lies where no change of the flywheels' motion leads, to first order."""
    J, _ = problem.sensitivity(problem.renewed(flight))
    U, sigma, _ = np.linalg.svd(J)
    lost = U[:, ~reachable(sigma)].T @ flight.error
    return float(np.linalg.norm(lost)) > 0.5 * float(np.linalg.norm(flight.error))


def _within(
    problem: Problems, own: Boundary, flight: Flight, bounds: Bounds, budget: Budget
) -> tuple[Boundary, Flight]:
    """Inside the bounds, or nearer to them: with more splines a flywheel while they are exceeded and time is left."""
    tried = [(own, flight)]
    if shares(own, flight, bounds).excess > 0.0:
        flight = reduced(own, flight, bounds, budget)
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
        own, flight = richer, reduced(richer, there, bounds, budget)
        tried.append((own, flight))
    return min(tried, key=lambda each: shares(each[0], each[1], bounds).most)


def _refined(problem: Problems, coarse: Boundary, start: Flight) -> tuple[Boundary, Flight, float]:
    """On denser nodes, until the table of the solution ends right: problem, flight, terminal error of the table.

    Raises StateError where even the densest does not.
    """
    before, flight, nodes = coarse, start, 2 * NODES
    splines = coarse.family.P - 1
    own = problem(nodes, splines)
    while nodes <= DENSEST:
        flight = own.fly(flight.c, guess=between(before, own, flight.course.y))
        flight = shoot(own, flight, GOAL, 6).flight
        nodes *= 2
        denser = problem(nodes, splines)
        error = denser.missed(table_of(own, flight), between(own, denser, flight.course.y))
        if error <= ACCEPTED:
            return own, flight, error
        before, own = own, denser
    raise StateError("the motion is too rough for the nodes")


def table_of(problem: Boundary, flight: Flight) -> Samples:
    """Rows at every second node."""
    angles = problem.family.angles(flight.c)
    return Samples(problem.family.t[::2], *(x[::2] for x in angles))


def between(own: Boundary, other: Boundary, y: Array) -> Array:
    """States y at the nodes of one problem, interpolated at those of another."""
    return np.asarray(CubicSpline(own.family.t, y)(other.family.t))
