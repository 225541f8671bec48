"""From a design to its output: the stand, and the programme, made exact by the planner's steps and verified."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from mahovik.core.motion.programme import Fourier, Programme
from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import MountingAngles, Stand
from mahovik.use.design.search import Candidate
from mahovik.use.design.solve import EXACT
from mahovik.use.design.space import mounting_angles
from mahovik.use.plan.array import Array
from mahovik.use.plan.bounds import exceeded_bounds, has_bounds
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.certificate import certify, failed_items, make_programme
from mahovik.use.plan.choose import Improver
from mahovik.use.plan.figures import figures, torques_on
from mahovik.use.plan.fourier import Periodic
from mahovik.use.plan.levenberg import refine_periodic
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.search import HARMONIC_COUNTS

ENOUGH = 0.1
"""Part of a programme's tolerance: a residual below this needs no more harmonics."""

ROUNDING = 1e-13
"""Relative residual below which a harmonic counts as zero."""


def finish(chosen: Candidate, motion: RequiredMotion, budget: Budget) -> tuple[Stand, Programme, str]:
    """The stand, its programme with a report, and the objections of the verification; empty: it is exact."""
    task, design = chosen.task, chosen.reached.design
    stand, course = move_phases(task.space.stand_of(design.y), design.motion, task.freedom.phase)
    problem = Problem.of(stand, motion)
    course, exceeded = make_exact(problem, course, budget)
    found = figures(problem, course)
    report: dict[str, Any] = {
        "kind": "design",
        "harmonics": course.H,
        "residual": found.residual,
        "residual_by_harmonic": residual_by_harmonic(problem, course),
        "exceeded": list(exceeded),
        "peak_speed": found.speed,
        "peak_acceleration": found.acceleration,
        "peak_torque": found.torque,
        "least_singular_value": found.sigma,
        "det_I_sign_changes": found.sign_changes,
    }
    fourier = Fourier(np.array(course.mean), np.array(course.cos), np.array(course.sin))
    winding = tuple(round(n) for n in course.winding)
    programme = certify(stand, motion, make_programme(stand, motion, course.bias, winding, fourier, report))
    return stand, programme, failed_items(programme)


def make_exact(problem: Problem, course: Periodic, budget: Budget) -> tuple[Periodic, tuple[str, ...]]:
    """The motion with as many harmonics as it needs, if it can be made exact; bounds that it exceeds."""
    best, least = course, problem.relative(course)
    if least > ENOUGH * problem.tolerance:
        longer = refine_periodic(problem, course, HARMONIC_COUNTS, budget).motion
        if problem.relative(longer) < min(least, problem.tolerance):
            best, least = longer, problem.relative(longer)
    best = drop_harmonics(problem, best, least)
    if not has_bounds(problem.motion.bounds):
        return best, ()
    improver = Improver.of(problem)
    over = _exceeded(problem, best)
    if (over or least > problem.tolerance) and problem.N >= 6:
        found = improver.polish(course, "given", budget)
        if found is not None and found.accepted:
            return found.motion, ()
    return best, over


def drop_harmonics(problem: Problem, course: Periodic, residual: float) -> Periodic:
    """The motion with as few harmonics as possible: constant speed if the others are rounding."""
    for H in range(course.H):
        fewer = course.with_harmonics(H)
        if problem.relative(fewer) <= max(residual, EXACT):
            return fewer
    return course


def _exceeded(problem: Problem, course: Periodic) -> tuple[str, ...]:
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
    told = np.flatnonzero(sizes > max(1e-3 * float(sizes.max(initial=0.0)), ROUNDING))
    return [float(x) for x in sizes[: (int(told.max()) if told.size else 0) + 1]]
