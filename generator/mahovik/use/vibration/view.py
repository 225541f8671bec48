"""What is seen of a vibration: a quantity of a point or a line of sight, of a freedom of a hold, or a load.

A point has angle, rate, displacement, velocity and acceleration, on its axes; a line of sight turns by a matrix of
sensitivities times displacements and turnings of several points; a freedom has its coordinate about rest, of which the
pose is exp(S xi), and its derivatives. Loads are the reaction of a hold, on the carrier about O1 in E1, and the wrench
of a mount on its flywheel, about the flywheel's origin on its axes at phase zero; force and moment are seen apart.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from mahovik.core.stand.files import TableError, read_columns
from mahovik.core.stand.hold import Hold, freedom_names, twists, wrenches
from mahovik.core.stand.model import Stand
from mahovik.core.stand.units import PLAIN, Dimension
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.use.numeric.se3 import Array, Complex
from mahovik.use.study.linear import Place, output_rows, places
from mahovik.use.vibration.maker import SHAPE, Structure
from mahovik.use.vibration.plant import Scene, coordinates

REACTION = "hold.reaction"
"""Name of the reaction of a hold among what is seen."""


class Quantity(NamedTuple):
    """unit; turning: of axes, not of a place; power: derivatives by time."""

    unit: str
    turning: bool
    power: int

    def derivative(self, omega: Array) -> Complex:
        """Factor (...) of the derivatives at omega (...; rad/s)."""
        return np.asarray((1j * omega) ** self.power)


AXES = ("x", "y", "z")
"""Names of the axes of a point or a load."""

QUANTITIES = {
    "angle": Quantity("rad", True, 0),
    "rate": Quantity("rad/s", True, 1),
    "displacement": Quantity("m", False, 0),
    "velocity": Quantity("m/s", False, 1),
    "acceleration": Quantity("m/s2", False, 2),
}
"""Quantities of a point by name."""

LOADS = {"force": Quantity("N", False, 0), "moment": Quantity("N m", False, 0)}

OF_FREEDOMS = {
    "turn": {
        "angle": QUANTITIES["angle"],
        "rate": QUANTITIES["rate"],
        "acceleration": Quantity("rad/s2", True, 2),
    },
    "slide": {name: QUANTITIES[name] for name in ("displacement", "velocity", "acceleration")},
    "twist": {
        "displacement": Quantity("1", False, 0),
        "velocity": Quantity("1/s", False, 1),
        "acceleration": Quantity("1/s2", False, 2),
    },
}
"""Quantities of a freedom by its kind, then by name."""

SIGHT = "line of sight"
"""Angle of a line of sight, by a matrix of sensitivities of several points."""


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
    """Values at M moments: phases and speeds (M, N) of the flywheels, y (M, 12) in the chart about rest, V* (M, 6).

    push   (M, 6) or (6): wrench on the carrier that keeps its mean place, which is no load
    """

    scene: Scene
    phi: Array
    phi_dot: Array
    y: Array
    V_dot: Array
    push: Array

    def reaction(self) -> Array:
        """Wrench of the hold on the carrier (M, 6), about O1 in E1."""
        return np.asarray(self.scene.reaction(self.scene.drive(self.phi, self.phi_dot), self.y, self.V_dot) - self.push)

    def mount(self, s: int) -> Array:
        """Wrench (M, 6) of a wheel's mount on it, by its number."""
        L = self.scene.chart.mechanics.tables.Lm[s]
        return np.asarray(-self.mount_wrenches()[:, s] @ np.linalg.inv(L).T)

    def mount_wrenches(self) -> Array:
        """Wrench (M, N, 6) of each flywheel on its mount, in E1 about O1."""
        return self.scene.mount_wrenches(self.phi, self.phi_dot, self.y, self.V_dot)


