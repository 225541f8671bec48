"""Random stands are free, so that there is no friction to draw."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.stand.draw import Draw
from mahovik.laws.friction.data import Frictions


def random_law(draw: Draw, count: int | None, mounts: Sequence[str]) -> Frictions | None:
    """None: a freedom needs a hold. Nothing is drawn."""
    return None
