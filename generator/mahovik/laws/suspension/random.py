"""A random suspension, for verification and tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from mahovik.core.stand.draw import Draw, rows
from mahovik.core.stand.model import Mat6
from mahovik.laws.suspension.data import Suspension


def random_law(draw: Draw, count: int | None, mounts: Sequence[str]) -> Suspension | None:
    """A definite stiffness and damping, and an equilibrium off the origin; None where there is none."""
    if not draw.flag(None if count is None else count > 0):
        return None
    stiffness, damping = draw.definite6(900.0), draw.definite6(15.0)
    return Suspension(cast(Mat6, rows(stiffness)), cast(Mat6, rows(damping)), draw.vec3(0.1), draw.vec3(0.3))
