"""Raw data of the buoyancy of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Vec3


@dataclass(frozen=True)
class Buoyancy(LawData):
    """Archimedes force `-displaced_mass * gravity` at `center` (in the body's frame)."""

    displaced_mass: float
    center: Vec3
