"""Longest steps that resolve the friction of freedoms about rest."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.stand.model import Stand
from mahovik.laws.friction.data import frictions_of


def longest(stand: Stand, inertias: Sequence[float]) -> list[tuple[str, float]]:
    """Name of each freedom with dry friction, and inertia times smoothing over breakaway (s).

    About rest friction is a damper of breakaway / smoothing, whose time is that. `inertias`: along each freedom of the
    hold, kg or kg m2.
    """
    return [
        (friction.name, inertias[friction.freedom] * friction.smoothing / friction.breakaway)
        for friction in frictions_of(stand)
        if friction.breakaway > 0.0
    ]
