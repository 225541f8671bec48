"""What planning ends with: a status, programmes best first, and words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, Literal, Protocol, TypeVar

from mahovik.core.motion.programme import Programme

Status = Literal["OK", "OK_LIMIT", "NO_PROGRAM", "SINGULAR_ATTITUDE"]
"""BAD_INPUT is a MotionError or StandError before anything is planned."""


class Progress(Protocol):
    """What planning tells on its way."""

    @property
    def doing(self) -> str:
        """What it does: searching, improving, run-up, run-down, verifying."""

    @property
    def words(self) -> str:
        """One line."""


Tell = Callable[[Progress], None]


Kind = TypeVar("Kind")


@dataclass
class Ways(Generic[Kind]):
    """Flywheel motions that may become programmes, best first, each with what its report has to say of the method.

    reason, words   where there are none: why, as in `Plan`
    """

    found: list[tuple[Kind, dict[str, Any]]] = field(default_factory=list)
    reason: str = "SEARCH"
    words: Sequence[str] = ()
    interrupted: bool = False
    cut: bool = False


@dataclass(frozen=True)
class Plan:
    """Outcome of planning.

    status      OK; OK_LIMIT: a bound is exceeded, or no run-up was found; NO_PROGRAM with a `reason` of preflight
                (proven), SEARCH (not), or SINGULAR_PARTITION: det I+ of (13) is zero on the way
    words       why, a line each: the refusal, or the bounds exceeded and by how much
    warnings    what to know besides
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
