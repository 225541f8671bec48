"""Random legs, for verification and tests."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.stand.draw import Draw
from mahovik.laws.leg.data import Leg, Legs


def random_law(draw: Draw, count: int | None, mounts: Sequence[str]) -> Legs | None:
    """The given number of legs, else up to two; None where there is none."""
    legs = tuple(_leg(draw) for _ in range(draw.count(count, 2)))
    return Legs(legs) if legs else None


def _leg(draw: Draw) -> Leg:
    rng = draw.rng
    return Leg(
        draw.vec3(1.0),
        draw.vec3(0.2),
        float(rng.uniform(0.2, 1)),
        float(rng.uniform(50, 500)),
        float(rng.uniform(1, 5)),
    )
