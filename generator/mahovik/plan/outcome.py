"""What planning ends with: a status, programmes best first, and words."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

from mahovik.motion.programme import Programme

Status = Literal["OK", "OK_LIMIT", "NO_PROGRAM", "SINGULAR_ATTITUDE"]
"""BAD_INPUT is a MotionError or StandError before anything is planned."""


class Progress(Protocol):
    """What planning tells on its way."""

    @property
    def doing(self) -> str:
        """What it does: searching, improving, run-up, run-down, verifying."""

    @property
    def starts(self) -> int:
        """Starts tried."""

    @property
    def best(self) -> float:
        """Least relative residual so far."""

    @property
    def found(self) -> Sequence[object]:
        """Programmes so far."""


Tell = Callable[[Progress], None]


@dataclass(frozen=True)
class Plan:
    """Outcome of planning.

    status      OK; OK_LIMIT: a bound is exceeded, or no run-up was found; NO_PROGRAM with a `reason` of preflight
                (proven) or SEARCH (not)
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
