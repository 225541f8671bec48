"""Quantities of jitter at a point: angle and rate of turning, displacement, velocity, acceleration, in its axes."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mahovik.errors import UsageError
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.linear.model import Place, output_rows
from mahovik.use.study.response.periodic import point_motion

ARCSEC = 180.0 * 3600.0 / np.pi
"""1 rad in seconds of arc."""


class Quantity(NamedTuple):
    """unit; turning: of the point's axes, not its place; power: derivatives by time."""

    unit: str
    turning: bool
    power: int

    @property
    def arcsec(self) -> str | None:
        """The unit with seconds of arc, or None."""
        return self.unit.replace("rad", "arcsec") if self.turning else None


QUANTITIES = {
    "angle": Quantity("rad", True, 0),
    "rate": Quantity("rad/s", True, 1),
    "displacement": Quantity("m", False, 0),
    "velocity": Quantity("m/s", False, 1),
    "acceleration": Quantity("m/s2", False, 2),
}


def find_quantity(name: str) -> Quantity:
    """The quantity of a name. Raises UsageError."""
    if name not in QUANTITIES:
        raise UsageError(f"quantity {name!r}: expected one of {', '.join(QUANTITIES)}")
    return QUANTITIES[name]


def values(place: Place, quantity: str, y: Array, V_dot: Array) -> Array:
    """The quantity (M, 3) from states y (M, 12) in the chart about rest and V* (M, 6), in full.

    Angle: rotation vector from rest; rate: angular velocity; both in the point's axes. Others in its axes at rest.
    """
    if quantity == "angle":
        return np.asarray(y[:, 3:6] @ place.axes)
    if quantity == "rate":
        return np.asarray(y[:, 9:] @ place.axes)
    found: Array = getattr(point_motion(place, y, V_dot), quantity)
    return found


def rows(place: Place, quantity: str) -> Array:
    """(3, 6): the quantity's integral of order `power`, to first order in the carrier's pose (x, r) about rest."""
    if find_quantity(quantity).turning:
        return np.hstack([np.zeros((3, 3)), place.axes.T])
    return output_rows(place, np.zeros(6), np.zeros(6))[0][:3, :6]


def by_pose(place: Place, quantity: str, pose: Complex, omega: Array) -> Complex:
    """Amplitudes (..., 3) from those of the pose (..., 6) at omega (...; rad/s)."""
    power = find_quantity(quantity).power
    return np.asarray((pose @ rows(place, quantity).T) * ((1j * omega) ** power)[..., None])
