"""`buoyancy` of a body in the stand file: Archimedes force on what displaces fluid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Self

import numpy as np

from mahovik.core.stand.declare import AS_VECTOR, TIMES, Draw, Drawn, Size
from mahovik.core.stand.fields import ZERO3, Length3, Mass
from mahovik.core.stand.hold import twists
from mahovik.core.stand.law import BodyLaw
from mahovik.core.stand.masses import mass_properties, placed_bodies
from mahovik.core.stand.model import Stand, Vec3
from mahovik.core.stand.tables import Default

LEVEL = 1e-9
"""m: heights that differ by less are one, rounded."""


@dataclass(frozen=True)
class Buoyancy(BodyLaw):
    """Archimedes force, `-displaced_mass * gravity` at `center`.

    displaced_mass  mass of the displaced fluid
    center          where the force acts, in the body's frame
    """

    displaced_mass: Annotated[Mass, TIMES, Drawn(lambda draw, of: draw.uniform(0.5, 1.2) * of.mass)]
    center: Annotated[Length3, Default(ZERO3), AS_VECTOR, Drawn(lambda draw, of: draw.vec3(of.size / 3))]

    key: ClassVar[str] = "buoyancy"
    carries_weight: ClassVar[bool] = True
    limited: ClassVar[tuple[str, ...]] = ("displaced_mass", "center")
    optional: ClassVar[bool] = False

    @property
    def acts(self) -> bool:
        """Whether anything is displaced."""
        return bool(self.displaced_mass)

    @property
    def is_round(self) -> bool:
        """Whether its centre is on the axis."""
        return not any(self.center[1:])

    @property
    def displaced(self) -> tuple[float, Vec3]:
        """Mass (kg) of the displaced fluid, and its centre."""
        return self.displaced_mass, self.center

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Whether a fixed body displaces mass, and indices of the flywheels that do: only where there is gravity.

        Fixed bodies add up to constants, so it does not matter which of them it is.
        """
        fixed = 1 + len(stand.instruments)
        floating = [i for i, _, _ in cls.of(stand)] if any(stand.gravity) else []
        flywheels = tuple(i for i in floating if i >= fixed)
        return {"buoyancy": any(i < fixed for i in floating), "flywheel_buoyancy": flywheels}

    @classmethod
    def random_with(cls, draw: Draw, of: Size) -> Self | None:
        """About as much as the body weighs."""
        return cls.random(draw, of)

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """Buoyancy below the centre of mass of a stand that is free to tilt: upright it is unstable."""
        if not (any(stand.gravity) and cls.of(stand) and _tilts(stand)):
            return []
        floating = [(placed, law) for placed in placed_bodies(stand) if (law := placed.body.law(cls)) is not None]
        moment = sum((law.displaced_mass * (at.position + at.axes @ law.center) for at, law in floating), np.zeros(3))
        center = moment / sum(law.displaced_mass for _, law in floating)
        down = np.array(stand.gravity) / np.linalg.norm(stand.gravity)
        below = float(down @ (center - mass_properties(stand).center_of_mass))
        if below <= LEVEL:
            return []
        return [
            f"buoyancy: its centre is {1e3 * below:.4g} mm below the centre of mass, along gravity in the attitude of "
            "E0: upright the stand is unstable and turns over; a sign of `center`?"
        ]


def _tilts(stand: Stand) -> bool:
    """Whether the carrier can turn about an axis that is not vertical, with nothing between it and E0 to keep it."""
    if stand.hold is None or stand.laws:
        return not stand.laws
    axes = twists(stand.hold)[3:].T
    return bool(np.any(np.linalg.norm(np.cross(axes, stand.gravity), axis=1) > 0.0))


LAW = Buoyancy
