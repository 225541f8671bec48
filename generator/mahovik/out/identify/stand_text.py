"""The text of a stand file with other numbers: comments, order, units and layout stay."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import tomlkit

from mahovik.core.stand.numbers import StandNumber, ways_of
from mahovik.core.stand.units import Dimension, factor
from mahovik.out.api.stands import Stand

_NUMBER = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*")


def with_numbers(text: str, new: Stand, numbers: Sequence[StandNumber]) -> str:
    """The text of a stand file in which these numbers are those of `new`, 15 digits, in the units of the file.

    A flywheel that its file gives by centre of mass and inertia takes another unbalance as these, in SI.
    """
    document: Any = tomlkit.parse(text)
    target = new.to_dict()
    for number in numbers:
        for way in ways_of(target, number.path):
            key, rest = str(way[0]), list(way[1:])
            wheel = document[key][rest[0]] if "unbalance" in rest else {}
            if "inertia" in wheel or "center_of_mass" in wheel:
                for name in ("center_of_mass", "inertia", "inertia_about"):
                    wheel[name] = _plain(target[key][rest[0]][name])
            else:
                _put(document, key, target[key], rest, number.dimension)
    return tomlkit.dumps(document)


def _put(place: Any, key: Any, value: Any, rest: list[Any], dimension: Dimension, unit: str | None = None) -> None:
    """Set in `place[key]`, whose numbers have a unit or their own, what is at the steps `rest` in `value`, SI."""
    old = place[key] if not isinstance(place, dict) or key in place else None
    scale = float(factor(unit, dimension)) if unit else 1.0
    if isinstance(old, dict) and old.keys() == {"value", "unit"}:
        _put(old, "value", value, rest, dimension, str(old["unit"]))
    elif not rest and old is not None and not isinstance(old, list):
        suffix = _NUMBER.sub("", str(old), count=1) if isinstance(old, str) else ""
        shown = float(value) / (float(factor(suffix, dimension)) if suffix else scale)
        place[key] = f"{shown:.15g} {suffix}" if suffix else float(f"{shown:.15g}") if unit else float(value)
    elif isinstance(old, dict) or (isinstance(old, list) and _shape(old) == _shape(value)):
        _put(old, rest[0], value[rest[0]], rest[1:], dimension, unit)
    elif isinstance(old, list) and len(rest) == 2 and _is_diagonal(value):
        _put(old, rest[0], value[rest[0]][rest[0]], [], dimension, unit)
    else:
        place[key] = _plain(value, scale)


def _is_diagonal(matrix: Any) -> bool:
    return not any(float(x) for i, row in enumerate(matrix) for k, x in enumerate(row) if i != k)


def _shape(value: Any) -> tuple[int, ...]:
    return (len(value), *_shape(value[0])) if isinstance(value, list) and value else ()


def _plain(value: Any, scale: float = 1.0) -> Any:
    if isinstance(value, list):
        return [_plain(element, scale) for element in value]
    if isinstance(value, dict):
        return {key: _plain(element) for key, element in value.items()}
    return value if isinstance(value, str) else float(value) / scale
