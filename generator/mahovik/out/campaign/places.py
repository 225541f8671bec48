"""Numbers of a stand file that can vary, found by path or by pattern, with their dimension and nominal value."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cached_property
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel

from mahovik.contract.laws import parts
from mahovik.core.stand.fields import Table
from mahovik.core.stand.law_schemas import held_schemas, hold_with_laws, mounted_schemas, with_laws
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.problems import keys_of
from mahovik.core.stand.schema import (
    CarrierTable,
    FlywheelTable,
    Header,
    InstrumentTable,
    PointTable,
    StreamProfileTable,
    UnbalanceTable,
)
from mahovik.core.stand.units import PLAIN, Dimension, number, show
from mahovik.core.stand.written import dimension_and_table
from mahovik.errors import UsageError
from mahovik.nearest import suggestion
from mahovik.out.api.editing import exact, unbalance_of
from mahovik.out.api.stands import Stand

Array = NDArray[np.float64]

_BODIES: dict[str, type[Table]] = {
    "instrument": InstrumentTable,
    "flywheel": FlywheelTable,
    "point": PointTable,
}
_INDEX = re.compile(r"\[(\d+|\*)\]")
_ELEMENT = re.compile(r"J([1-3])([1-3])")
_IDLE = frozenset(("motor", "encoder", "inverse_weight", "inverse_most", "schema"))
"""Keys whose numbers are in no table of the C."""

_SYMMETRIC = ("inertia", "added_mass")


@dataclass(frozen=True)
class Place:
    """One number of a stand file.

    path      as columns are named: `w1.unbalance.static`, `carrier.center_of_mass[0]`, `w1.inertia.J12`
    body      first part of the path: a body, a law's table or a key of the file
    key       last key of the path
    put       path of `Model.tables` that takes the number, or the symmetric matrix that has it
    nominal   value in the stand file, SI
    element   row and column in that matrix; None where `put` takes the number
    """

    path: str
    body: str
    key: str
    put: str
    dimension: Dimension
    nominal: float
    element: tuple[int, int] | None = None


class Places:
    """Numbers of one stand that can vary.

    `found` notes which lists have to stand in SI, number by number, so that one element can be set: see `stand`.
    """

    def __init__(self, stand: Stand) -> None:
        self._core: CoreStand = stand
        self._document = stand.to_dict()
        self._source = stand.name
        self._matrices: dict[str, Array] = {}

    def find(self, pattern: str) -> list[Place]:
        """The numbers of a path, or of all paths that a pattern with `*` matches, in the order of the file.

        A path that ends at a vector stands for all its elements. Names that match, but that do not have such a number,
        are left out. Raises UsageError.
        """
        steps = _INDEX.sub(r".\1", pattern).split(".")
        if not all(steps):
            raise UsageError(f"{show(pattern)} is no path; expected names joined by dots, such as carrier.mass")
        places: list[Place] = []
        refusals: list[UsageError] = []
        for name in self._names(steps[0], pattern):
            try:
                places += self._of(name, steps[1:], pattern)
            except UsageError as error:  # of a pattern: only what some of its names have is meant
                refusals.append(error)
        if not places:
            raise refusals[0] if refusals else UsageError(f"{pattern}: matches no number of {self._source}")
        return places

    def stand(self) -> Stand:
        """The stand, whose keys are written such that `Place.put` leads to numbers; of the same bits."""
        return Stand.from_dict(self._document, self._source)

    def matrices(self) -> dict[str, Array]:
        """Symmetric matrices of which elements were found, by `Place.put`, SI."""
        return self._matrices

    def mass(self, name: str) -> float:
        """Mass of a body of the file, kg."""
        return float(next(body.mass for body in self._core.bodies if body.name == name))

    # -- names -------------------------------------------------------------------------------------------------------

    @cached_property
    def _tables(self) -> Mapping[str, tuple[type[Table], Any, str]]:
        """Schema, keys in the file, and the path of these keys for `put`, by the first part of a path."""
        found: dict[str, tuple[type[Table], Any, str]] = {}
        arrays: dict[str, type[Table]] = {key: with_laws(table) for key, table in _BODIES.items() if key != "point"}
        arrays["point"] = PointTable
        found["carrier"] = (with_laws(CarrierTable), self._document["carrier"], "carrier")
        if "stream_profile" in self._document:
            found["stream_profile"] = (StreamProfileTable, self._document["stream_profile"], "stream_profile")
        for part in parts("schema"):
            arrays |= part.SCHEMA.arrays
            found |= {
                key: (table, self._document[key], key)
                for key, table in part.SCHEMA.tables.items()
                if key in self._document
            }
        arrays |= {law.key: law.table for law in mounted_schemas()}
        for key, table in arrays.items():
            for item in self._document.get(key, []):
                if "name" in item:
                    found[item["name"]] = (table, item, item["name"])
        if "hold" in self._document:
            found.setdefault("hold", (hold_with_laws(), self._document["hold"], "hold"))
        return found

    def along_freedom(self, schema: type[BaseModel], table: Any, key: str) -> Dimension | None:
        """Dimension of a number of friction or a stop, which is that of its freedom; None of other numbers."""
        hold = self._core.hold
        own = [law for law in held_schemas() if schema in law.held.values()]
        return own[0].dimension_of(key, table, hold) if own and hold is not None else None

    @cached_property
    def _lists(self) -> Mapping[str, type[Table]]:
        """Arrays of tables without names, such as legs."""
        return {
            key: table
            for part in parts("schema")
            for key, table in part.SCHEMA.arrays.items()
            if key not in part.SCHEMA.mounted and key in self._document
        }

    @cached_property
    def _headers(self) -> Mapping[str, type[Table]]:
        """Keys outside any table, with their schema."""
        laws = [part.SCHEMA.header for part in parts("schema")]
        return {key: table for table in (Header, *laws) if table is not None for key in keys_of(table)}

    def _names(self, first: str, pattern: str) -> list[str]:
        tables = [*self._tables, *self._lists]
        if "*" in first:
            names = [name for name in tables if fnmatchcase(name, first)]
            if not names:
                raise UsageError(f"{pattern}: no name matches {show(first)}{suggestion(first.strip('*'), tables)}")
            return names
        known = [*tables, *self._headers]
        if first not in known:
            raise UsageError(f"{pattern}: {self._source} has no {show(first)}{suggestion(first, known)}")
        return [first]

    # -- steps -------------------------------------------------------------------------------------------------------

    def _of(self, name: str, steps: list[str], pattern: str) -> Iterator[Place]:
        if name in self._lists:
            items = self._document[name]
            numbers = _indices(steps[:1], len(items), pattern, name)
            for i in numbers:
                walk = _Walk(self, name, f"{name}.{i}", f"{name}[{i}]", pattern)
                yield from walk.table(self._lists[name], items[i], steps[1:])
        elif name in self._tables:
            schema, raw, put = self._tables[name]
            yield from _Walk(self, name, put, name, pattern).table(schema, raw, steps)
        else:
            schema = self._headers[name]
            keys = {key: value for key, value in self._document.items() if key in keys_of(schema)}
            walk = _Walk(self, name, "", "", pattern)
            yield from walk.key(schema, keys, schema.model_validate(keys), name, steps, self._document)

    def unbalance(self, name: str, raw: Mapping[str, Any]) -> UnbalanceTable:
        """Unbalance of a flywheel, however its file gives it."""
        if "inertia" in raw or "center_of_mass" in raw:
            wheel = next(each for each in self._core.flywheels if each.name == name)
            return UnbalanceTable(**{key: exact(value) for key, value in unbalance_of(wheel).items()})
        return UnbalanceTable.model_validate(raw.get("unbalance", {}))


@dataclass(frozen=True)
class _Walk:
    """A way through the tables of one name. `put`: its start as `put` takes it; `shown`: as columns are named."""

    places: Places
    name: str
    put: str
    shown: str
    pattern: str

    def table(self, schema: type[BaseModel], raw: dict[str, Any], steps: list[str]) -> Iterator[Place]:
        """Numbers of a table of the file."""
        if not steps:
            raise UsageError(f"{self.pattern}: is a table; expected the path of a number, such as {self.name}.mass")
        yield from self._in(schema, raw, schema.model_validate(raw), steps)

    def _in(self, schema: type[BaseModel], raw: Any, values: Any, steps: list[str]) -> Iterator[Place]:
        key, *rest = steps
        known = keys_of(cast(type[Table], schema))
        keys = [each for each in known if fnmatchcase(each, key)] if "*" in key else [key]
        for each in keys:
            if each not in known:
                raise UsageError(f"{self.pattern}: unknown key {show(each)}{suggestion(each, known)}")
            if "*" in key and (each not in raw or each in _IDLE):
                continue
            yield from self.key(schema, raw, values, each, rest, raw)

    def key(
        self, schema: type[BaseModel], raw: Any, values: Any, key: str, rest: list[str], document: Any
    ) -> Iterator[Place]:
        """Numbers of one key; `values`: the valid table, `document`: the table of the file that has the key."""
        if key in _IDLE:
            raise UsageError(f"{self.pattern}: acts in no table of the C; expected a number of a body or a law")
        field = schema.model_fields[key]
        dimension, inner = dimension_and_table((field.annotation, *field.metadata))
        value = getattr(values, key)
        if value is not None and (along := self.places.along_freedom(schema, values, key)) is not None:
            dimension, value = along, number(value, along)
        put, shown = f"{self.put}.{key}".lstrip("."), f"{self.shown}.{key}".lstrip(".")
        if key == "unbalance":
            value = self.places.unbalance(self.name, raw)
            inner = UnbalanceTable
        if value is None:
            raise UsageError(f"{self.pattern}: the file of {self.places._source} has no {shown} to vary")
        below = _Walk(self.places, self.name, put, shown, self.pattern)
        if inner is not None and isinstance(value, list | tuple):
            for i in _indices(rest[:1], len(value), self.pattern, shown):
                one = _Walk(self.places, self.name, f"{put}.{i}", f"{shown}[{i}]", self.pattern)
                yield from one._in(inner, document[key][i], value[i], rest[1:] or [""])
        elif inner is not None:
            if not rest:
                raise UsageError(f"{self.pattern}: is a table; expected one of its keys, {', '.join(keys_of(inner))}")
            yield from below._in(inner, raw.get(key, {}), value, rest)
        elif isinstance(value, float):
            if rest:
                raise UsageError(f"{self.pattern}: {shown} is one number; expected no more after it")
            yield self._place(shown, key, put, _of_element(dimension, 0, 0), value)
        elif isinstance(value, tuple) and value and isinstance(value[0], tuple):
            yield from below._matrix(key, rest, dimension, value, document)
        elif isinstance(value, tuple) and value and isinstance(value[0], float):
            yield from below._vector(key, rest, dimension, value, document)
        else:
            raise UsageError(f"{self.pattern}: {shown} is no number, so it cannot vary")

    def _vector(self, key: str, rest: list[str], dimension: Any, value: Any, document: Any) -> Iterator[Place]:
        one_for_all = key in document and not isinstance(document[key], list) and not _has_list(document[key])
        if one_for_all and not rest:  # such as one transverse inertia
            yield self._place(self.shown, key, self.put, dimension, value[0])
            return
        indices = _indices(rest[:1] or ["*"], len(value), self.pattern, self.shown)
        if len(rest) > 1:
            raise UsageError(f"{self.pattern}: {self.shown}[{indices[0]}] is one number; expected no more after it")
        document[key] = exact(value)
        for i in indices:
            yield self._place(f"{self.shown}[{i}]", key, f"{self.put}.{i}", dimension, value[i])

    def _matrix(self, key: str, rest: list[str], dimension: Any, value: Any, document: Any) -> Iterator[Place]:
        element = _ELEMENT.fullmatch(rest[0]) if rest else None
        if element is not None and len(value) == 3 and len(rest) == 1:
            i, j = int(element[1]) - 1, int(element[2]) - 1
        elif len(rest) == 2:
            (i,) = _indices(rest[:1], len(value), self.pattern, self.shown, single=True)
            (j,) = _indices(rest[1:], len(value), self.pattern, self.shown, single=True)
        else:
            example = ".J12" if len(value) == 3 else "[0][0]"
            raise UsageError(f"{self.pattern}: expected an element of the matrix, such as {self.shown}{example}")
        document[key] = exact(value)
        i, j = (min(i, j), max(i, j)) if key in _SYMMETRIC else (i, j)
        shown = f"{self.shown}.J{i + 1}{j + 1}" if len(value) == 3 else f"{self.shown}[{i}][{j}]"
        of = _of_element(dimension, i, j)
        if key in _SYMMETRIC:
            self.places._matrices[self.put] = np.array(value)
            yield self._place(shown, key, self.put, of, value[i][j], (i, j))
        else:
            yield self._place(shown, key, f"{self.put}.{i}.{j}", of, value[i][j])

    def _place(
        self, shown: str, key: str, put: str, dimension: Any, value: float, element: tuple[int, int] | None = None
    ) -> Place:
        return Place(shown, self.name, key, put, dimension if dimension is not None else PLAIN, value, element)


def _of_element(dimension: Any, i: int, j: int) -> Any:
    """Dimension of one element, where it depends on the block of a 6x6."""
    return dimension[i // 3][j // 3] if isinstance(dimension, tuple) else dimension


def _has_list(raw: Any) -> bool:
    return isinstance(raw, dict) and isinstance(raw.get("value"), list)


def _indices(step: list[str], count: int, pattern: str, shown: str, single: bool = False) -> list[int]:
    """The places in a list that a step of a path names. Raises UsageError."""
    if step == ["*"] and not single:
        return list(range(count))
    if not step or not step[0].isdigit() or int(step[0]) >= count:
        found = f", found [{step[0]}]" if step else ""
        raise UsageError(f"{pattern}: {shown}: expected a place from [0] to [{count - 1}]{found}")
    return [int(step[0])]
