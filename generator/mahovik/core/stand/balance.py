"""Balance quality of flywheels: grades G of ISO 21940-11 by the static unbalance."""

from __future__ import annotations

import math

from mahovik.core.stand.model import Flywheel

GRADES = (0.4, 1.0, 2.5, 6.3, 16.0, 40.0, 100.0, 250.0, 630.0, 1600.0, 4000.0)
"""Grades G of ISO 21940-11: the largest eccentricity times speed of each, mm/s."""

_ROUNDING = 1e-9


def eccentric_velocity(flywheel: Flywheel, speed: float) -> float:
    """Distance of the centre of mass from the axis times the speed (rad/s), mm/s: what the grades bound."""
    return 1e3 * math.hypot(*flywheel.center_of_mass[1:]) * abs(speed)


def grade(velocity: float) -> float | None:
    """The finest grade that admits this eccentricity times speed, mm/s; None above the coarsest."""
    return next((each for each in GRADES if velocity <= each * (1.0 + _ROUNDING)), None)


def grade_words(velocity: float) -> str:
    """The grade as it is written, "G 6.3"; "-" for a flywheel without static unbalance."""
    if velocity == 0.0:
        return "-"
    found = grade(velocity)
    return f"above G {GRADES[-1]:g}" if found is None else f"G {found:g}"
