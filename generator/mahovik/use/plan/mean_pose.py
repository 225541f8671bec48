"""The mean pose of the carrier: where the surroundings carry the mean wrench, with axisymmetric flywheels.

A held carrier has the wrench along its freedoms, at its home pose: the hold takes the rest. What else
planning asks of a held carrier stands here, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.motion.functions import Course
from mahovik.core.motion.motion_file import NO_SLEW
from mahovik.core.motion.required import RequiredMotion, Slew
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.core.stand.hold import twists as freedom_twists
from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.masses import transfer
from mahovik.core.stand.model import Stand
from mahovik.errors import MotionError
from mahovik.use.numeric.frame import Frame, Twists, in_E1
from mahovik.use.numeric.se3 import Array
from mahovik.use.plan.problem import Problem, uniform

_STEPS = 60
_TIMES = 32
_DIFFERENCE = 1e-6
_LONGEST = {"m": 0.05, "rad": 0.2, "": 0.2}
"""Longest step of a coordinate, by its unit."""
_MOMENT = 10.0
"""1/m: a moment counts as at 0.1 m."""
_FREE = 1e-6
"""Part of the largest singular value below which a direction is free; differences leave 1e-8."""


@dataclass(frozen=True, eq=False)
class MeanPose:
    """The bias with the least mean wrench, and the remaining wrench.

    wrench   (6; N, N m): remaining mean over the period, in E0 axes, moment about O1
    """

    bias: Array
    wrench: Array


def mean_pose(problem: Problem) -> MeanPose:
    """Damped Newton over the free components of the bias, with axisymmetric flywheels; free directions stay."""
    t = uniform(problem.motion.span, _TIMES)
    course = problem.motion.at(t)
    free = np.flatnonzero(problem.free)
    coordinates = coordinates_of(problem.stand)
    root = np.array([_MOMENT if unit == "rad" else 1.0 for unit in coordinates.unit_names])
    longest = np.array([_LONGEST[unit] for unit in coordinates.unit_names])
    bias = np.zeros(coordinates.count)

    def remaining_wrench(at: Array) -> Array:
        return mean_wrench(problem, course, at)

    result = remaining_wrench(bias)
    for _ in range(_STEPS):
        if not len(free) or np.linalg.norm(result) <= 1e-13 * _force_size(problem):
            break
        J = np.empty((len(bias), len(free)))
        for k, component in enumerate(free):
            step = np.zeros(len(bias))
            step[component] = _DIFFERENCE
            J[:, k] = root * (remaining_wrench(bias + step) - remaining_wrench(bias - step)) / (2 * _DIFFERENCE)
        step = np.zeros(len(bias))
        step[free] = -np.linalg.lstsq(J, root * result, rcond=_FREE)[0]
        step *= min(1.0, float(np.min(longest / np.maximum(np.abs(step), 1e-300))))
        for _ in range(12):
            there = remaining_wrench(bias + step)
            if np.linalg.norm(root * there) < np.linalg.norm(root * result):
                break
            step = step / 4
        else:
            break
        bias, result = bias + step, there
    return MeanPose(bias, result)


def mean_wrench(problem: Problem, course: Course, bias: Array) -> Array:
    """Mean over the times of the whole external wrench (6; N, N m), forces and moments about O1 in E0 axes.

    Of a held carrier: along its freedoms (m), at the home pose.
    """
    mechanics = problem.mechanics
    at = mechanics.frame.twists(course._replace(q=course.q + bias))
    F = mechanics.base.wrench(at)
    gravity = in_E1(at.C, problem.stand.gravity)
    F = F + gravity @ mechanics.tables.weight[0].sum(axis=0).T
    if problem.stand.hold is not None:
        return mean_along_freedoms(problem.stand, at, F)
    parts = [(at.C @ F[:, k : k + 3, None])[:, :, 0].mean(axis=0) for k in (0, 3)]
    return np.concatenate(parts)


def _force_size(problem: Problem) -> float:
    """Weight of everything, or a force of similar meaning if there is none, N."""
    mass = float(problem.mechanics.mean_inertia[0, 0])
    return max(mass * float(np.linalg.norm(problem.stand.gravity)), 1e-6 * mass)


UNITS = {"m": ("force", "N"), "rad": ("moment", "N m"), "": ("wrench", "")}
"""What acts along a coordinate of a unit, and its own unit."""


def refuse_unplannable(stand: Stand, required: RequiredMotion | Slew) -> None:
    """Refuse what is planned for free carriers alone. Raises StandError, MotionError."""
    if stand.hold is None:
        return
    coordinates = coordinates_of(stand)
    if isinstance(required, Slew):
        raise MotionError([f"{required.name}: type: {NO_SLEW}"])
    if len(required.mean) != coordinates.count:
        raise MotionError([f"{required.name}: is of another carrier; expected rows of {coordinates.words}"])


def mean_along_freedoms(stand: Stand, at: Twists, F: Array) -> Array:
    """Mean (m) of wrenches F (M, 6) in E1 about O1 along the freedoms, counted in the home pose.

    There the freedoms stay as they are, so that over a period the momentum along them has no change.
    """
    hold = stand.hold
    assert hold is not None
    S = freedom_twists(hold)
    C0, O0 = (part[0] for part in Frame.of(stand).pose(np.zeros((1, S.shape[1]))))
    result = np.zeros(6)
    for C, O1, wrench in zip(at.C, at.O1, F, strict=True):
        result += transfer(C0.T @ (O1 - O0), C0.T @ C) @ wrench
    return np.asarray(S.T @ result / len(F))


def wrench_of(stand: Stand, along: Array) -> Array:
    """A wrench (..., 6) of what acts along the freedoms (..., m) and nowhere else."""
    assert stand.hold is not None
    return np.asarray(along @ wrenches(stand.hold).T)


def slide_directions(stand: Stand) -> Array | None:
    """Directions (3, k) in E0 along which the momentum of a held carrier is free; None of a free one: all."""
    hold = stand.hold
    if hold is None:
        return None
    C0 = Frame.of(stand).pose(np.zeros((1, len(hold.freedoms))))[0][0]
    slides = [np.array(freedom.direction) for freedom in hold.freedoms if freedom.kind == "slide"]
    return np.asarray(C0 @ np.array([direction / np.linalg.norm(direction) for direction in slides]).reshape(-1, 3).T)
