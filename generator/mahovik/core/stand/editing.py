"""Changes of the keys of a stand file by path, as values of Python."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from functools import partial
from numbers import Integral, Real
from typing import Any

from mahovik.core.stand import datasheet
from mahovik.core.stand.columns import atan2, hypot
from mahovik.core.stand.datasheet import UnbalanceTable
from mahovik.core.stand.echoes import moments_of
from mahovik.core.stand.inertia import inertia_about_origin
from mahovik.core.stand.laws import arrays
from mahovik.core.stand.model import Flywheel
from mahovik.core.stand.paths import plain_paths, shown_path
from mahovik.core.stand.problems import Problems
from mahovik.core.stand.units import show
from mahovik.errors import StandError, UsageError
from mahovik.nearest import suggestion


def exact(value: Any) -> Any:
    """A value as TOML has it: lists, tables, and floats with all their digits."""
    if hasattr(value, "tolist"):  # a NumPy array or scalar
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): exact(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [exact(item) for item in value]
    if isinstance(value, bool | str | Decimal):
        return value
    if isinstance(value, Integral):
        return int(value)
    return Decimal(repr(float(value))) if isinstance(value, Real) else value


def put(document: dict[str, Any], changes: Mapping[str, Any]) -> None:
    """Set values by path in the document, the keys of a stand file; a None takes a key away.

    Numbers of `unbalance` are set last, those of a flywheel together: a static unbalance is as given, whatever
    mass and centre of mass are set beside it. Raises UsageError, StandError.
    """
    unbalances: dict[str, dict[str, Any]] = {}
    for path, value in [(each, value) for given, value in changes.items() for each in plain_paths(document, given)]:
        table, _, last = path.rpartition(".")
        if table.endswith(".unbalance"):
            unbalances.setdefault(table, {})[last] = value
        else:
            _put_one(document, path, value)
    for table, keys in unbalances.items():
        place = _holder(document, table, shown_path(f"{table}.{next(iter(keys))}"))
        if isinstance(place, dict) and ("inertia" in place or "center_of_mass" in place):
            place.update(_unbalance_keys(document, place, keys))
        else:
            for key, value in keys.items():
                _put_one(document, f"{table}.{key}", value)


def _holder(document: dict[str, Any], key: str, path: str) -> Any:
    """The table or list that holds the last part of `key`; messages name `path`. Raises UsageError."""
    place: Any = document
    for k, part in enumerate(key.split(".")[:-1]):
        place = _inside(document, place, part, path, first=k == 0)
    return place


def _put_one(document: dict[str, Any], plain: str, value: Any) -> None:
    path = shown_path(plain)
    place, last = _holder(document, plain, path), plain.rpartition(".")[2]
    if isinstance(place, list):
        number = _number(place, last, path)
        if value is None:
            del place[number]
        else:
            place[number] = exact(value)
    elif not isinstance(place, dict):
        raise UsageError(f"{path}: {show(place)} has no keys; expected the path of a key, as w1.unbalance.static")
    elif value is not None:
        place[last] = exact(value)
    elif last in place:
        del place[last]
    else:
        raise UsageError(f"{path}: there is no {show(last)} to take away{suggestion(last, place)}")


def _inside(document: dict[str, Any], place: Any, part: str, path: str, first: bool) -> Any:
    """The value that a part of the path names inside a table or list; a missing table is made."""
    if isinstance(place, list):
        named = {item["name"]: item for item in place if isinstance(item, dict) and "name" in item}
        return named[part] if part in named else place[_number(place, part, path, named)]
    if not isinstance(place, dict):
        raise UsageError(f"{path}: {show(place)} has no keys, so there is no {show(part)} in it")
    if part in place:
        return place[part]
    if not first:
        return place.setdefault(part, {})
    named = {
        item["name"]: item
        for key, items in document.items()
        if isinstance(items, list) and all(isinstance(item, dict) for item in items)
        for item in items
        if "name" in item
    }
    if part not in named:
        known = [*(key for key in document if key != "schema"), *named]
        raise UsageError(f"{path}: {document.get('name', 'the stand')} has no {show(part)}{suggestion(part, known)}")
    return named[part]


def _number(place: list[Any], part: str, path: str, named: Mapping[str, Any] | None = None) -> int:
    """The place in a list that a part of a path gives. Raises UsageError."""
    if part.isascii() and part.isdigit() and int(part) < len(place):
        return int(part)
    if named:
        raise UsageError(f"{path}: no {show(part)}{suggestion(part, named)}")
    raise UsageError(f"{path}: {show(part)}, expected a place from 0 to {len(place) - 1}")


def unbalance_of(wheel: Flywheel) -> dict[str, Any]:
    """The four numbers of `unbalance` of a flywheel, however its file gives it."""
    (_, y, z), J = wheel.center_of_mass, inertia_about_origin(wheel).tolist()
    return {
        "static": wheel.mass * hypot(y, z), "static_at": atan2(z, y),
        "dynamic": hypot(J[0][1], J[0][2]), "dynamic_at": atan2(-J[0][2], -J[0][1]),
    }  # fmt: skip


def _unbalance_keys(document: Mapping[str, Any], table: Mapping[str, Any], keys: Mapping[str, Any]) -> dict[str, Any]:
    """The centre of mass and the inertia of a flywheel with other numbers of its unbalance, as keys of its table."""
    problems, where = Problems(document.get("name", "stand")), f"flywheel {show(table.get('name'))}"
    given = problems.valid(arrays()["flywheel"], dict(table), where)
    note, moments = partial(problems.add, where), moments_of(table)
    wheel = None if given is None else Flywheel.read(given, note, moments)
    if wheel is None:
        raise StandError(problems.lines)
    (x, _, _), J = wheel.center_of_mass, inertia_about_origin(wheel).tolist()
    changed = {name: exact(number) for name, number in (unbalance_of(wheel) | dict(keys)).items()}
    found = problems.valid(UnbalanceTable, changed, f"{where} unbalance")
    if found is None:
        raise StandError(problems.lines)
    _, y, z = datasheet.center_of_mass(wheel.mass, found)
    for i, product in enumerate(datasheet.inertia(J[0][0], (J[1][1], J[2][2]), found)[0]):
        J[0][i] = J[i][0] = product
    return {"center_of_mass": exact([x, y, z]), "inertia": exact(J), "inertia_about": "origin"}
