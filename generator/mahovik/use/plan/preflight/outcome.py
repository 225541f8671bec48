"""Outcome of the checks before the search."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from mahovik.use.plan.array import Array

Reason = Literal["MEAN_WRENCH", "SPAN", "FIRST_MOMENT", "BOUND_REACH", "SEARCH", "SINGULAR_ATTITUDE"]


@dataclass(frozen=True)
class Refusal:
    """No programme exists: the message names direction, need, available amount, and what would help."""

    reason: Reason
    words: str


@dataclass
class Preflight:
    """The mean pose, a refusal or None, and warnings.

    bias   (6; m, rad): where the surroundings carry the mean wrench
    reach  used share of the first-moment limit
    """

    bias: Array
    refusal: Refusal | None = None
    warnings: list[str] = field(default_factory=list)
    reach: float = 0.0


AXES = ("x", "y", "z")


def direction(u: Array) -> str:
    """A direction (3) in words: the name of an axis, else its numbers."""
    u = u / np.linalg.norm(u)
    k = int(np.argmax(np.abs(u)))
    if abs(u[k]) > 0.999:
        return AXES[k]
    return "(" + ", ".join(f"{x:.2f}" for x in np.round(u * np.sign(u[k]), 2) + 0.0) + ")"
