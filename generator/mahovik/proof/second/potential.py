"""A law that acts on a body by a potential: vocabulary of the laws of `laws/`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mahovik.core.stand.model import Body
from mahovik.proof.second.bodies import MovingBody
from mahovik.proof.second.chart import Expr


@dataclass(frozen=True)
class Potential:
    """Potential energy of any body under one law.

    count    how many numbers of its own the law has for a body
    numbers  those of a body
    energy   potential energy (J) of a moving body with such numbers in `gravity` (3; m/s2) on the chart's axes
    """

    count: int
    numbers: Callable[[Body], tuple[float, ...]]
    energy: Callable[[MovingBody, Expr, Expr], Expr]
