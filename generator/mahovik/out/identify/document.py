"""The text of a stand file with other numbers: comments, order, units and layout stay."""

from __future__ import annotations

import re
from collections.abc import Sequence
from decimal import Decimal
from typing import Any

import tomlkit

from mahovik.core.stand.numbers import StandNumber, ways_of
from mahovik.core.stand.units import INERTIA, LENGTH, Dimension, factor, number
from mahovik.out.api.stands import Stand

_NUMBER = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*")


def with_numbers(text: str, new: Stand, places: Sequence[StandNumber]) -> str:
    """The text of a stand file with the numbers of `new` at the places, in the units of the file.

    A flywheel with centre of mass and inertia in place of `unbalance` keeps these keys. Numbers of 15 digits.
    """
    document = tomlkit.parse(text)
    target = new.to_dict()
    for place in places:
        way = _way(target, place.path, document)
        if "unbalance" in way:
            own = _inside(document, way[: way.index("unbalance")])
            if "inertia" in own or "center_of_mass" in own:
                _put_wheel(own, new, place.body)
                continue
        if place.element is not None:
            _put_element(document, way[:-2], _inside(target, way[:-2]), place)
        else:
            _put_number(document, way, target, place.dimension)
    return tomlkit.dumps(document)


def _put_number(document: Any, way: list[Any], target: Any, dimension: Dimension) -> None:
    """One number, which may stand in a list, in `{ value, unit }`, or in the diagonal of a matrix."""
    container, unit = document, None
    for k, step in enumerate(way[:-1]):
        if isinstance(container, dict) and step not in container:
            container[step] = tomlkit.inline_table()
        container = container[step]
        if isinstance(way[k + 1], int) and isinstance(container, dict):
            unit, container = str(container["unit"]), container["value"]
        rest = way[k + 1 :]
        if len(rest) == 2 and all(isinstance(i, int) for i in rest) and len(_shape(container)) == 1:
            matrix = _inside(target, way[:-2])
            if len(_shape(matrix)) == 2 and any(
                matrix[i][j] for i in range(len(matrix)) for j in range(len(matrix)) if i != j
            ):
                _inside(document, way[:k])[way[k]] = _plain(matrix)
                return
            _put(
                container,
                way[-1],
                _inside(target, way) if len(_shape(matrix)) == 2 else matrix[way[-1]],
                dimension,
                unit,
            )
            return
    _put(container, way[-1], _inside(target, way), dimension, unit)


def _put_wheel(own: Any, new: Stand, name: str) -> None:
    """Centre of mass and inertia of a flywheel, about the point that its file says."""
    wheel = next(each for each in new.flywheels if each.name == name)
    c, J = wheel.center_of_mass, [list(row) for row in wheel.inertia]
    about = own.get("inertia_about", "origin")
    if about != wheel.inertia_about:
        sign = -1.0 if about == "center_of_mass" else 1.0
        square = sum(x * x for x in c)
        for i in range(3):
            for k in range(3):
                J[i][k] += sign * wheel.mass * ((square if i == k else 0.0) - c[i] * c[k])
    least = 1e-15 * sum(J[i][i] for i in range(3))
    J = [[0.0 if abs(x) < least else x for x in row] for row in J]
    if any(c):
        own.setdefault("inertia_about", "origin")
    _put(own, "center_of_mass", c, LENGTH)
    _put_matrix(own, "inertia", J, INERTIA)


def _put_element(document: Any, way: list[Any], matrix: Any, place: StandNumber) -> None:
    """One element of a symmetric matrix, and its mirror image."""
    container, key = _table(document, way[:-1]), way[-1]
    if len(matrix) == 3:
        _put_matrix(container, key, matrix, place.dimension)
        return
    assert place.element is not None
    i, k = place.element
    if isinstance(container.get(key), list) and len(_shape(container[key])) == 2:
        _put(container[key][i], k, matrix[i][k], place.dimension)
        _put(container[key][k], i, matrix[i][k], place.dimension)
    else:
        container[key] = _plain(matrix)


def _put_matrix(container: Any, key: Any, matrix: Any, dimension: Dimension) -> None:
    """A 3x3; a file with three moments keeps its form while products are zero."""
    old = container.get(key)
    inner = old["value"] if isinstance(old, dict) else old
    diagonal = _shape(inner) == (3,) and not any(float(matrix[i][k]) for i in range(3) for k in range(3) if i != k)
    _put(container, key, [matrix[i][i] for i in range(3)] if diagonal else matrix, dimension)


def _put(container: Any, key: Any, value: Any, dimension: Dimension, unit: str | None = None) -> None:
    """Set a value given in SI, in the unit that stands there; what is the same number stays as it is written."""
    there = key in container if isinstance(container, dict) else True
    old = container[key] if there else None
    if isinstance(old, dict) and (not isinstance(value, list | tuple) or _shape(old["value"]) == _shape(value)):
        _put(old, "value", value, dimension, str(old["unit"]))
    elif isinstance(value, list | tuple):
        if isinstance(old, list) and _shape(old) == _shape(value):
            for k, each in enumerate(value):
                _put(old, k, each, dimension, unit)
        else:
            container[key] = _plain(value)
    elif old is None or number(_exact(old), dimension, unit) != float(value):
        container[key] = _in_unit(old, float(value), dimension, unit)


def _in_unit(old: Any, value: float, dimension: Dimension, unit: str | None) -> Any:
    """A number in the unit of the text that stands there."""
    own = _NUMBER.sub("", str(old), count=1) if isinstance(old, str) else unit
    if not own:
        return value
    shown = f"{value / float(factor(own, dimension)):.15g}"
    return f"{shown} {own}" if isinstance(old, str) else float(shown)


def _exact(old: Any) -> Any:
    raw = old.unwrap() if hasattr(old, "unwrap") else old
    return Decimal(repr(raw)) if isinstance(raw, float) else raw


def _way(target: Any, path: str, document: Any) -> list[Any]:
    """Keys and indices of a number of `target` in the document, which may have its tables in another order."""
    key, *rest = ways_of(target, path)[0]
    item = target[key][rest[0]] if rest and isinstance(rest[0], int) else None
    if isinstance(item, dict) and "name" in item:
        rest[0] = [each.get("name") for each in document[key]].index(item["name"])
    return [key, *rest]


def _inside(document: Any, way: list[Any]) -> Any:
    for step in way:
        document = document[step]
    return document


def _table(document: Any, way: list[Any]) -> Any:
    """The table or list that a way leads to, within `{ value, unit }`; missing tables are made."""
    for step in way:
        if isinstance(document, dict) and step not in document:
            document[step] = tomlkit.inline_table()
        document = document[step]
    return document


def _shape(value: Any) -> tuple[int, ...]:
    return (len(value), *_shape(value[0])) if isinstance(value, list | tuple) and value else ()


def _plain(value: Any) -> Any:
    return [_plain(each) for each in value] if isinstance(value, list | tuple) else float(value)