@dataclass(frozen=True, eq=False)
class View:
    """A quantity of motion: of a point, of a line of sight from several, of a freedom.

    name      of the point, of the table of sensitivities, of the freedom
    axes      names of its axes; of three columns of values the first, where it has fewer
    quantity  its name; measure: unit and kind
    rows      (3, 6): the quantity's integral of order `power`, to first order in the carrier's pose (x, r) about rest
    values    the quantity itself (M, 3)
    parts     points, and for each (3, 6): that integral from displacement and turning of the point in its axes
    frame     what its columns are along, in words
    """

    name: str
    axes: tuple[str, ...]
    quantity: str
    measure: Quantity
    rows: Array
    values: Callable[[FullMotion], Array]
    parts: tuple[tuple[Place, Array], ...] = ()
    frame: str = ""

    @staticmethod
    def of(place: Place, quantity: str) -> View:
        """A quantity of one point. Raises UsageError."""
        if quantity not in QUANTITIES:
            raise UsageError(f"quantity {quantity!r}: expected one of {', '.join(QUANTITIES)}")
        measure, part = QUANTITIES[quantity], np.zeros((3, 6))
        part[:, 3:], part[:, :3] = (np.eye(3), 0.0) if measure.turning else (0.0, np.eye(3))

        def values(motion: FullMotion) -> Array:
            """Rotation vector from rest, angular velocity: in the point's axes; others in its axes at rest."""
            if measure.turning:
                return np.asarray((motion.y[:, 3:6] if measure.power == 0 else motion.y[:, 9:]) @ place.axes)
            return point_motion(place, motion.y, motion.V_dot)[measure.power]

        parts = ((place, part),)
        return View(place.name, AXES, quantity, measure, _rows(parts), values, parts, " along its axes")

    @staticmethod
    def sight(name: str, parts: tuple[tuple[Place, Array], ...]) -> View:
        """A line of sight."""

        def values(motion: FullMotion) -> Array:
            total = np.zeros((len(motion.y), 3))
            for place, part in parts:
                moved = point_motion(place, motion.y, motion.V_dot)[0]
                total += np.hstack([moved, motion.y[:, 3:6] @ place.axes]) @ part.T
            return total

        return View(name, AXES, SIGHT, QUANTITIES["angle"], _rows(parts), values, parts)

    def linear(self, motion: LinearMotion) -> Complex:
        """Amplitudes (S, L, 3, P) from those of the pose."""
        return np.asarray((self.rows @ motion.pose) * self.measure.derivative(motion.omega)[:, :, None, None])

    def by_pose(self, pose: Complex, omega: Array) -> Complex:
        """Amplitudes (..., 3) from those of the pose (..., 6) at omega (...; rad/s)."""
        return np.asarray((pose @ self.rows.T) * self.measure.derivative(omega)[..., None])

    def shape(self, structure: Structure) -> Array:
        """(3, m): `rows` from the modes of a structure. Raises TableError."""
        total = np.zeros((3, len(structure.omega)))
        for place, part in self.parts:
            at = structure.at(place.name, "point")
            total += part @ np.vstack([place.axes.T @ at[:3], place.axes.T @ at[3:]])
        return total

    def full(self, motion: FullMotion) -> Array:
        """Values (M, 3) of the quantity."""
        return self.values(motion)


def _rows(parts: tuple[tuple[Place, Array], ...]) -> Array:
    """`View.rows` of points."""
    total = np.zeros((3, 6))
    for place, part in parts:
        displacement = output_rows(place, np.zeros(6), np.zeros(6))[0][:3, :6]
        total += part @ np.vstack([displacement, np.hstack([np.zeros((3, 3)), place.axes.T])])
    return total


def point_motion(place: Place, y: Array, V_dot: Array) -> tuple[Array, Array, Array]:
    """Displacement from rest, velocity, acceleration (M, 3 each) of a point in E0, on its axes at rest."""
    turned = Rotation.from_rotvec(y[:, 3:6])
    origin, v, omega = np.tile(place.origin, (len(y), 1)), y[:, 6:9], y[:, 9:]
    displacement = y[:, :3] + turned.apply(origin) - origin
    velocity = v + np.cross(omega, origin)
    acceleration = V_dot[:, :3] + np.cross(omega, velocity) + np.cross(V_dot[:, 3:], origin)
    return (
        displacement @ place.axes,
        np.asarray(turned.apply(velocity) @ place.axes),
        np.asarray(turned.apply(acceleration) @ place.axes),
    )


@dataclass(frozen=True)
class LoadView:
    """Force or moment of the reaction (`name` is REACTION) or of a flywheel's mount (its name).

    wheel   number of the flywheel; None: the reaction
    """

    name: str
    quantity: str
    wheel: int | None
    axes: tuple[str, ...] = AXES

    @property
    def measure(self) -> Quantity:
        """Unit and kind of the quantity."""
        return LOADS[self.quantity]

    @property
    def frame(self) -> str:
        """What it acts on, and what its columns are along."""
        return " on the carrier, in E1 about O1" if self.wheel is None else " from its mount, along the mount's axes"

    @property
    def rows(self) -> slice:
        """Rows of a wrench that are seen."""
        return slice(0, 3) if self.quantity == "force" else slice(3, 6)

    def linear(self, motion: LinearMotion) -> Complex:
        """Amplitudes (S, L, 3, P) of the load."""
        wrench = motion.reaction() if self.wheel is None else motion.mount(self.wheel)
        return wrench[:, :, self.rows]

    def full(self, motion: FullMotion) -> Array:
        """Values (M, 3) of the load."""
        wrench = motion.reaction() if self.wheel is None else motion.mount(self.wheel)
        return wrench[:, self.rows]


