"""Options of a plan, its progress, and its outcome: a status, programmes best first, and messages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, Literal, Protocol, TypeVar, get_args

from mahovik.core.motion.programme import Programme
from mahovik.core.motion.required import Winding
from mahovik.errors import UsageError, whole_number
from mahovik.nearest import suggestion
from mahovik.use.plan.problem import Periodic

Method = Literal["fourier", "ocp"]


@dataclass(frozen=True)
class PlanOptions:
    """Options of a plan. Raises UsageError for those without meaning.

    seed     of all random numbers; the same file and seed give the same programme
    seconds  time limit; None: only the budget of starts and steps ends the search
    winding  replaces the motion file's
    keep     programmes to return, best first
    enough   programmes of each kind of winding to choose from
    verify   whether to verify the programmes independently
    steps    limit of steps of search and optimisation
    method   fourier; or ocp: (13) by IPOPT from its result, with (12) as constraints
    start    motion of the flywheels over the shortest period, to be made a programme without a search
    """

    seed: int = 0
    seconds: float | None = None
    winding: Winding | None = None
    keep: int = 1
    enough: int = 1
    verify: bool = True
    steps: int = 20_000
    method: Method = "fourier"
    start: Periodic | None = None

    def __post_init__(self) -> None:
        whole_number("seed", self.seed, 0)
        whole_number("keep", self.keep, 1, 99)
        if self.method not in get_args(Method):
            raise UsageError(f'method: unknown "{self.method}"{suggestion(self.method, get_args(Method))}')

    @property
    def seconds_of_search(self) -> float | None:
        """Time limit of the search, s: half of the time is kept for IPOPT if the method needs it."""
        return self.seconds if self.seconds is None or self.method == "fourier" else self.seconds / 2.0


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


Kind = TypeVar("Kind")


@dataclass
class Candidates(Generic[Kind]):
    """Flywheel motions that may become programmes, best first, each with the method's entries for its report.

    words   why there are none, as in `Plan`
    """

    motions: list[tuple[Kind, dict[str, Any]]] = field(default_factory=list)
    words: Sequence[str] = ()
    interrupted: bool = False
    cut: bool = False


@dataclass(frozen=True)
class Plan:
    """Outcome of planning.

    status      OK; OK_LIMIT: a bound is exceeded, or no run-up was found; NO_PROGRAM with a `reason` of preflight
                (proven) or SEARCH (not)
    words       reasons, one per line: the refusal, or the exceeded bounds and their excess
    warnings    further remarks, one per line
    programmes  best first
    effort      starts, steps, windings tried, best residual, seed, whether time cut the search
    """

    status: Status
    reason: str | None
    words: tuple[str, ...]
    warnings: tuple[str, ...]
    programmes: tuple[Programme, ...]
    effort: Mapping[str, Any] = field(default_factory=dict)
    interrupted: bool = False
