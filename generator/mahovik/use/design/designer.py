"""Design as a whole: early refusal, search, exact and verified programme for the cheapest design, explanation.

A programme is made exact by the planner's steps and verified.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np

from mahovik.core.motion.functions import Fourier
from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import MountingAngles, Stand
from mahovik.errors import DesignError, StateError, whole_number
from mahovik.use.design.freedom import Freedom
from mahovik.use.design.outcome import Outcome, Status, changes
from mahovik.use.design.refusal import binding_words, refuse, relax_each
from mahovik.use.design.search import EXACT, STARTS, Candidate, OnProgress, Search, pareto_front, search
from mahovik.use.design.space import mounting_angles, nearest_two
from mahovik.use.design.task import Task
from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.certificate import certify, failed_items, figures, make_programme, torques_on
from mahovik.use.plan.held import refuse_unplannable
from mahovik.use.plan.levenberg import refine_periodic
from mahovik.use.plan.objective import exceeded_bounds, has_bounds
from mahovik.use.plan.problem import Periodic, Problem
from mahovik.use.plan.search import HARMONIC_COUNTS, Improver

EXACT_ENOUGH = 0.1
"""Part of a programme's tolerance: a residual below this needs no more harmonics."""

ZERO_HARMONIC = 1e-13
"""Relative residual below which a harmonic counts as zero."""


def finish(chosen: Candidate, motion: RequiredMotion, budget: Budget) -> tuple[Stand, Programme, str]:
    """The stand, its programme with a report, and the objections of the verification; empty: it is exact."""
    task, design = chosen.task, chosen.fit.design
    stand, course = move_phases(task.space.stand_of(design.y), design.motion, task.freedom.phase)
    problem = Problem.of(stand, motion)
    course, exceeded = make_exact(problem, course, budget)
    found = figures(problem, course)
    report: dict[str, Any] = {
        "kind": "design",
        "harmonics": course.H,
        "residual": found["residual"],
        "residual_by_harmonic": residual_by_harmonic(problem, course),
        "exceeded": list(exceeded),
        **found,
    }
    fourier = Fourier(np.array(course.mean), np.array(course.cos), np.array(course.sin))
    winding = tuple(round(n) for n in course.winding)
    programme = certify(stand, motion, make_programme(stand, motion, course.bias, winding, fourier, report))
    return stand, programme, failed_items(programme)


def make_exact(problem: Problem, course: Periodic, budget: Budget) -> tuple[Periodic, tuple[str, ...]]:
    """The motion with as many harmonics as it needs, if it can be made exact; bounds that it exceeds."""
    best, least = course, problem.relative(course)
    if least > EXACT_ENOUGH * problem.tolerance:
        longer = refine_periodic(problem, course, HARMONIC_COUNTS, budget).motion
        if problem.relative(longer) < min(least, problem.tolerance):
            best, least = longer, problem.relative(longer)
    best = drop_harmonics(problem, best, least)
    if not has_bounds(problem.motion.bounds):
        return best, ()
    improver = Improver.of(problem)
    over = _exceeded_bounds(problem, best)
    if (over or least > problem.tolerance) and problem.rows_count <= problem.N:
        found = improver.polish(course, "given", budget)
        if found is not None and found.is_programme:
            return found.motion, ()
    return best, over


def drop_harmonics(problem: Problem, course: Periodic, residual: float) -> Periodic:
    """The motion with as few harmonics as possible: constant speed if the others are rounding."""
    for H in range(course.H):
        fewer = course.with_harmonics(H)
        if problem.relative(fewer) <= max(residual, EXACT):
            return fewer
    return course


def _exceeded_bounds(problem: Problem, course: Periodic) -> tuple[str, ...]:
    """Bounds of the motion file that the flywheels' motion exceeds, as messages."""
    grid = problem.grid(20 * (2 * course.H + 2), course.H, 0.5)
    angles = course.at(grid.basis)
    swing = angles.phi - course.mean - grid.t[:, None] * (2.0 * np.pi / course.period * course.winding)
    tau = torques_on(problem, grid, course, angles)
    over = exceeded_bounds(problem.motion.bounds, problem.stand, grid.t, angles, swing, tau, course.bias)
    return tuple(each.words for each in over)


def move_phases(stand: Stand, course: Periodic, into_mounting: bool) -> tuple[Stand, Periodic]:
    """Mounting angles and means within half a turn; the means moved into the mountings if `phase` is free."""
    wheels, waves = [], course.waves.copy()
    for s, wheel in enumerate(stand.flywheels):
        mean = float(waves[s, 0])
        own = wheel.mounting
        if into_mounting:
            psi, theta, zero = mounting_angles(wheel)
            own, mean = MountingAngles(psi, theta, zero + mean), 0.0
        if isinstance(own, MountingAngles):
            own = MountingAngles(wrap_angle(own.psi), wrap_angle(own.theta), wrap_angle(own.zero))
        waves[s, 0] = wrap_angle(mean)
        wheels.append(replace(wheel, mounting=own))
    return replace(stand, flywheels=tuple(wheels)), replace(course, waves=waves)


def wrap_angle(angle: float) -> float:
    """The same angle within half a turn; one already there keeps its bits."""
    return angle if -np.pi <= angle <= np.pi else float((angle + np.pi) % (2.0 * np.pi) - np.pi)


