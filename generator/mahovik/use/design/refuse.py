"""Refuse, before any search, a motion that no design can do."""

from __future__ import annotations

import numpy as np

from mahovik.errors import DesignError
from mahovik.use.design.freedom import Freedom
from mahovik.use.design.task import Task
from mahovik.use.plan.fourier import uniform
from mahovik.use.plan.preflight.first_moment import reach, second_integral
from mahovik.use.plan.preflight.mean_wrench import check_mean_wrench, mean_pose
from mahovik.use.plan.preflight.outcome import Preflight, direction
from mahovik.use.plan.residual import prescribe
from mahovik.use.plan.residual.kinematics import twists

SLACK = 1.01
"""Margin: the carrier turns a little, and the mean pose may move."""


def refuse(task: Task, freedom: Freedom) -> None:
    """Raise DesignError if nothing carries the mean force, or the largest allowed unbalance is too small."""
    motion, problem = task.motion, task.start
    masses = bool(freedom.free[:, 7].any())
    pose = mean_pose(problem)
    if not masses:
        found = Preflight(pose.bias)
        check_mean_wrench(problem, pose, found)
        if found.refusal is not None and found.refusal.words.startswith("a mean force"):
            raise DesignError([f"motion {motion.name}: no design does this: {found.refusal.words}"])
    course = motion.at(uniform(motion.span, max(128, 16 * problem.highest)))
    turns = np.ptp(course.q[:, 3:], axis=0).max() > 0.0
    if masses or any(problem.mechanics.tables.damping) or (turns and freedom.free[:, :3].any()):
        return  # the required flywheel wrench depends on the design
    P = prescribe(problem.mechanics, course, pose.bias).locked()
    C = twists(problem.stand, course).C
    force = (C @ P[:, :3, None])[:, :, 0]
    if problem.norm.relative(np.hstack([force - force.mean(axis=0), np.zeros_like(force)])) <= problem.tolerance:
        return
    most = freedom.most[:, 5]
    if freedom.limits.total_unbalance is not None:
        most = most * min(1.0, freedom.limits.total_unbalance / max(float(most.sum()), 1e-300))
    need, have, way = reach(second_integral(force, motion.span), np.zeros((1, 3, task.N)), most)
    if need > SLACK * have:
        raise DesignError(
            [
                f"motion {motion.name}: no design does this: along {direction(way)} it needs a first moment of "
                f"+-{need:.3g} kg m from the flywheels, all unbalance that they may have is {have:.3g} kg m"
            ]
        )
