"""From programmes of the Fourier method to those of (13): IPOPT, refinement, report.

The refinement makes a collocated motion exact: the Fourier method removes the residual between the nodes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

import numpy as np

from mahovik.core.motion.functions import Angles
from mahovik.use.numeric import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.finite import FiniteProblem, FiniteSolution
from mahovik.use.plan.levenberg import Rules, refine, refine_periodic
from mahovik.use.plan.objective import Cost
from mahovik.use.plan.ocp.solve import CollocatedMotion, ScaledProblem, Start, solve
from mahovik.use.plan.ocp.structure import Mesh
from mahovik.use.plan.optimise import evaluate, finish
from mahovik.use.plan.outcome import Candidates, OnProgress, PlanOptions
from mahovik.use.plan.problem import Basis, Periodic, Problem
from mahovik.use.plan.search import HARMONIC_COUNTS, Candidate, Improver

REFINEMENT_STEPS = 60
"""Steps of the refinement."""
_FEWEST_HARMONICS, _MOST_HARMONICS = 16, 32
"""Least and greatest number of harmonics of the fit."""


def periodic_start(motion: Periodic) -> Start:
    """A periodic flywheel motion as a start."""

    def angles_at(t: Array) -> Angles:
        return motion.at(Basis.of(motion.period, motion.H, t))

    return Start(angles_at, motion.winding, motion.bias)


def exact_periodic(improver: Improver, start: Candidate, found: CollocatedMotion) -> Candidate:
    """The periodic motion on (12) next to a collocated one: fit of its harmonics, then shortest steps."""
    problem, H = improver.problem, int(np.clip(start.motion.H, _FEWEST_HARMONICS, _MOST_HARMONICS))
    M = 8 * H
    t: Array = np.asarray(np.arange(M) * (found.span / M))
    turned = found.at(t).phi - np.outer(t / found.span, 2.0 * np.pi * start.motion.winding)
    spectrum = np.fft.rfft(turned, axis=0)[: H + 1].T / M
    waves = np.hstack([spectrum[:, :1].real, 2.0 * spectrum[:, 1:].real, -2.0 * spectrum[:, 1:].imag])
    motion = Periodic(start.motion.period, start.motion.winding, waves, found.bias)
    budget = Budget(REFINEMENT_STEPS)
    done = finish(problem, improver.cost, evaluate(problem, improver.cost, motion, 0), budget)
    if done.residual > problem.tolerance:
        done = evaluate(
            problem, improver.cost, refine_periodic(problem, motion, HARMONIC_COUNTS, budget).motion, budget.steps_taken
        )
    return improver.candidate(done, start.kind, start.free)


def finite_start(problem: FiniteProblem, solved: FiniteSolution) -> Start:
    """A finite flywheel motion as a start."""
    space = solved.space
    return Start(lambda t: solved.motion.at(space.modes(t)), np.zeros(problem.N), solved.motion.bias)


def finite_exact(problem: FiniteProblem, start: FiniteSolution, found: CollocatedMotion) -> FiniteSolution:
    """The finite motion on (12) next to a collocated one: fit of its modes, then steps at the degree of the start."""
    space = start.space
    t, weight = space.nodes(start.degree + 1)
    root = np.sqrt(weight)[:, None]
    modes, phi = space.modes(t), found.at(t).phi - t[:, None] * found.phi_dot[:, 0]
    pinned = problem.motion.bounds.start_phi is not None
    first = np.where(pinned, start.motion.waves[:, 0], 0.0)
    left = root * (phi - modes.value[:, :1] * first)
    columns = slice(1, None) if pinned else slice(None)
    waves = np.zeros_like(start.motion.waves)
    waves[:, 0] = first
    waves[:, columns] = np.linalg.lstsq(root * modes.value[:, columns], left, rcond=None)[0].T
    motion = replace(start.motion, waves=waves, bias=found.bias)
    grid = problem.collocation(space)
    reached = refine(
        problem, grid, motion, Rules(1e-3 * problem.tolerance, REFINEMENT_STEPS, 1e-2), Budget(REFINEMENT_STEPS)
    ).motion
    return FiniteSolution(reached, space, problem.residual_between(space, reached))


INTERVALS, DEGREE = 24, 4
"""Intervals per period of a motion with one harmonic (higher ones add more), and degree."""
EACH = 2
"""Intervals between two samples of a finite motion."""
PARTS = (0.995, 0.97, 0.93)
"""Parts of the bounds tried in order, until the refined motion keeps to the bounds."""

Kind = TypeVar("Kind", Candidate, FiniteSolution)


@dataclass(frozen=True)
class _Task(Generic[Kind]):
    """Differences between periodic and finite motions, as functions.

    start   a programme as a start; exact: the exact motion near a collocated one
    good    whether that is a programme; keeps_bounds: whether it does; objective: J of (13)
    """

    start: Callable[[Kind], Start]
    exact: Callable[[Kind, CollocatedMotion], Kind]
    good: Callable[[Kind], bool]
    keeps_bounds: Callable[[Kind], bool]
    objective: Callable[[Kind], float]
    mesh: Mesh


def periodic_ocp(
    improver: Improver,
    warm: Sequence[Candidate],
    options: PlanOptions,
    budget: Budget,
    on_progress: OnProgress,
) -> Candidates[Candidate]:
    """(13) of a periodic motion, from programmes of the Fourier method."""
    problem = improver.problem
    mesh = Mesh.uniform(INTERVALS + 8 * (problem.highest - 1), DEGREE)
    task = _Task[Candidate](
        start=lambda each: periodic_start(each.motion),
        exact=lambda each, found: exact_periodic(improver, each, found),
        good=lambda each: each.exact,
        keeps_bounds=lambda each: not each.exceeded_bounds,
        objective=lambda each: each.objective,
        mesh=mesh,
    )
    return _PlanRuns(problem, improver.cost, task, options, budget, on_progress).run_all(warm)


def finite_ocp(
    problem: FiniteProblem,
    cost: Cost,
    warm: Sequence[FiniteSolution],
    figures: Callable[[FiniteSolution], Mapping[str, Any]],
    options: PlanOptions,
    budget: Budget,
    on_progress: OnProgress,
) -> Candidates[FiniteSolution]:
    """(13) of a finite motion with x(t0) = x0, from programmes of the search; `figures`: of one, for its report."""
    breaks = warm[0].space.breaks / problem.motion.span if warm else np.linspace(0.0, 1.0, 13)
    inside = np.arange(EACH) / EACH
    fine = np.append((breaks[:-1, None] + np.diff(breaks)[:, None] * inside).ravel(), 1.0)
    task = _Task[FiniteSolution](
        start=lambda each: finite_start(problem, each),
        exact=lambda each, found: finite_exact(problem, each, found),
        good=lambda each: each.residual < problem.tolerance,
        keeps_bounds=lambda each: not figures(each)["exceeded"],
        objective=lambda each: float(figures(each)["objective"]),
        mesh=Mesh(fine, DEGREE),
    )
    return _PlanRuns(problem, cost, task, options, budget, on_progress).run_all(warm)


@dataclass(frozen=True, eq=False)
class _PlanRuns(Generic[Kind]):
    """Choices in common of all runs of IPOPT for one plan; they differ in their start."""

    problem: Problem
    cost: Cost
    task: _Task[Kind]
    options: PlanOptions
    budget: Budget
    on_progress: OnProgress

    def run_all(self, warm: Sequence[Kind]) -> Candidates[Kind]:
        """Programmes, most promising start first, until the wanted number is found."""
        outcome = Candidates[Kind]()
        for each in warm:
            if len(outcome.motions) >= self.options.keep or outcome.interrupted or outcome.cut:
                break
            self.run_one(each, outcome)
        outcome.motions.sort(key=lambda each: (not self.task.keeps_bounds(each[0]), self.task.objective(each[0])))
        return outcome

    def run_one(self, warm: Kind, outcome: Candidates[Kind]) -> None:
        """Solve (13) from one programme; the outcome gets the new programme, or the reason why there is none."""
        left = None if self.options.seconds is None else max(0.0, self.options.seconds - self.budget.elapsed)
        time = Budget(0, left)
        scaled = ScaledProblem(self.problem, self.cost)
        best: tuple[Kind, CollocatedMotion] | None = None
        tries: list[CollocatedMotion] = []
        try:
            for part in PARTS:
                start = self.task.start(warm)
                run = solve(scaled, self.task.mesh, start, part, self.on_progress, time)
                tries.append(run)
                outcome.interrupted |= run.interrupted
                outcome.cut |= run.cut
                ended = run.interrupted or run.cut
                if not run.usable:
                    break
                became = self.task.exact(warm, run)
                if self.task.good(became) and not (ended and self.is_worse(became, warm)):
                    best = (became, run) if best is None or self.task.keeps_bounds(became) else best
                if ended or (best is not None and self.task.keeps_bounds(best[0])):
                    break
        except KeyboardInterrupt:
            outcome.interrupted = True
        iterations = sum(each.iterations for each in tries)
        if best is None and (outcome.interrupted or outcome.cut):
            outcome.motions.append((warm, self.report(warm, warm, None, iterations)))
            return
        if best is None:
            last = f"IPOPT ended with {tries[-1].words!r} after {tries[-1].iterations} iterations"
            why = f"{last}; its motion violates (12) between the nodes; --method fourier has a programme"
            outcome.words = [*outcome.words, why]
            return
        outcome.motions.append((best[0], self.report(warm, *best, iterations)))

    def is_worse(self, became: Kind, warm: Kind) -> bool:
        """Whether the start of an interrupted run is better than its result."""
        task = self.task
        return task.keeps_bounds(warm) and (
            not task.keeps_bounds(became) or task.objective(became) > task.objective(warm)
        )

    def report(self, warm: Kind, became: Kind, run: CollocatedMotion | None, iterations: int) -> dict[str, Any]:
        """Entries for the programme's report; `run` None: the start itself is given."""
        mesh = self.task.mesh
        return {
            "method": self.options.method,
            "ocp": {
                "intervals": mesh.K,
                "degree": mesh.degree,
                "iterations": iterations,
                "ipopt": "no better point found yet: the start is given" if run is None else run.words,
                "objective_of_start": self.task.objective(warm),
                "objective_at_nodes": None if run is None else run.objective,
                "objective": self.task.objective(became),
                "raw_residual": None if run is None else run.residual,
            },
        }
