"""Which constraint binds where nothing was found: each is lifted in turn, and the best start goes on without it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from mahovik.core.motion.required import RequiredMotion
from mahovik.use.design.freedom import PARTS, Freedom, Key, Limits
from mahovik.use.design.solve import Reached, descend
from mahovik.use.design.task import Design, Task, Weighing
from mahovik.use.plan.budget import Budget

WIDER = 4.0
"""How much wider the bounds of a key become when it is lifted."""
STEPS = 80
_POSITIVE: tuple[Key, ...] = ("unbalance", "mass", "inertia")


@dataclass(frozen=True)
class Lifted:
    """A constraint, and the relative residual that the best start comes to without it."""

    name: str
    residual: float


def lifted(task: Task, reached: Reached, budget: Budget) -> list[Lifted]:
    """Every constraint of a task, lifted alone; the one that gains most first."""
    found = []
    for name, motion, freedom in _without_each(task):
        if budget.exhausted:
            break
        other = Task.of(task.space.stand, motion, freedom)
        if other.space.P != task.space.P:
            continue
        start = Design(reached.design.y, reached.design.motion)
        found.append(Lifted(name, other.relative(descend(other, start, Weighing(), STEPS, budget))))
    return sorted(found, key=lambda each: each.residual)


def _without_each(task: Task) -> Iterator[tuple[str, RequiredMotion, Freedom]]:
    """Motion and freedom without one of the constraints each."""
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


def words(task: Task, best: float, found: list[Lifted]) -> tuple[str, ...]:
    """What is said of them, a line each."""
    goal = task.freedom.quality
    bind = [each for each in found if each.residual <= goal]
    if bind:
        return tuple(
            f"{each.name} bind: {WIDER:g} times as wide, or left out, the best start comes to {each.residual:.2g}"
            for each in bind
        )
    if not found:
        return ("no bound and no limit was set that could bind: more has to be free, or more flywheels",)
    most = found[0]
    return (
        f"no single constraint binds: without {most.name}, which gains most, the best start goes from {best:.2g} to "
        f"{most.residual:.2g}; more has to be free, or more flywheels",
    )
