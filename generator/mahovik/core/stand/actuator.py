"""An input that a law takes at run time: the deflection of a fin, the speed of a propeller."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Actuator:
    """An input of a law, which has the name of its fin or propeller in states.

    what   the quantity and its unit
    limit  largest magnitude, SI; None: that of every speed
    usual  magnitude in states that are drawn, SI
    """

    what: str
    limit: float | None
    usual: float