Observable = View | LoadView
"""What is seen."""


def find_view(stand: Stand, name: str, quantity: str | None = None, usual: str = "acceleration") -> Observable:
    """What is seen at a point, an instrument, the carrier's O1, a flywheel, `hold.reaction`, `hold.pitch`, `hold.1`.

    quantity   None: `usual`, where there is none of it the first that there is. Raises UsageError.
    """
    wheels, hold = [s.name for s in stand.flywheels], stand.hold
    freedoms = [] if hold is None else [f"hold.{freedom}" for freedom in freedom_names(hold)]
    points = [*(place.name for place in places(stand)), stand.carrier.name]
    name = {f"hold.{k}": freedom for k, freedom in enumerate(freedoms, start=1)}.get(name, name)
    if name not in (known := [*points, *wheels, *[REACTION] * (hold is not None), *freedoms]):
        raise UsageError(f"at {name}: unknown{suggestion(name, known)}")
    if name in wheels or name == REACTION:
        return LoadView(name, _choose(name, quantity, LOADS, usual), None if name == REACTION else wheels.index(name))
    if name in freedoms and hold is not None:
        return _freedom(hold, freedoms.index(name), quantity, usual)
    if quantity in LOADS:
        held = f", or {REACTION}" if hold is not None else ""
        words = f"a flywheel, for the wrench of its mount on it{held}"
        raise UsageError(f"quantity {quantity}: {name} has none; expected {words}")
    return View.of(places(stand, [name])[0], _choose(name, quantity, QUANTITIES, usual))


def _freedom(hold: Hold, number: int, quantity: str | None, usual: str) -> View:
    """A quantity of one freedom: the first of three columns, the others are zero. Raises UsageError."""
    name, measures = freedom_names(hold)[number], OF_FREEDOMS[hold.freedoms[number].kind]
    chosen, S = _choose(f"hold.{name}", quantity, measures, usual), twists(hold)
    measure, row = measures[chosen], np.zeros((3, 6))
    row[0] = wrenches(hold)[:, number]  # u = W^T V

    def values(motion: FullMotion) -> Array:
        if measure.power:
            return np.asarray((motion.y[:, 6:] if measure.power == 1 else motion.V_dot) @ row.T)
        freedom = np.zeros((len(motion.y), 3))
        freedom[:, 0] = coordinates(S, motion.y)[:, number]
        return freedom

    return View(f"hold.{name}", (name,), chosen, measure, row, values)


def _choose(name: str, quantity: str | None, known: Mapping[str, Quantity], usual: str) -> str:
    if quantity is not None and quantity not in known:
        raise UsageError(f"quantity {quantity}: {name} has none; expected one of {', '.join(known)}")
    return quantity or (usual if usual in known else next(iter(known)))


def read_sight(path: Path, stand: Stand) -> View:
    """The line of sight of a CSV file: columns `POINT x` to `POINT z` [rad/m], `POINT rx` to `POINT rz` [-].

    Two or three rows: angles of the line of sight. Displacement and turning are along the point's axes; missing columns
    are zero. Raises TableError.
    """
    known_places = {place.name: place for place in [*places(stand), *places(stand, [stand.carrier.name])]}
    angle = Dimension("an angle by displacement", "rad/m")
    known = {f"{name} {part}": PLAIN if part.startswith("r") else angle for name in known_places for part in SHAPE}
    table = read_columns(path, known, ())
    if table.rows not in (2, 3):
        raise TableError([f"{path}: {table.rows} rows, expected two or three: the angles of the line of sight"])
    parts = []
    for name in dict.fromkeys(column.rpartition(" ")[0] for column in table.numbers):
        matrix = np.zeros((3, 6))
        for j, part in enumerate(SHAPE):
            matrix[: table.rows, j] = table.get(f"{name} {part}")
        parts.append((known_places[name], matrix))
    return View.sight(path.stem, tuple(parts))