def residual_by_harmonic(problem: Problem, course: Periodic) -> list[float]:
    """Amplitude of the relative residual by harmonics 0, 1, .. of the period, up to the last that matters."""
    M = 8 * (2 * course.H + 4)
    rows: Array = problem.rows(problem.grid(M, course.H), course)
    spectrum = np.fft.rfft(rows, axis=0) / M
    spectrum[1:] *= 2.0
    sizes = np.linalg.norm(np.abs(spectrum), axis=1)
    relevant = np.flatnonzero(sizes > max(1e-3 * float(sizes.max(initial=0.0)), ZERO_HARMONIC))
    return [float(x) for x in sizes[: (int(relevant.max()) if relevant.size else 0) + 1]]


AFTER = 30.0
"""s for the work after a search that ran out of time: polishing, and finding what binds."""
NO_STEP_LIMIT = 10**9


@dataclass(frozen=True)
class DesignOptions:
    """Options of a design. Raises UsageError for those without meaning.

    seed      of all random numbers
    seconds   time limit of the search; None: unlimited
    starts    for each number of flywheels
    pareto    points of the Pareto front; 0: none
    """

    seed: int = 0
    seconds: float | None = None
    starts: int = STARTS
    pareto: int = 0

    def __post_init__(self) -> None:
        whole_number("seed", self.seed, 0)
        whole_number("pareto", self.pareto, 0, 50)


def design_stand(
    stand: Stand,
    motion_for: Callable[[Stand], RequiredMotion],
    freedom: Freedom,
    options: DesignOptions | None = None,
    on_progress: OnProgress | None = None,
) -> Outcome:
    """The cheapest stand like `stand` whose carrier can do the motion, with its programme; or the binding constraints.

    motion_for   the motion for a stand with fewer flywheels: the motion file may name each. Ctrl-C during the search
                 gives the best so far. Raises DesignError, MotionError, StandError.
    """
    options = options or DesignOptions()
    least, most = freedom.number
    tasks = []
    for N in range(least, most + 1):
        part = replace(stand, flywheels=stand.flywheels[:N])
        motion = motion_for(part)
        if not motion.periodic:
            raise DesignError([f"motion {motion.name}: a design is for a periodic motion; this one is finite"])
        refuse_unplannable(part, motion)
        try:
            tasks.append(Task.of(part, motion, freedom.for_first(N)))
        except StateError as error:
            raise DesignError([f"motion {motion.name}: {error}"]) from None
    refuse(tasks[-1], tasks[-1].freedom)
    budget = Budget(NO_STEP_LIMIT, options.seconds)
    found = search(tasks, options.seed, budget, on_progress, options.starts)
    effort = {
        "seed": options.seed,
        "starts": found.starts,
        "steps": budget.steps_taken,
        "flywheels_tried": {str(N): residual for N, residual in found.tried.items()},
        "found": len(found.found),
        "cut_by_time": found.cut,
    }
    after = Budget(NO_STEP_LIMIT, AFTER if found.cut or found.interrupted else None)
    if not found.found:
        return no_design(found, after, effort)
    return _outcome(found, options, after, effort)


def _outcome(found: Search, options: DesignOptions, budget: Budget, effort: dict[str, Any]) -> Outcome:
    """Outcome for the cheapest design."""
    chosen = found.found[0]
    stand, programme, wrong = finish(chosen, chosen.task.motion, budget)
    over = tuple(programme.report["exceeded"])
    residual = float(programme.report["residual"])
    quality = chosen.task.freedom.quality
    status: Status = "APPROXIMATE" if wrong else "OK"
    words: tuple[str, ...] = ()
    if wrong:
        words = (
            f"the programme is not exact: its relative residual is {residual:.2g}, accepted up to {quality:g} "
            "(`quality`); more flywheels or more freedom can make it exact",
            f"verify-programme refuses it: {wrong}",
        )
    if over:
        status, words = "OK_LIMIT", (*words, *over)
    points = pareto_front(found.found, options.pareto, budget) if options.pareto else []
    return Outcome(
        status, words, residual, stand, programme, chosen.cost, tuple(changes(chosen)),
        {"before": flywheel_totals(chosen.task.space.stand), "after": flywheel_totals(stand)},
        tuple(points), effort, found.interrupted,
    )  # fmt: skip


def no_design(found: Search, budget: Budget, effort: dict[str, Any]) -> Outcome:
    """Outcome without a design: what was tried, and what binds."""
    ended = "cut by time" if found.cut else "interrupted" if found.interrupted else "all starts tried"
    tried = ", ".join(f"{N} flywheels: {residual:.2g}" for N, residual in found.tried.items() if residual < inf)
    first = f"no design was found (this does not prove that there is none): {found.starts} starts, {ended}" + (
        f"; least relative residual with {tried}" if tried else ""
    )
    if found.nearest is None and (found.cut or found.interrupted):
        more: tuple[str, ...] = ("the search ended before the first start had a result: give it more time",)
    elif found.nearest is None:
        more = ("no start came close: try other windings (`speed`), another seed, more flywheels",)
    elif found.refusals and found.best <= found.nearest[0].freedom.quality:
        more = tuple(dict.fromkeys(found.refusals))[:3]
    else:
        task, reached = found.nearest
        more = binding_words(task, reached.residual, [] if found.interrupted else relax_each(task, reached, budget))
    return Outcome("NO_DESIGN", (first, *more), found.best, effort=effort, interrupted=found.interrupted)


def flywheel_totals(stand: Stand) -> dict[str, Any]:
    """Totals of a stand's flywheels: number, mass (kg), unbalance (kg m), the two nearest and their distance (m)."""
    from math import hypot

    nearest = nearest_two(stand)
    return {
        "flywheels": len(stand.flywheels),
        "mass": sum(s.mass for s in stand.flywheels),
        "unbalance": sum(s.mass * hypot(*s.center_of_mass[1:]) for s in stand.flywheels),
        "nearest": None if nearest is None else {"distance": nearest[0], "flywheels": nearest[1:]},
    }
