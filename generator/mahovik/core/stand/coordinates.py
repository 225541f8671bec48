"""How the carrier's motion is told: by coordinates of its pose, by tasks, rows of its acceleration that are demanded.

A free carrier has six coordinates, a held one those of its freedoms, from its home pose.

The pose of a held carrier is its home pose moved by one freedom after the other, each by its own coordinate: first what
slides, in the order of the file, then what turns, in the order of the stand's sequence. So a coordinate is the way of
the pivot along a direction of the home pose, the angle about an axis, and with three turns one of three angles. Turns
of a sequence that begins and ends with the same axis would be singular at home: there the order is yaw, pitch, roll.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import name_problem
from mahovik.core.stand.hold import FREEDOMS, closing_words, freedom_names, freedom_words, is_closed
from mahovik.core.stand.masses import cross, placement
from mahovik.core.stand.model import COMPONENTS, Hold, Instrument, Point, Sequence, Stand, Task, TaskRow
from mahovik.core.stand.tables import Problems
from mahovik.core.stand.units import ANGLE, LENGTH, PLAIN, Dimension, show
from mahovik.errors import StandError
from mahovik.nearest import suggestion

FREE = ("x", "y", "z", "psi", "theta", "phi")
"""Coordinates of a free carrier: O1 in E0, then the angles of the stand's sequence."""

TURNS: dict[Sequence, tuple[str, str, str]] = {
    "ship": ("yaw", "pitch", "roll"),
    "aircraft": ("pitch", "yaw", "roll"),
    "euler": ("yaw", "roll", "yaw"),
}
"""Freedoms that psi, theta, phi turn along."""


@dataclass(frozen=True)
class Coordinates:
    """names, dimensions: of each; order: numbers of the freedoms, the first to move the home pose first.

    held: whether they are those of a held carrier; described: each in words, of a held carrier
    """

    names: tuple[str, ...]
    dimensions: tuple[Dimension, ...]
    held: bool = False
    order: tuple[int, ...] = ()
    described: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """Number of the coordinates."""
        return len(self.names)

    @property
    def in_words(self) -> tuple[str, ...]:
        """Each for people: its name, or how it moves."""
        return self.described or self.names

    @property
    def unit_names(self) -> tuple[str, ...]:
        """Unit of each, in SI; empty for one of a basis."""
        return tuple({LENGTH: "m", ANGLE: "rad"}.get(dimension, "") for dimension in self.dimensions)

    @property
    def groups(self) -> tuple[tuple[int, ...], ...]:
        """Numbers of the coordinates of one unit, by unit."""
        kinds = dict.fromkeys(self.dimensions)
        return tuple(tuple(k for k, dimension in enumerate(self.dimensions) if dimension == kind) for kind in kinds)

    @property
    def words(self) -> str:
        """How many numbers a row has, and of what."""
        noun = "number" if self.count == 1 else "numbers"
        return f"{self.count} {noun} ({', '.join(self.in_words)})"


def coordinates_of(stand: Stand) -> Coordinates:
    """Coordinates of a free carrier or of a held one. StandError: it is clamped, or its freedoms are no closed set."""
    hold = stand.hold
    if hold is None:
        return Coordinates(FREE, (LENGTH,) * 3 + (ANGLE,) * 3)
    if not hold.freedoms:
        reason = "no freedoms: clamped, the carrier makes no motion that could be planned"
        raise StandError([f'{stand.name}: hold: {reason}; expected a freedom, such as freedoms = ["yaw"]'])
    if not is_closed(hold):
        reason = "freedoms that are not a closed set, as of a knife edge, have no coordinates of a motion to be planned"
        raise StandError([f"{stand.name}: hold: {reason}; {closing_words(hold)}"])
    dimensions = {"slide": LENGTH, "turn": ANGLE, "twist": PLAIN}
    kinds = tuple(dimensions[freedom.kind] for freedom in hold.freedoms)
    return Coordinates(tuple(freedom_names(hold)), kinds, True, _order(hold, stand.angles), tuple(freedom_words(hold)))


def _order(hold: Hold, sequence: Sequence) -> tuple[int, ...]:
    turns = [k for k, freedom in enumerate(hold.freedoms) if freedom.kind == "turn"]
    if len(turns) > 1:  # a closed set: all three
        names = TURNS["ship" if sequence == "euler" else sequence]
        turns = [hold.freedoms.index(FREEDOMS[name]) for name in names]
    return (*(k for k, freedom in enumerate(hold.freedoms) if freedom.kind != "turn"), *turns)


