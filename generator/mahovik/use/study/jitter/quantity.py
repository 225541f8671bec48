"""Quantities of jitter at a point: angle and rate of turning, displacement, velocity, acceleration, in its axes.

A line of sight turns by a matrix of sensitivities times displacements and turnings of several points.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from mahovik.errors import UsageError
from mahovik.use.plan.array import Array, Complex
from mahovik.use.study.jitter.structure import Structure
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


AXES = ("x", "y", "z")
"""Names of the axes of a point or a load."""

QUANTITIES = {
    "angle": Quantity("rad", True, 0),
    "rate": Quantity("rad/s", True, 1),
    "displacement": Quantity("m", False, 0),
    "velocity": Quantity("m/s", False, 1),
    "acceleration": Quantity("m/s2", False, 2),
}

SIGHT = "line of sight"
"""Angle of a line of sight, by a matrix of sensitivities of several points."""


def find_quantity(name: str) -> Quantity:
    """The quantity of a name. Raises UsageError."""
    if name == SIGHT:
        return QUANTITIES["angle"]
    if name not in QUANTITIES:
        raise UsageError(f"quantity {name!r}: expected one of {', '.join(QUANTITIES)}")
    return QUANTITIES[name]


@dataclass(frozen=True, eq=False)
class LinearMotion:
    """Amplitudes of L motions of a rigid carrier at S sets of speeds, P at once.

    omega     (S, L; rad/s, above 0); pose (S, L, 6, P): (x, r) about rest
    reaction  gives that of the hold (S, L, 6, P), on the carrier in E1 about O1
    mount     gives the wrench (S, L, 6, P) of a wheel's mount on it, by its number, on its axes at phase 0
    """

    omega: Array
    pose: Complex
    reaction: Callable[[], Complex]
    mount: Callable[[int], Complex]


@dataclass(frozen=True, eq=False)
class FullMotion:
    """Values at M moments: y (M, 12) in the chart about rest, V* (M, 6); `reaction`, `mount` (M, 6) likewise."""

    y: Array
    V_dot: Array
    reaction: Callable[[], Array]
    mount: Callable[[int], Array]


class Observable(Protocol):
    """Quantity that a study of jitter sees: of a point, a line of sight, or a load."""

    @property
    def name(self) -> str:
        """Name of the point, of the table of sensitivities, or of the load."""

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of its axes; of three columns the first, where it has fewer."""

    @property
    def quantity(self) -> str:
        """Name of the quantity."""

    @property
    def measure(self) -> Quantity:
        """Unit and kind of the quantity."""

    def linear(self, motion: LinearMotion) -> Complex:
        """Amplitudes (S, L, 3, P) of the quantity."""

    def full(self, motion: FullMotion) -> Array:
        """Values (M, 3) of the quantity."""

    def derivative(self, omega: Array) -> Complex:
        """Factor (...) of the quantity's derivatives at omega (...; rad/s)."""

    def shape(self, structure: Structure) -> Array:
        """(3, m): what is seen of structural modes. Raises JitterFileError, UsageError."""


@dataclass(frozen=True, eq=False)
class View:
    """A quantity of one point, or a line of sight from several.

    name      of the point, or of the table of sensitivities
    quantity  a key of QUANTITIES; SIGHT for a line of sight
    parts     points, and for each (3, 6): the quantity's integral of order `power` from displacement and turning of the
              point in its axes
    """

    name: str
    quantity: str
    parts: tuple[tuple[Place, Array], ...]

    @staticmethod
    def of(place: Place, quantity: str) -> View:
        """A quantity of one point. Raises UsageError."""
        part = np.zeros((3, 6))
        part[:, 3:] = np.eye(3) if find_quantity(quantity).turning else 0.0
        part[:, :3] = 0.0 if find_quantity(quantity).turning else np.eye(3)
        return View(place.name, quantity, ((place, part),))

    @property
    def axes(self) -> tuple[str, ...]:
        """Axes of the point."""
        return AXES

    @property
    def measure(self) -> Quantity:
        """Unit and kind of the quantity."""
        return find_quantity(self.quantity)

    @property
    def rows(self) -> Array:
        """(3, 6): the quantity's integral of order `power`, to first order in the carrier's pose (x, r) about rest."""
        found = np.zeros((3, 6))
        for place, part in self.parts:
            displacement = output_rows(place, np.zeros(6), np.zeros(6))[0][:3, :6]
            turning = np.hstack([np.zeros((3, 3)), place.axes.T])
            found += part @ np.vstack([displacement, turning])
        return found

    def linear(self, motion: LinearMotion) -> Complex:
        """Amplitudes (S, L, 3, P) from those of the pose."""
        return np.asarray((self.rows @ motion.pose) * self.derivative(motion.omega)[:, :, None, None])

    def full(self, motion: FullMotion) -> Array:
        """Values (M, 3) from states and V*."""
        return self.values(motion.y, motion.V_dot)

    def by_pose(self, pose: Complex, omega: Array) -> Complex:
        """Amplitudes (..., 3) from those of the pose (..., 6) at omega (...; rad/s)."""
        return np.asarray((pose @ self.rows.T) * self.derivative(omega)[..., None])

    def derivative(self, omega: Array) -> Complex:
        """Factor (...) of `power` derivatives at omega (...; rad/s)."""
        return np.asarray((1j * omega) ** self.measure.power)

    def shape(self, structure: Structure) -> Array:
        """(3, m): the same from the modes of a structure. Raises JitterFileError."""
        found = np.zeros((3, len(structure.omega)))
        for place, part in self.parts:
            at = structure.at(place.name, "point")
            found += part @ np.vstack([place.axes.T @ at[:3], place.axes.T @ at[3:]])
        return found

    def values(self, y: Array, V_dot: Array) -> Array:
        """The quantity (M, 3) from states y (M, 12) in the chart about rest and V* (M, 6), in full.

        Angle: rotation vector from rest; rate: angular velocity; both in the point's axes. Others in its axes at rest.
        """
        if self.quantity == SIGHT:
            found = np.zeros((len(y), 3))
            for place, part in self.parts:
                moved = point_motion(place, y, V_dot).displacement
                found += np.hstack([moved, y[:, 3:6] @ place.axes]) @ part.T
            return found
        place = self.parts[0][0]
        if self.measure.turning:
            return np.asarray(y[:, 3:6] @ place.axes if self.measure.power == 0 else y[:, 9:] @ place.axes)
        motion: Array = getattr(point_motion(place, y, V_dot), self.quantity)
        return motion
