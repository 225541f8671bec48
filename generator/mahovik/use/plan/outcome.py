"""Options of a plan, its progress, and its outcome: a status, programmes best first, and messages."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

from mahovik.core.motion.functions import Samples
from mahovik.core.motion.programme import Programme
from mahovik.errors import whole_number
from mahovik.use.plan.problem import Periodic


@dataclass(frozen=True)
class PlanOptions:
    """Options of a plan. Raises UsageError for those without meaning.

    seed     of all random numbers; the same file and seed give the same programme
    seconds  time limit; None: only the budget of starts and steps ends the search
    enough   programmes of each kind of winding to choose from
    verify   whether to verify the programmes independently
    steps    limit of steps of search and optimisation
    start    motion of the flywheels, over the shortest period, to be made a programme without a search
    """

    seed: int = 0
    seconds: float | None = None
    enough: int = 1
    verify: bool = True
    steps: int = 20_000
    start: Periodic | Samples | None = None

    def __post_init__(self) -> None:
        whole_number("seed", self.seed, 0)


Status = Literal["OK", "OK_LIMIT", "NO_PROGRAM", "SINGULAR_ATTITUDE"]
"""Outcomes of planning. A bad input raises MotionError or StandError before anything is planned."""


class Progress(Protocol):
    """Progress of planning."""

    @property
    def doing(self) -> str:
        """Name of the activity: searching, improving, run-up, run-down, verifying."""

    @property
    def words(self) -> str:
        """One line."""


OnProgress = Callable[[Progress], None]


@dataclass(frozen=True)
class Plan:
    """Outcome of planning.

    status      OK; OK_LIMIT: a bound is exceeded, or no run-up was found; NO_PROGRAM with a `reason` of preflight
                (proven) or SEARCH (not)
    words       reasons, one per line: the refusal, or the exceeded bounds and their excess
    warnings    further remarks, one per line
    programmes  the best one, if any
    effort      starts, steps, windings tried, best residual, seed, whether time cut the search
    """

    status: Status
    reason: str | None
    words: tuple[str, ...]
    warnings: tuple[str, ...]
    programmes: tuple[Programme, ...]
    effort: Mapping[str, Any] = field(default_factory=dict)
    interrupted: bool = False
