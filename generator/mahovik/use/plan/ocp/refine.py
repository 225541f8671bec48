"""A collocated motion made exact: what hides between the nodes is taken out by the refinement of the Fourier method."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.use.plan.array import Array
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.choose import Improver
from mahovik.use.plan.finite import FiniteProblem, Solved
from mahovik.use.plan.fourier import Angles, Basis, Periodic
from mahovik.use.plan.levenberg import Rules, ladder, refine
from mahovik.use.plan.ocp.solve import Collocated, Start
from mahovik.use.plan.optimise import finish, judged
from mahovik.use.plan.search import RUNGS, Candidate

STEPS = 60
"""Of the refinement."""
_LEAST, _MOST = 16, 32
"""Harmonics of the fit."""


def start_of(motion: Periodic) -> Start:
    """A periodic flywheel motion as a start."""

    def at(t: Array) -> Angles:
        return motion.at(Basis.of(motion.period, motion.H, t))

    return Start(at, motion.winding, motion.bias)


def exact(improver: Improver, start: Candidate, found: Collocated) -> Candidate:
    """The periodic motion on (12) next to a collocated one: its harmonics, then shortest steps."""
    problem, H = improver.problem, int(np.clip(start.motion.H, _LEAST, _MOST))
    M = 8 * H
    t: Array = np.asarray(np.arange(M) * (found.span / M))
    turned = found.at(t).phi - np.outer(t / found.span, 2.0 * np.pi * start.motion.winding)
    spectrum = np.fft.rfft(turned, axis=0)[: H + 1].T / M
    waves = np.hstack([spectrum[:, :1].real, 2.0 * spectrum[:, 1:].real, -2.0 * spectrum[:, 1:].imag])
    motion = Periodic(start.motion.period, start.motion.winding, waves, found.bias)
    budget = Budget(STEPS)
    done = finish(problem, improver.cost, judged(problem, improver.cost, motion, 0), budget)
    if done.residual > problem.tolerance:
        done = judged(problem, improver.cost, ladder(problem, motion, RUNGS, budget).motion, budget.taken)
    return improver.candidate(done, start.kind)


def finite_start(problem: FiniteProblem, solved: Solved) -> Start:
    """A finite flywheel motion as a start."""
    space = problem.space(solved.degree)
    return Start(lambda t: solved.motion.at(space.modes(t)), np.zeros(problem.N), solved.motion.bias)


def finite_exact(problem: FiniteProblem, start: Solved, found: Collocated) -> Solved:
    """The finite motion on (12) next to a collocated one: its modes, then steps at the degree of the start."""
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
