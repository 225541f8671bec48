"""Buoyancy that was measured a little wrong."""

from __future__ import annotations

from mahovik.core.stand.model import LawData
from mahovik.laws.buoyancy.data import Buoyancy
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Buoyancy | None:
    """Displaced mass times 1 + e, its centre as a vector."""
    return Buoyancy(draw.times(law.displaced_mass), draw.vector(law.center)) if isinstance(law, Buoyancy) else None
