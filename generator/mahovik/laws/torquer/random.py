"""Random magnetic torquers, for verification and tests."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.stand.draw import Draw
from mahovik.laws.torquer.data import Torquer, Torquers


def random_law(draw: Draw, count: int | None, mounts: Sequence[str]) -> Torquers | None:
    """The given number of torquers, by default none. They have their own generator, so the rest of a stand stays."""
    own = Draw(draw.rng.spawn(1)[0])
    torquers = tuple(
        Torquer(f"m{k + 1}", mounts[int(own.rng.integers(len(mounts)))], own.vec3(3.0)) for k in range(count or 0)
    )
    return Torquers(own.vec3(0.5), torquers) if torquers else None
