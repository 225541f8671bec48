"""Reasons against a design: refusal of a motion before any search, and the binding constraints after a vain one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.coordinates import coordinates_of
from mahovik.errors import DesignError
from mahovik.use.design.freedom import PARTS, Freedom, Key, Limits
from mahovik.use.design.search import DesignFit, descend
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.numeric import prescribe, twists
from mahovik.use.plan.budget import Budget
from mahovik.use.plan.held import slide_directions
from mahovik.use.plan.mean_pose import mean_pose
from mahovik.use.plan.preflight import Preflight, check_mean_wrench, direction, reach, second_integral
from mahovik.use.plan.problem import uniform

SLACK = 1.01
"""Margin: the carrier turns a little, and the mean pose may move."""


_FORCES = ("a mean force", "a force")
"""Words of a refusal about a mean force; a mean moment may be the weight of an unbalance that is free."""


def refuse(task: Task, freedom: Freedom) -> None:
    """Raise DesignError if nothing carries the mean force, or the largest allowed unbalance is too small."""
    motion, problem = task.motion, task.start
    masses = bool(freedom.free[:, 7].any())
    pose = mean_pose(problem)
    if not masses:
        found = Preflight(pose.bias)
        check_mean_wrench(problem, pose, found)
        if found.refusal is not None and found.refusal.words.startswith(_FORCES):
            raise DesignError([f"motion {motion.name}: no design does this: {found.refusal.words}"])
    course = motion.at(uniform(motion.span, max(128, 16 * problem.highest)))
    turning = [k for k, unit in enumerate(coordinates_of(problem.stand).unit_names) if unit != "m"]
    turns = np.ptp(course.q[:, turning], axis=0).max(initial=0.0) > 0.0
    if masses or any(problem.mechanics.tables.damping) or (turns and freedom.free[:, :3].any()):
        return  # the required flywheel wrench depends on the design
    P = prescribe(problem.mechanics, course, pose.bias).locked_wrench()
    C = twists(problem.stand, course).C
    force, ways = (C @ P[:, :3, None])[:, :, 0], slide_directions(problem.stand)
    if ways is not None:  # the hold takes the rest
        force = force @ ways @ ways.T
    if problem.norm.relative(np.hstack([force - force.mean(axis=0), np.zeros_like(force)])) <= problem.tolerance:
        return
    most = freedom.most[:, 5]
    if freedom.limits.total_unbalance is not None:
        most = most * min(1.0, freedom.limits.total_unbalance / max(float(most.sum()), 1e-300))
    need, have, way = reach(second_integral(force, motion.span), np.zeros((1, 3, task.N)), most, ways)
    if need > SLACK * have:
        raise DesignError(
            [
                f"motion {motion.name}: no design does this: along {direction(way)} it needs a first moment of "
                f"+-{need:.3g} kg m from the flywheels; their largest total unbalance is {have:.3g} kg m"
            ]
        )


WIDER = 4.0
"""Factor on the bounds of a key while it is relaxed."""
STEPS = 80
_POSITIVE: tuple[Key, ...] = ("unbalance", "mass", "inertia")


@dataclass(frozen=True)
class RelaxedConstraint:
    """A relaxed constraint, and the relative residual that the best start reaches without it."""

    name: str
    residual: float


def relax_each(task: Task, reached: DesignFit, budget: Budget) -> list[RelaxedConstraint]:
    """Each constraint of a task relaxed in turn, largest gain first."""
    found = []
    for name, motion, freedom in _without_each(task):
        if budget.exhausted:
            break
        other = Task.of(task.space.stand, motion, freedom)
        if other.space.P != task.space.P:
            continue
        start = Design(reached.design.y, reached.design.motion)
        found.append(RelaxedConstraint(name, other.relative(descend(other, start, Weighing(), STEPS, budget))))
    return sorted(found, key=lambda each: each.residual)


def _without_each(task: Task) -> Iterator[tuple[str, RequiredMotion, Freedom]]:
    """Motion and freedom with one constraint removed, for each constraint."""
    own, motion = task.freedom, task.motion
    for key, part in PARTS.items():
        finite = np.isfinite(own.most[:, part] - own.least[:, part]) & own.free[:, part]
        if not finite.any():
            continue
        least, most = own.least.copy(), own.most.copy()
        spread = np.where(finite, (most[:, part] - least[:, part]) * (WIDER - 1.0) / 2.0, 0.0)
        least[:, part] -= spread
        most[:, part] += spread
        if key in _POSITIVE:
            least[:, part] = np.maximum(least[:, part], np.minimum(own.least[:, part], 0.1 * own.most[:, part]))
        yield f"bounds of {key}", motion, replace(own, least=least, most=most)
    for name in ("distance", "total_mass", "total_unbalance"):
        if getattr(own.limits, name) is not None:
            yield f"limit of {name}", motion, replace(own, limits=replace(own.limits or Limits(), **{name: None}))
    for name in ("speed", "speed_min", "acceleration", "torque", "angle", "bias"):
        if getattr(motion.bounds, name) is not None:
            free = replace(motion, bounds=replace(motion.bounds, **{name: None}))
            yield f"the motion file's bound of {name}", free, own
    if own.ties:
        yield "groups", motion, replace(own, ties=())


def binding_words(task: Task, best: float, found: list[RelaxedConstraint]) -> tuple[str, ...]:
    """Message about them, one line each."""
    goal = task.freedom.quality
    bind = [each for each in found if each.residual <= goal]
    if bind:
        return tuple(
            f"{each.name} bind: {WIDER:g} times as wide, or left out, the best start reaches {each.residual:.2g}"
            for each in bind
        )
    if not found:
        return ("no bound or limit was set that could bind: free more numbers, or use more flywheels",)
    most = found[0]
    return (
        f"no single constraint binds: without {most.name}, the best start improves from {best:.2g} to "
        f"{most.residual:.2g}; free more numbers, or use more flywheels",
    )
