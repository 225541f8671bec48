"""Paths of numbers of a stand file, as campaigns name them: `carrier.center_of_mass[0]`, `w*.inertia.J12`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fnmatch import fnmatchcase
from typing import Any

from mahovik.core.stand.units import show
from mahovik.errors import UsageError
from mahovik.nearest import suggestion

_SPECIAL = re.compile(r"[\[\]*]|\.J[1-3][1-3]$")
_PLACE = re.compile(r"\[(\d+|\*)\]")
_ELEMENT = re.compile(r"J([1-3])([1-3])")

_VECTORS = frozenset(("angles", "center_of_mass", "gravity", "pivot", "position", "stream"))
"""Keys whose three numbers are zero where the file does not give them."""

_SYMMETRIC = ("inertia", "added_mass")


def plain_paths(document: dict[str, Any], path: str) -> list[str]:
    """Paths of keys and numbers joined by dots, for a path in the grammar of campaigns or a pattern with `*`.

    `[i]` is a place in a list, `[i][j]` an element of a matrix, `J12` one of an inertia; of a symmetric matrix both
    elements are meant. Lists that the document gives by one unit, by their diagonal, or not at all as they are zero are
    written out in it, so that the paths lead to numbers. Raises UsageError.
    """
    if not _SPECIAL.search(path):
        return [path]
    steps = _PLACE.sub(r".\1", path).split(".")
    if not all(steps) or any("[" in step or "]" in step for step in steps):
        raise UsageError(
            f"{path}: is no path; expected names joined by dots, and places in brackets, as carrier.center_of_mass[0]"
        )
    named = _bodies_by_name(document)
    first, *rest = steps
    if "*" not in first:
        starts = [first]
    elif not (starts := [name for name in [*named, *_tables(document)] if fnmatchcase(name, first)]):
        raise UsageError(f"{path}: no name matches {show(first)}{suggestion(first.strip('*'), named)}")
    found: list[list[str]] = []
    for name in starts:
        if name in named:
            found += [[name, *each] for each in _below(named[name], rest, path)]
        else:
            found += _below(document, [name, *rest], path)
    if not found:
        raise UsageError(f"{path}: matches no key of {document.get('name', 'the stand')}")
    return [".".join(each) for each in found]


def shown_path(plain: str) -> str:
    """A path of keys and numbers joined by dots as campaigns name it: `leg[1].stiffness`, `w1.inertia.J12`."""
    element = re.compile(r"(?<=\binertia)\.([0-2])\.([0-2])$")
    plain = element.sub(lambda found: f".J{int(found[1]) + 1}{int(found[2]) + 1}", plain)
    return re.sub(r"\.(\d+)(?=\.|$)", r"[\1]", plain)


def _bodies_by_name(document: dict[str, Any]) -> dict[str, dict[str, Any]]:
    lists = [items for items in document.values() if isinstance(items, list)]
    return {item["name"]: item for items in lists for item in items if isinstance(item, dict) and "name" in item}


def _tables(document: dict[str, Any]) -> list[str]:
    return [key for key, value in document.items() if isinstance(value, dict)]


def _below(place: Any, steps: list[str], path: str) -> Iterator[list[str]]:
    """Plain steps from a table or list on. Steps that lead nowhere are kept, and `put` refuses them."""
    if not steps or not isinstance(place, dict | list):
        yield steps
        return
    step, *rest = steps
    if isinstance(place, list):
        for i in range(len(place)) if step == "*" else [int(step)] if step.isdigit() else []:
            yield from ([str(i), *each] for each in _below(place[i] if i < len(place) else None, rest, path))
        if step != "*" and not step.isdigit():
            yield steps
        return
    for key in [each for each in place if fnmatchcase(each, step)] if "*" in step else [step]:
        element = _ELEMENT.fullmatch(rest[0]) if key == "inertia" and rest else None
        inside = [*(str(int(x) - 1) for x in element.groups()), *rest[1:]] if element else rest
        if element and key not in place:
            raise UsageError(f"{path}: expected the inertia as a matrix or its diagonal, but the file gives none")
        if inside and (inside[0].isdigit() or inside[0] == "*"):
            _write_out(place, key, inside)
        pairs = [inside]
        if key in _SYMMETRIC and len(inside) > 1 and inside[0] != inside[1]:
            pairs.append([inside[1], inside[0], *inside[2:]])
        for pair in pairs:
            yield from ([key, *each] for each in _below(place.get(key), pair, path))


def _write_out(place: dict[str, Any], key: str, inside: list[str]) -> None:
    """Write the value of a key as a list of numbers; as a list of rows where the path has two places."""
    value = place.get(key)
    if value is None and key in _VECTORS:
        value = [0, 0, 0]
    if isinstance(value, dict) and value.keys() == {"value", "unit"}:
        value = _with_unit(value["value"], value["unit"])
    if not isinstance(value, list):
        return
    if len(inside) > 1 and inside[1].isdigit() and not any(isinstance(each, dict | list) for each in value):
        value = [[each if i == k else 0 for k in range(len(value))] for i, each in enumerate(value)]
    place[key] = value


def _with_unit(value: Any, unit: str) -> Any:
    return [_with_unit(each, unit) for each in value] if isinstance(value, list) else f"{value} {unit}"
