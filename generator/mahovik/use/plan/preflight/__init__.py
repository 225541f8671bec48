"""Checks before any search, in less than a second: motions that no programme of these flywheels can make."""

from __future__ import annotations

import numpy as np

from mahovik.core.motion.required import Course
from mahovik.use.plan.fourier import uniform
from mahovik.use.plan.preflight.bound_reach import check_bound_reach
from mahovik.use.plan.preflight.first_moment import check_first_moment
from mahovik.use.plan.preflight.mean_wrench import check_mean_wrench, mean_pose
from mahovik.use.plan.preflight.outcome import Preflight, Reason, Refusal
from mahovik.use.plan.preflight.span import check_span
from mahovik.use.plan.problem import Problem
from mahovik.use.plan.residual import prescribe
from mahovik.use.plan.residual.kinematics import twists

__all__ = ["Preflight", "Reason", "Refusal", "preflight"]


def preflight(problem: Problem) -> Preflight:
    """Mean wrench, span, first moment, reach inside bounds; the first that fails is the refusal."""
    motion = problem.motion
    t = uniform(motion.span, max(128, 16 * problem.highest))
    course = motion.at(t)
    found = Preflight(np.zeros(6))
    pose = mean_pose(problem)
    found.bias = pose.bias
    if problem.kinked:
        found.warnings.append(f"damping by |V| has kinks: a relative residual up to {problem.tolerance:g} is accepted")
    if motion.periodic:
        check_mean_wrench(problem, pose, found)
    at = prescribe(problem.mechanics, course, found.bias)
    P = at.locked()
    check_span(problem, P, found)
    if motion.periodic and not any(problem.mechanics.tables.damping):
        C = twists(problem.stand, Course(course.q + found.bias, course.q_dot, course.q_ddot)).C
        check_first_moment(problem, (C @ P[:, :3, None])[:, :, 0], C, found)
    check_bound_reach(problem, at, found)
    return found
