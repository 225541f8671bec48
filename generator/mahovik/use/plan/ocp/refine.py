"""Make a collocated motion exact: the Fourier method removes the residual between the nodes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.choose import Improver
from mahovik.use.plan.finite import FiniteProblem, Solved
from mahovik.use.plan.fourier import Angles, Basis, Periodic
from mahovik.use.plan.levenberg import Rules, refine, refine_periodic
from mahovik.use.plan.ocp.solve import Collocated, Start
from mahovik.use.plan.optimise import evaluate, finish
from mahovik.use.plan.search import HARMONIC_COUNTS, Candidate

STEPS = 60
"""Steps of the refinement."""
_LEAST, _MOST = 16, 32
"""Least and greatest number of harmonics of the fit."""


def periodic_start(motion: Periodic) -> Start:
    """A periodic flywheel motion as a start."""

    def at(t: Array) -> Angles:
        return motion.at(Basis.of(motion.period, motion.H, t))

    return Start(at, motion.winding, motion.bias)


def exact_periodic(improver: Improver, start: Candidate, found: Collocated) -> Candidate:
    """The periodic motion on (12) next to a collocated one: fit of its harmonics, then shortest steps."""
    problem, H = improver.problem, int(np.clip(start.motion.H, _LEAST, _MOST))
    M = 8 * H
    t: Array = np.asarray(np.arange(M) * (found.span / M))
    turned = found.at(t).phi - np.outer(t / found.span, 2.0 * np.pi * start.motion.winding)
    spectrum = np.fft.rfft(turned, axis=0)[: H + 1].T / M
    waves = np.hstack([spectrum[:, :1].real, 2.0 * spectrum[:, 1:].real, -2.0 * spectrum[:, 1:].imag])
    motion = Periodic(start.motion.period, start.motion.winding, waves, found.bias)
    budget = Budget(STEPS)
    done = finish(problem, improver.cost, evaluate(problem, improver.cost, motion, 0), budget)
    if done.residual > problem.tolerance:
        done = evaluate(
            problem, improver.cost, refine_periodic(problem, motion, HARMONIC_COUNTS, budget).motion, budget.taken
        )
    return improver.candidate(done, start.kind)


def finite_start(problem: FiniteProblem, solved: Solved) -> Start:
    """A finite flywheel motion as a start."""
    space = problem.space(solved.degree)
    return Start(lambda t: solved.motion.at(space.modes(t)), np.zeros(problem.N), solved.motion.bias)


def finite_exact(problem: FiniteProblem, start: Solved, found: Collocated) -> Solved:
    """The finite motion on (12) next to a collocated one: fit of its modes, then steps at the degree of the start."""
    space = problem.space(start.degree)
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
    grid = problem.grid_of(start.degree, space.nodes(max(3, start.degree - 2), 4)[0])
    reached = refine(problem, grid, motion, Rules(1e-3 * problem.tolerance, STEPS, 1e-2), Budget(STEPS)).motion
    fine = problem.between(start.degree, 3 * start.degree)
    return Solved(reached, start.degree, float(np.linalg.norm(problem.rows(fine, reached), axis=1).max()))
