"""From a design to what is written: its stand, and its programme, made exact by the planner's steps and verified."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Fourier, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import MountingAngles, Stand
from mahovik.use.design.search import Candidate
from mahovik.use.design.solve import EXACT
from mahovik.use.design.space import angles_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.bounds import bounded, exceeded
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.certificate import certified, programme_of, wrong_items
from mahovik.use.plan.choose import Improver
from mahovik.use.plan.figures import figures, torques_on
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.levenberg import ladder
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.search import RUNGS

ENOUGH = 0.1
"""Of the tolerance of a programme: a residual below this needs no more harmonics."""

ROUNDING = 1e-13
"""Relative residual of a harmonic that is none."""


def finished(chosen: Candidate, motion: RequiredMotion, budget: Budget) -> tuple[Stand, Programme, str]:
    """The stand, its programme with a report, and what the verification has against it; empty: it is exact."""
    task, design = chosen.task, chosen.reached.design
    stand, course = phased(task.space.stand_of(design.y), design.motion, task.freedom.phase)
    problem = Problem.of(stand, motion)
    course, exceeded = made_exact(problem, course, budget)
    found = figures(problem, course)
    report: dict[str, Any] = {
        "kind": "design",
        "harmonics": course.H,
        "residual": found.residual,
        "residual_by_harmonic": by_harmonic(problem, course),
        "exceeded": list(exceeded),
        "peak_speed": found.speed,
        "peak_acceleration": found.acceleration,
        "peak_torque": found.torque,
        "least_singular_value": found.sigma,
        "det_I_sign_changes": found.sign_changes,
    }
    fourier = Fourier(np.array(course.mean), np.array(course.cos), np.array(course.sin))
    winding = tuple(round(n) for n in course.winding)
    programme = certified(stand, motion, programme_of(stand, motion, course.bias, winding, fourier, report))
    return stand, programme, wrong_items(programme)


def made_exact(problem: Problem, course: Periodic, budget: Budget) -> tuple[Periodic, tuple[str, ...]]:
    """The motion of the flywheels with as many harmonics as it takes, if it can be had; bounds that it exceeds."""
    best, least = course, problem.relative(course)
    if least > ENOUGH * problem.tolerance:
        longer = ladder(problem, course, RUNGS, budget).motion
        if problem.relative(longer) < min(least, problem.tolerance):
            best, least = longer, problem.relative(longer)
    best = plainest(problem, best, least)
    if not bounded(problem.motion.bounds):
        return best, ()
    improver = Improver.of(problem)
    over = _exceeded(problem, best)
    if (over or least > problem.tolerance) and problem.N >= 6:
        found = improver.polish(course, "given", budget)
        if found is not None and found.accepted:
            return found.motion, ()
    return best, over


def plainest(problem: Problem, course: Periodic, residual: float) -> Periodic:
    """With the fewest harmonics that do: constant speed where the others are rounding."""
    for H in range(course.H):
        fewer = course.with_harmonics(H)
        if problem.relative(fewer) <= max(residual, EXACT):
            return fewer
    return course


def _exceeded(problem: Problem, course: Periodic) -> tuple[str, ...]:
    """Bounds of the motion file that a motion of the flywheels exceeds, in words."""
    grid = problem.grid(20 * (2 * course.H + 2), course.H, 0.5)
    angles = course.at(grid.basis)
    swing = angles.phi - course.mean - grid.t[:, None] * (2.0 * np.pi / course.period * course.winding)
    tau = torques_on(problem, grid, course, angles)
    over = exceeded(problem.motion.bounds, problem.stand, grid.t, angles, swing, tau, course.bias)
    return tuple(each.words for each in over)


def phased(stand: Stand, course: Periodic, into_mounting: bool) -> tuple[Stand, Periodic]:
    """Mounting angles and means within half a turn; the means in the mountings, where `phase` is free."""
    wheels, waves = [], course.waves.copy()
    for s, wheel in enumerate(stand.flywheels):
        mean = float(waves[s, 0])
        own = wheel.mounting
        if into_mounting:
            psi, theta, zero = angles_of(wheel)
            own, mean = MountingAngles(psi, theta, zero + mean), 0.0
        if isinstance(own, MountingAngles):
            own = MountingAngles(wrapped(own.psi), wrapped(own.theta), wrapped(own.zero))
        waves[s, 0] = wrapped(mean)
        wheels.append(replace(wheel, mounting=own))
    return replace(stand, flywheels=tuple(wheels)), replace(course, waves=waves)


def wrapped(angle: float) -> float:
    """The same angle within half a turn; one that is there already keeps its bits."""
    return angle if -np.pi <= angle <= np.pi else float((angle + np.pi) % (2.0 * np.pi) - np.pi)


def by_harmonic(problem: Problem, course: Periodic) -> list[float]:
    """Amplitude of the relative residual by harmonics 0, 1, .. of the period, to the last that matters."""
    M = 8 * (2 * course.H + 4)
    rows: Array = problem.rows(problem.grid(M, course.H), course)
    spectrum = np.fft.rfft(rows, axis=0) / M
    spectrum[1:] *= 2.0
    sizes = np.linalg.norm(np.abs(spectrum), axis=1)
    told = np.flatnonzero(sizes > max(1e-3 * float(sizes.max(initial=0.0)), ROUNDING))
    return [float(x) for x in sizes[: (int(told.max()) if told.size else 0) + 1]]