# -- tasks: which components are demanded, and whether they go together ------------------------------------------------

Array = NDArray[np.float64]
Places = Mapping[str, tuple[Array, Array]]
"""Origin (3, m, in E1) and axes (3x3, columns in E1) of instruments and points by name."""

_DEPENDENT = 1e-9
"""Sine of the angle of a row to those before it, below which it says nothing new; lengths by the largest arm."""

_RESERVED_NAMES = frozenset(("fast", "options", "result", "work", "at", "batch"))
_BEGINNINGS = ("fast_", "work_")
_ENDINGS = ("_at", "_batch", "_result", "_options", "_work")
"""Beginnings and ends of names of functions and types that have the name of a task in them."""


def name_of_task_problem(name: str) -> str | None:
    """Why `name` cannot be a task's: its functions end in it, so that some names would be those of other things."""
    problem = name_problem(name)
    if problem is not None:
        return problem
    if name in _RESERVED_NAMES or name.startswith(_BEGINNINGS) or name.endswith(_ENDINGS):
        return (
            f"{show(name)} would make a name of the C that is taken, since a task's functions end in its name; "
            "expected another, such as pointing"
        )
    return None


def row_name(row: TaskRow) -> str:
    """`wx`, or `telescope.wy` of a point or instrument."""
    return f"{row.of}.{row.component}" if row.of else row.component


def check_tasks(
    problems: Problems, tasks: tuple[Task, ...], instruments: tuple[Instrument, ...], points: tuple[Point, ...]
) -> None:
    """Note rows of unknown points, repeated rows, and rows that depend on one another."""
    places = places_of(instruments, points)
    for task in tasks:
        where = f"task {show(task.name)}"
        unknown = [row.of for row in task.rows if row.of and row.of not in places]
        if unknown:
            hint = suggestion(unknown[0], places, "there is no point or instrument")
            if unknown[0] == "carrier":
                hint = ': rows of the carrier itself are those of O1, and stand without a point, rows = ["wx", ...]'
            problems.add(where, "rows", f"unknown point {show(unknown[0])}{hint}")
            continue
        names = [row_name(row) for row in task.rows]
        twice = next((name for k, name in enumerate(names) if name in names[:k]), None)
        if twice is not None:
            problems.add(where, "rows", f"{twice} is given twice")
        elif (dependent := dependent_rows(task, places)) is not None:
            new, *earlier = dependent
            problems.add(
                where,
                "rows",
                f"{new} follows from {', '.join(earlier)} at every state: rows of a task must be independent; "
                f"leave one of them out",
            )


def places_of(instruments: tuple[Instrument, ...], points: tuple[Point, ...]) -> dict[str, tuple[Array, Array]]:
    """Where instruments and points are in E1, by name."""
    places = {instrument.name: placement(instrument) for instrument in instruments}
    frames = {"carrier": (np.zeros(3), np.eye(3))} | places
    for point in points:
        if point.mount in frames:
            origin, axes = frames[point.mount]
            at, own_axes = placement(point)
            places[point.name] = (origin + axes @ at, axes @ own_axes)
    return places


def row_vector(row: TaskRow, places: Places) -> Array:
    """A row of S (6): what it takes of (v*, omega*)."""
    k, linear = COMPONENTS.index(row.component) % 3, row.component.startswith("v")
    origin, axes = places[row.of] if row.of else (np.zeros(3), np.eye(3))
    direction = axes[:, k]
    if not linear:
        return np.concatenate([np.zeros(3), direction])
    return np.concatenate([direction, cross(origin) @ direction])


def dependent_rows(task: Task, places: Places) -> tuple[str, ...] | None:
    """Names of the first row that earlier ones give, and of those; None where the rows are independent."""
    rows = np.array([row_vector(row, places) for row in task.rows])
    arm = max(1e-9, *(float(np.linalg.norm(row[3:])) for row in rows))
    scaled = rows / np.array([1.0] * 3 + [arm] * 3)
    scaled /= np.linalg.norm(scaled, axis=1)[:, None]
    for k in range(1, len(scaled)):
        share, *_ = np.linalg.lstsq(scaled[:k].T, scaled[k], rcond=None)
        if np.linalg.norm(scaled[k] - scaled[:k].T @ share) < _DEPENDENT:
            names = [row_name(row) for row in task.rows]
            return (names[k], *(names[i] for i in range(k) if abs(share[i]) > _DEPENDENT))
    return None
