"""Tasks of a stand file: which components of the carrier's motion are demanded, `[task.NAME] rows = [...]`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import Name, Table, validator
from mahovik.core.stand.frames import cross, placement, turn
from mahovik.core.stand.model import COMPONENTS, Component, Instrument, Point, Task, TaskRow
from mahovik.core.stand.names import name_problem
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import QuantityError, show
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


def _component(raw: Any) -> Component:
    for known in COMPONENTS:
        if raw == known:
            return known
    if not isinstance(raw, str):
        raise QuantityError(f"expected one of {', '.join(COMPONENTS)}, found {show(raw)}")
    raise QuantityError(f"unknown component {show(raw)}{suggestion(raw, COMPONENTS)}")


def _components(raw: Any) -> tuple[Component, ...]:
    return tuple(_items(raw, _component))


def _items(raw: Any, read: Callable[[Any], Any]) -> Iterator[Any]:
    """The items of a list that is not empty, each read; QuantityError names the place."""
    if not isinstance(raw, list) or not raw:
        found = "an empty list" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected a list of rows such as ["wx", "wy", "wz"], found {found}')
    for i, item in enumerate(raw):
        try:
            yield read(item)
        except QuantityError as error:
            raise QuantityError(f"[{i}]: {error}") from None


class PointRowsTable(Table):
    """Rows of one point or instrument, in its own axes."""

    point: Name
    rows: Annotated[tuple[Component, ...], validator(_components)]


def _rows(raw: Any) -> tuple[TaskRow, ...]:
    return tuple(row for rows in _items(raw, _item) for row in rows)


def _item(raw: Any) -> tuple[TaskRow, ...]:
    """One component of O1, or some of a point."""
    if not isinstance(raw, dict):
        return (TaskRow("", _component(raw)),)
    unknown = [key for key in raw if key not in PointRowsTable.model_fields]
    if unknown:
        raise QuantityError(f"unknown key {show(unknown[0])}{suggestion(unknown[0], PointRowsTable.model_fields)}")
    for key in PointRowsTable.model_fields:
        if key not in raw:
            raise QuantityError(f'{key} is missing, expected {{ point = "NAME", rows = [...] }}')
    if not isinstance(raw["point"], str):
        raise QuantityError(f"point: expected the name of a point or an instrument, found {show(raw['point'])}")
    try:
        rows = _components(raw["rows"])
    except QuantityError as error:
        where = "rows" if str(error).startswith("[") else "rows: "
        raise QuantityError(f"{where}{error}") from None
    return tuple(TaskRow(raw["point"], component) for component in rows)


class TaskTable(Table):
    """One `[task.NAME]`."""

    rows: Annotated[tuple[TaskRow, ...], validator(_rows)]


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
        elif (found := dependent_rows(task, places)) is not None:
            new, *others = found
            problems.add(
                where,
                "rows",
                f"{new} follows from {', '.join(others)} at every state: rows of a task must be independent; "
                f"leave one of them out",
            )


def places_of(instruments: tuple[Instrument, ...], points: tuple[Point, ...]) -> dict[str, tuple[Array, Array]]:
    """Where instruments and points are in E1, by name."""
    found = {each.name: placement(each) for each in instruments}
    frames = {"carrier": (np.zeros(3), np.eye(3))} | found
    for point in points:
        if point.mount in frames:
            origin, axes = frames[point.mount]
            psi, theta, phi = point.angles
            own = turn(2, psi) @ turn(1, theta) @ turn(0, phi)
            found[point.name] = (origin + axes @ np.array(point.position), axes @ own)
    return found


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
