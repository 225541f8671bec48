"""Design as a whole: early refusal, search, exact and verified programme for the cheapest design, explanation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import Any

from mahovik.core.motion.required import RequiredMotion
from mahovik.core.stand.model import Stand
from mahovik.errors import DesignError, StateError
from mahovik.use.design.binding import relax_each, words
from mahovik.use.design.explain import changes
from mahovik.use.design.finish import finish
from mahovik.use.design.freedom import Freedom
from mahovik.use.design.limits import nearest_two
from mahovik.use.design.outcome import Outcome, Status
from mahovik.use.design.pareto import front
from mahovik.use.design.refuse import refuse
from mahovik.use.design.search import STARTS, OnProgress, Search, search
from mahovik.use.design.task import Task
from mahovik.use.plan.budget import Budget

AFTER = 30.0
"""s for the work after a search that ran out of time: polishing, and finding what binds."""
UNLIMITED = 10**9


@dataclass(frozen=True)
class DesignOptions:
    """Options of a design.

    seed      of all random numbers
    seconds   time limit of the search; None: unlimited
    starts    for each number of flywheels
    pareto    points of the Pareto front; 0: none
    """

    seed: int = 0
    seconds: float | None = None
    starts: int = STARTS
    pareto: int = 0


def design_stand(
    stand: Stand,
    motion_for: Callable[[Stand], RequiredMotion],
    freedom: Freedom,
    options: DesignOptions | None = None,
    on_progress: OnProgress | None = None,
) -> Outcome:
    """The cheapest stand like `stand` whose carrier can do the motion, with its programme; or the binding constraints.

    motion_for   the motion for a stand with fewer flywheels: the motion file may name each. Ctrl-C during the search
                 gives the best so far. Raises DesignError, MotionError.
    """
    options = options or DesignOptions()
    least, most = freedom.number
    tasks = []
    for N in range(least, most + 1):
        part = replace(stand, flywheels=stand.flywheels[:N])
        motion = motion_for(part)
        if not motion.periodic:
            raise DesignError([f"motion {motion.name}: a design is for a periodic motion; this one is finite"])
        try:
            tasks.append(Task.of(part, motion, freedom.for_first(N)))
        except StateError as error:
            raise DesignError([f"motion {motion.name}: {error}"]) from None
    refuse(tasks[-1], tasks[-1].freedom)
    budget = Budget(UNLIMITED, options.seconds)
    found = search(tasks, options.seed, budget, on_progress, options.starts)
    effort = {
        "seed": options.seed,
        "starts": found.starts,
        "steps": budget.taken,
        "flywheels_tried": {str(N): residual for N, residual in found.tried.items()},
        "found": len(found.found),
        "cut_by_time": found.cut,
    }
    after = Budget(UNLIMITED, AFTER if found.cut or found.interrupted else None)
    if not found.found:
        return no_design(found, after, effort)
    return _outcome(found, options, after, effort)


def _outcome(found: Search, options: DesignOptions, budget: Budget, effort: dict[str, Any]) -> Outcome:
    """Outcome for the cheapest design."""
    chosen = found.found[0]
    stand, programme, wrong = finish(chosen, chosen.task.motion, budget)
    over = tuple(programme.report["exceeded"])
    residual = float(programme.report["residual"])
    quality = chosen.task.freedom.quality
    status: Status = "APPROXIMATE" if wrong else "OK"
    told: tuple[str, ...] = ()
    if wrong:
        told = (
            f"the programme is not exact: its relative residual is {residual:.2g}, accepted up to {quality:g} "
            "(`quality`); more flywheels or more freedom can make it exact",
            f"verify-programme refuses it: {wrong}",
        )
    if over:
        status, told = "OK_LIMIT", (*told, *over)
    points = front(found.found, options.pareto, budget) if options.pareto else []
    return Outcome(
        status, told, residual, stand, programme, chosen.cost, tuple(changes(chosen)),
        {"before": totals(chosen.task.space.stand), "after": totals(stand)}, tuple(points), effort, found.interrupted,
    )  # fmt: skip


def no_design(found: Search, budget: Budget, effort: dict[str, Any]) -> Outcome:
    """Outcome without a design: what was tried, and what binds."""
    ended = "cut by time" if found.cut else "interrupted" if found.interrupted else "all starts tried"
    tried = ", ".join(f"{N} flywheels: {residual:.2g}" for N, residual in found.tried.items() if residual < inf)
    first = f"no design was found (this does not prove that there is none): {found.starts} starts, {ended}" + (
        f"; least relative residual with {tried}" if tried else ""
    )
    if found.nearest is None and (found.cut or found.interrupted):
        more: tuple[str, ...] = ("it ended before the first start had a result: give it more time",)
    elif found.nearest is None:
        more = ("no start came near: try other windings (`speed`), another seed, more flywheels",)
    elif found.refused and found.best <= found.nearest[0].freedom.quality:
        more = tuple(dict.fromkeys(found.refused))[:3]
    else:
        task, reached = found.nearest
        more = words(task, reached.residual, [] if found.interrupted else relax_each(task, reached, budget))
    return Outcome("NO_DESIGN", (first, *more), found.best, effort=effort, interrupted=found.interrupted)


def totals(stand: Stand) -> dict[str, Any]:
    """Totals of a stand's flywheels: number, mass (kg), unbalance (kg m), the two nearest and their distance (m)."""
    from math import hypot

    nearest = nearest_two(stand)
    return {
        "flywheels": len(stand.flywheels),
        "mass": sum(s.mass for s in stand.flywheels),
        "unbalance": sum(s.mass * hypot(*s.center_of_mass[1:]) for s in stand.flywheels),
        "nearest": None if nearest is None else {"distance": nearest[0], "flywheels": nearest[1:]},
    }
