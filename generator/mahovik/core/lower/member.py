"""Numbers of the structs of a program, one by one, as simulators list them: vocabulary of parameters and laws."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mahovik.core.lower import units
from mahovik.core.lower.units import Unit
from mahovik.core.program.types import Field, Kind, Struct

_INERTIA = ("J11", "J22", "J33", "J12", "J13", "J23")


@dataclass(frozen=True)
class Member:
    """A number of a struct: `positive` where it must not be negative."""

    name: str
    unit: Unit
    description: str
    value: float
    positive: bool = False


def member(value: Any, name: str) -> Any:
    """A member of a struct, given as a mapping or as an object."""
    return value[name] if isinstance(value, Mapping) else getattr(value, name)


def members(prefix: str, struct: Struct, value: Any, of_freedom: Mapping[str, Unit] | None = None) -> Iterator[Member]:
    """Members of a struct but what follows from the hold; those of a struct inside stand under the same prefix.

    `of_freedom`: units, by name, of members whose unit is that of what slides or turns.
    """
    for f in struct.fields:
        if f.of_hold:
            continue
        given = member(value, f.name)
        if isinstance(f.type, Struct):
            yield from members(prefix, f.type, given)
        elif f.type is Kind.REAL:
            what = f"{prefix}: {f.name.replace('_', ' ')}" + (f", {f.comment}" if f.comment else "")
            yield from vector(f"{prefix}.{f.name}", f, given, what, (of_freedom or {}).get(f.name))


def vector(name: str, f: Field, value: Any, description: str, unit: Unit | None = None) -> Iterator[Member]:
    """A scalar or a one-dimensional array; `unit` where the field does not tell it."""
    unit = unit or units.of_member(f.unit)
    if not f.shape:
        positive = f.name in ("mass", "displaced_mass", "length")
        yield Member(name, unit, description, float(value), positive)
        return
    for i, number in enumerate(value):
        if f.name == "inertia":
            text = f"{description.split(', J11', maxsplit=1)[0]} {_INERTIA[i]} about the body's origin, in its own axes"
            yield Member(f"{name}.{_INERTIA[i]}", unit, text, float(number))
        else:
            yield Member(f"{name}[{i + 1}]", unit, f"{description}; component {i + 1}", float(number))


def matrix(name: str, f: Field, rows: Any, unit: Callable[[int, int], Unit], description: str) -> Iterator[Member]:
    """A two-dimensional array, a unit an element."""
    for i, row in enumerate(rows):
        for j, number in enumerate(row):
            place = f"{i + 1},{j + 1}"
            yield Member(f"{name}[{place}]", unit(i, j), f"{description}, element {place}", float(number))
