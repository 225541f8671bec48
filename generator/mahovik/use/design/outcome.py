"""Outcome of a design: a status, the stand, its programme, and the explanation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from mahovik.core.motion.programme import Programme
from mahovik.core.stand.model import Stand
from mahovik.use.design.cost import Cost
from mahovik.use.design.explain import Change
from mahovik.use.design.pareto import Point

Status = Literal["OK", "OK_LIMIT", "APPROXIMATE", "NO_DESIGN"]


@dataclass(frozen=True)
class Outcome:
    """Outcome of a design.

    status    OK: its programme is exact and passes the verification; OK_LIMIT: the same, but it exceeds a bound of the
              motion file; APPROXIMATE: its relative residual is within `quality`, no exact programme was found;
              NO_DESIGN: nothing within `quality` was found in the budget, which proves nothing
    words     reasons, one line each: binding constraints, exceeded bounds
    residual  relative residual of the programme, or the least seen
    totals    of the given stand and of the design: unbalance, mass, nearest distance
    """

    status: Status
    words: tuple[str, ...]
    residual: float
    stand: Stand | None = None
    programme: Programme | None = None
    cost: Cost | None = None
    changes: tuple[Change, ...] = ()
    totals: Mapping[str, Any] = field(default_factory=dict)
    front: tuple[Point, ...] = ()
    effort: Mapping[str, Any] = field(default_factory=dict)
    interrupted: bool = False
