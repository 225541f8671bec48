"""Design as a whole: what no design can do, search, the cheapest made exact and verified, explanation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import Any

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import DesignError, StateError
from mahovik.use.design.binding import lifted, words
from mahovik.use.design.explain import changes
from mahovik.use.design.finish import finished
from mahovik.use.design.freedom import Freedom
from mahovik.use.design.limits import nearest_two
from mahovik.use.design.outcome import Outcome, Status
from mahovik.use.design.pareto import front
from mahovik.use.design.refuse import refuse
from mahovik.use.design.search import STARTS, Search, Tell, search
from mahovik.use.design.task import Task
from mahovik.use.plan.budget import Budget

AFTER = 30.0
"""s for what follows a search that time cut: polishing, and what binds."""
UNLIMITED = 10**9


@dataclass(frozen=True)
class Wishes:
    """What the caller wants: seed of all draws; seconds that cut the search, None: none; starts of each number of
    flywheels; points of the Pareto front, 0: none."""

    seed: int = 0
    seconds: float | None = None
    starts: int = STARTS
    pareto: int = 0


def design_stand(
    stand: Stand,
    motion_for: Callable[[Stand], RequiredMotion],
    freedom: Freedom,
    wishes: Wishes | None = None,
    tell: Tell | None = None,
) -> Outcome:
    """A stand like `stand` whose carrier can do the motion, with its programme, at least cost; or what binds.

    motion_for   the motion for a stand of so many flywheels: its file may speak of each. Ctrl-C while it searches
                 gives the best so far. Raises DesignError, MotionError.
    """
    asked = wishes or Wishes()
    least, most = freedom.number
    tasks = []
    for N in range(least, most + 1):
        part = replace(stand, flywheels=stand.flywheels[:N])
        motion = motion_for(part)
        if not motion.periodic:
            raise DesignError([f"motion {motion.name}: a design is for a periodic motion; this one is finite"])
        try:
            tasks.append(Task.of(part, motion, freedom.of_first(N)))
        except StateError as error:
            raise DesignError([f"motion {motion.name}: {error}"]) from None
    refuse(tasks[-1], tasks[-1].freedom)
    budget = Budget(UNLIMITED, asked.seconds)
    found = search(tasks, asked.seed, budget, tell, asked.starts)
    effort = {
        "seed": asked.seed,
        "starts": found.starts,
        "steps": budget.taken,
        "flywheels_tried": {str(N): residual for N, residual in found.tried.items()},
        "found": len(found.found),
        "cut_by_time": found.cut,
    }
    after = Budget(UNLIMITED, AFTER if found.cut or found.interrupted else None)
    if not found.found:
        return nothing(found, after, effort)
    return _designed(found, asked, after, effort)


def _designed(found: Search, asked: Wishes, budget: Budget, effort: dict[str, Any]) -> Outcome:
    """The cheapest, as it is written."""
    chosen = found.found[0]
    stand, programme, wrong = finished(chosen, chosen.task.motion, budget)
    over = tuple(programme.report["exceeded"])
    residual = float(programme.report["residual"])
    quality = chosen.task.freedom.quality
    status: Status = "APPROXIMATE" if wrong else "OK"
    told: tuple[str, ...] = ()
    if wrong:
        told = (
            f"the programme is not exact: its relative residual is {residual:.2g}, accepted up to {quality:g} "
            "(`quality`); more flywheels or more freedom would make it exact",
            f"verify-programme refuses it: {wrong}",
        )
    if over:
        status, told = "OK_LIMIT", (*told, *over)
    points = front(found.found, asked.pareto, budget) if asked.pareto else []
    return Outcome(
        status, told, residual, stand, programme, chosen.cost, tuple(changes(chosen)),
        {"before": totals(chosen.task.space.stand), "after": totals(stand)}, tuple(points), effort, found.interrupted,
    )  # fmt: skip


def nothing(found: Search, budget: Budget, effort: dict[str, Any]) -> Outcome:
    """What was tried, and what binds."""
    ended = "cut by time" if found.cut else "interrupted" if found.interrupted else "all starts tried"
    tried = ", ".join(f"{N} flywheels: {residual:.2g}" for N, residual in found.tried.items() if residual < inf)
    first = f"no design was found, which is no proof that there is none: {found.starts} starts, {ended}" + (
        f"; least relative residual with {tried}" if tried else ""
    )
    if found.nearest is None and (found.cut or found.interrupted):
        more: tuple[str, ...] = ("it ended before the first start had come to anything: give it more time",)
    elif found.nearest is None:
        more = ("no start came near: other windings (`speed`), another seed, more flywheels may help",)
    elif found.refused and found.best <= found.nearest[0].freedom.quality:
        more = tuple(dict.fromkeys(found.refused))[:3]
    else:
        task, reached = found.nearest
        more = words(task, reached.residual, [] if found.interrupted else lifted(task, reached, budget))
    return Outcome("NO_DESIGN", (first, *more), found.best, effort=effort, interrupted=found.interrupted)


def totals(stand: Stand) -> dict[str, Any]:
    """Of the flywheels of a stand: number, mass (kg), unbalance (kg m), the two nearest and their distance (m)."""
    from math import hypot

    nearest = nearest_two(stand)
    return {
        "flywheels": len(stand.flywheels),
        "mass": sum(s.mass for s in stand.flywheels),
        "unbalance": sum(s.mass * hypot(*s.center_of_mass[1:]) for s in stand.flywheels),
        "nearest": None if nearest is None else {"distance": nearest[0], "flywheels": nearest[1:]},
    }
