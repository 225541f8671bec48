"""Balance quality of flywheels: grades G of ISO 21940-11, by the static unbalance and by the residuals at two planes.

The standard bounds the resultant unbalance, m e, by a grade: e omega. What is left of it is shared among two tolerance
planes, half to each where they lie at equal distances from the centre of mass. The couple unbalance, a moment, has
no grade of its own: it is a pair of unbalances at the planes, the larger the nearer they are.
"""

from __future__ import annotations

import math

from mahovik.core.stand.inertia import inertia_about_center
from mahovik.core.stand.model import Flywheel

GRADES = (0.4, 1.0, 2.5, 6.3, 16.0, 40.0, 100.0, 250.0, 630.0, 1600.0, 4000.0)
"""Grades G of ISO 21940-11: the largest eccentricity times speed of each, mm/s."""

_ROUNDING = 1e-9


def eccentric_velocity(flywheel: Flywheel, speed: float) -> float:
    """Distance of the centre of mass from the axis times the speed (rad/s), m/s: what the grades bound."""
    return math.hypot(*flywheel.center_of_mass[1:]) * abs(speed)


def plane_velocity(flywheel: Flywheel, speed: float, distance: float) -> float | None:
    """Twice the larger residual at two planes, over the mass, times the speed (rad/s), m/s: what the grades bound.

    The planes are `distance` (m) apart, the centre of mass in the middle. None for a flywheel without mass.
    """
    if not flywheel.mass:
        return None
    J, (_, y, z) = inertia_about_center(flywheel), flywheel.center_of_mass
    halves = (0.5 * flywheel.mass * y, 0.5 * flywheel.mass * z)
    pair = (-float(J[0, 1]) / distance, -float(J[0, 2]) / distance)
    larger = max(math.hypot(*(a + sign * b for a, b in zip(halves, pair, strict=True))) for sign in (1.0, -1.0))
    return 2.0 * larger / flywheel.mass * abs(speed)


def grade(velocity: float) -> str:
    """The finest grade that admits this eccentricity times speed, m/s: "G 6.3"; "-" without static unbalance."""
    if velocity == 0.0:
        return "-"
    found = next((each for each in GRADES if 1e3 * velocity <= each * (1.0 + _ROUNDING)), None)
    return f"above G {GRADES[-1]:g}" if found is None else f"G {found:g}"
