"""Random stands are free, so that there is no stop to draw."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.stand.draw import Draw
from mahovik.laws.stop.data import Stops


def random_law(draw: Draw, count: int | None, mounts: Sequence[str]) -> Stops | None:
    """None: a freedom needs a hold. Nothing is drawn."""
    return None
