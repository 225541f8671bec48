"""The mean stand: flywheels whose mass properties are means over a turn, so that they do not depend on the phase.

The mean over a turn about the first axis keeps mass, spin inertia and the place of the centre of mass along the axis.
It brings this point onto the axis, makes both transverse inertias equal to their mean, and products of inertia zero.
What is left is smooth in time at any speed. Unbalance and asymmetry, which shake the carrier once or twice a turn, are
left out. Laws of a flywheel are kept as they are.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.model import Flywheel, Stand

Unbalance = Literal["averaged", "resisted"]
"""Choices on unbalance and asymmetry of the flywheels, of a programme or a slew.

resisted   the flywheels move so that these do not move the carrier: (12) holds for the stand
averaged   (12) holds for the mean stand; they shake the carrier besides
"""


def mean_stand(stand: Stand) -> Stand:
    """The stand with each flywheel as its mean over a turn."""
    return replace(stand, flywheels=tuple(mean_flywheel(each) for each in stand.flywheels))


def mean_flywheel(flywheel: Flywheel) -> Flywheel:
    """The mean of a flywheel over a turn about its axis: inertia about its origin, in kg m2."""
    J = inertia_about_origin(flywheel)
    spin, transverse = float(J[0, 0]), 0.5 * float(J[1, 1] + J[2, 2])
    return replace(
        flywheel,
        center_of_mass=(flywheel.center_of_mass[0], 0.0, 0.0),
        inertia=((spin, 0.0, 0.0), (0.0, transverse, 0.0), (0.0, 0.0, transverse)),
        inertia_about="origin",
    )
