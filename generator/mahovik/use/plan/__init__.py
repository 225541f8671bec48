"""Programmes: flywheel motions that make the carrier move as required, (12)-(13).

What it offers is loaded when it is asked for, so that studies which take parts of it start without the rest.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mahovik.use.plan.outcome import Plan, PlanOptions
    from mahovik.use.plan.planner import plan_motion

__all__ = ["Plan", "PlanOptions", "plan_motion"]

_PLACES = {"Plan": "outcome", "PlanOptions": "outcome", "plan_motion": "planner"}
"""Modules of the names."""


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
