"""Tasks of a stand file: which components of the carrier's motion are demanded, and whether they go together."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import name_problem
from mahovik.core.stand.masses import cross, placement, turn
from mahovik.core.stand.model import COMPONENTS, Instrument, Point, Task, TaskRow
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.nearest import suggestion

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
            psi, theta, phi = point.angles
            axes_of_point = turn(2, psi) @ turn(1, theta) @ turn(0, phi)
            places[point.name] = (origin + axes @ np.array(point.position), axes @ axes_of_point)
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
