"""Mean wrench: flywheels give none over a period, so the surroundings must carry the weight at some mean pose."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.motion.required import Course
from mahovik.use.plan.array import Array
from mahovik.use.plan.fourier import uniform
from mahovik.use.plan.preflight.outcome import Preflight, Refusal, direction
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.residual.kinematics import in_E1, twists

_STEPS = 60
_TIMES = 32
_DIFFERENCE = 1e-6
_LONGEST = np.array([0.05] * 3 + [0.2] * 3)  # m, rad: step
_FREE = 1e-6
"""Part of the largest singular value below which a direction is free; differences leave 1e-8."""


@dataclass(frozen=True, eq=False)
class MeanPose:
    """The bias with the least mean wrench, and the remaining wrench.

    left     (6; N, N m): remaining mean over the period, in E0 axes, moment about O1
    """

    bias: Array
    left: Array


def mean_pose(problem: Problem) -> MeanPose:
    """Damped Newton over the free components of the bias, with axisymmetric flywheels; free directions stay."""
    t = uniform(problem.motion.span, _TIMES)
    course = problem.motion.at(t)
    free = np.flatnonzero(problem.free)
    root = np.array([1.0] * 3 + [10.0] * 3)  # a moment counts as at 0.1 m
    bias = np.zeros(6)

    def left(at: Array) -> Array:
        return mean_wrench(problem, course, at)

    found = left(bias)
    for _ in range(_STEPS):
        if not len(free) or np.linalg.norm(found) <= 1e-13 * _force_size(problem):
            break
        J = np.empty((6, len(free)))
        for k, component in enumerate(free):
            step = np.zeros(6)
            step[component] = _DIFFERENCE
            J[:, k] = root * (left(bias + step) - left(bias - step)) / (2 * _DIFFERENCE)
        step = np.zeros(6)
        step[free] = -np.linalg.lstsq(J, root * found, rcond=_FREE)[0]
        step *= min(1.0, float(np.min(_LONGEST / np.maximum(np.abs(step), 1e-300))))
        for _ in range(12):
            there = left(bias + step)
            if np.linalg.norm(root * there) < np.linalg.norm(root * found):
                break
            step = step / 4
        else:
            break
        bias, found = bias + step, there
    return MeanPose(bias, found)


def mean_wrench(problem: Problem, course: Course, bias: Array) -> Array:
    """Mean over the times of the whole external wrench (6; N, N m), forces and moments about O1 in E0 axes."""
    own = problem.mechanics
    at = twists(problem.stand, Course(course.q + bias, course.q_dot, course.q_ddot))
    F = own.housing.wrench(at)
    gravity = in_E1(at.C, np.broadcast_to(problem.stand.gravity, at.O1.shape))
    F = F + gravity @ own.tables.weight[0].sum(axis=0).T
    parts = [(at.C @ F[:, k : k + 3, None])[:, :, 0].mean(axis=0) for k in (0, 3)]
    return np.concatenate(parts)


def _force_size(problem: Problem) -> float:
    """Weight of everything, or a force of similar meaning if there is none, N."""
    mass = float(problem.mechanics.mean_inertia[0, 0])
    return max(mass * float(np.linalg.norm(problem.stand.gravity)), 1e-6 * mass)


COORDINATES = ("x", "y", "z", "psi", "theta", "phi")


def _largest_moment(problem: Problem) -> float:
    """Largest moment that the weights of unbalanced flywheels give, N m."""
    return float(problem.mechanics.tables.unbalance.sum() * np.linalg.norm(problem.stand.gravity))


def _uncarried_part(problem: Problem, pose: MeanPose) -> str | None:
    """`force` or `moment` that nothing carries at the mean pose; None: all is carried."""
    force, moment = (np.concatenate(each)[None] for each in ((pose.left[:3], _NONE), (_NONE, pose.left[3:])))
    if problem.norm.relative(force) > problem.tolerance:
        return "force"
    turning = float(np.linalg.norm(pose.left[3:]))
    return (
        "moment" if turning > _largest_moment(problem) and problem.norm.relative(moment) > problem.tolerance else None
    )


def _advice(problem: Problem) -> str:
    """Advice if only means that are held are in the way; else empty."""
    if problem.free.all():
        return ""
    everywhere = mean_pose(replace(problem, free=np.ones(6, dtype=bool)))
    if _uncarried_part(problem, everywhere) is not None:
        return ""
    given = np.array(problem.motion.free_mean, dtype=bool)
    said = []
    for key, held in (("`free_mean`", np.logical_not(given)), ("a bound 0 of `bias`", given > problem.free)):
        names = ", ".join(name for name, is_held in zip(COORDINATES, held, strict=True) if is_held)
        said += [f"{key} holds the mean of {names}"] if names else []
    return f"{' and '.join(said)}: free it, so that the mean pose may shift to where the surroundings carry the wrench"


_NONE = np.zeros(3)
_TILTED = 0.1
"""rad: a larger mean tilt causes a warning."""
_TELLING = 1e-3
"""rad: angles larger than this are named in the warning."""


def check_mean_wrench(problem: Problem, pose: MeanPose, found: Preflight) -> None:
    """Refuses a mean force beyond rounding, and a mean moment that weights of unbalance cannot give.

    A remainder counts if it alone would be a relative residual that is not accepted. Flywheels with damping may have a
    mean wrench: then nothing is refused.
    """
    if any(problem.mechanics.tables.damping):
        return
    force, moment = pose.left[:3], pose.left[3:]
    able = _largest_moment(problem)
    left = _uncarried_part(problem, pose)
    if left == "force":
        size = float(np.linalg.norm(force))
        found.refusal = Refusal(
            "MEAN_WRENCH",
            f"a mean force of {size:.4g} N along {direction(force)} is carried by nothing: flywheels give no mean "
            f"force over a period; {_advice(problem) or 'a suspension, legs or buoyancy that balance it would help'}",
        )
    elif left == "moment":
        turning = float(np.linalg.norm(moment))
        found.refusal = Refusal(
            "MEAN_WRENCH",
            f"a mean moment of {turning:.4g} N m along {direction(moment)} is carried by nothing: weights of "
            f"unbalanced flywheels give at most {able:.3g} N m; "
            f"{_advice(problem) or 'a suspension that is stiff in rotation would help'}",
        )
    tilts = dict(zip(("psi", "theta", "phi"), pose.bias[3:].tolist(), strict=True))
    if max(abs(x) for x in tilts.values()) > _TILTED:
        words = ", ".join(f"{name} {x:.3g} rad" for name, x in tilts.items() if abs(x) > _TELLING)
        found.warnings.append(f"the mean pose is tilted to carry the mean wrench: {words}")
