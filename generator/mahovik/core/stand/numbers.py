"""Numbers of a stand file by their paths, flattened once from the tables: value, dimension, bounds; set by path too.

The grammar of paths is that of `paths`: `carrier.center_of_mass[0]`, `w*.inertia.J12`, `leg[0].stiffness`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from typing import Any

from mahovik.core.stand.datasheet import FlywheelForm, UnbalanceTable
from mahovik.core.stand.editing import exact, put, unbalance_of
from mahovik.core.stand.fields import QuantityValidator, Table
from mahovik.core.stand.hold import find_freedom
from mahovik.core.stand.laws import arrays, headers, held_laws, hold_table, tables
from mahovik.core.stand.model import Stand
from mahovik.core.stand.problems import keys_of
from mahovik.core.stand.units import PLAIN, Dimension, number, show
from mahovik.core.stand.written import quantity_and_table
from mahovik.errors import UsageError
from mahovik.nearest import suggestion

_INDEX = re.compile(r"\[(\d+|\*)\]")
_ELEMENT = re.compile(r"J([1-3])([1-3])")
_IDLE = frozenset(("motor", "encoder", "inverse_weight", "inverse_most", "schema"))
"""Keys whose numbers are in no table of the C."""

_SYMMETRIC = ("inertia", "added_mass")
_SHEET = ("spin_inertia", "transverse_inertia", "unbalance")
_BY_TENSOR = ("center_of_mass", "inertia")

Steps = tuple[str | int, ...]
"""Keys and indices that lead to a value of the document."""


@dataclass(frozen=True)
class StandNumber:
    """One number of a stand file.

    path       as columns are named: `w1.unbalance.static`, `carrier.center_of_mass[0]`, `w1.inertia.J12`
    body       first part of the path: a body, a law's table or a key of the file
    key        last key of the path
    value      in the file, or by default; SI
    least      smallest accepted number, above: one that is too small, most: the largest; None: no bound
    place      of the list or matrix that has it, in the document; and `whole`, its value; None of a number by itself
    element    row and column, where it is an element of a symmetric matrix
    """

    path: str
    body: str
    key: str
    dimension: Dimension
    value: float
    least: float | None = None
    above: float | None = None
    most: float | None = None
    place: Steps = ()
    whole: tuple[Any, ...] | None = None
    element: tuple[int, int] | None = None


@dataclass
class _Table:
    """What is below a part of a path: by key, or by index as text; a text says why there is no number.

    written  keys that the file has, which `*` stands for; single: the number that all elements of a list are
    """

    inside: dict[str, _Table | StandNumber | str] = field(default_factory=dict)
    written: frozenset[str] = frozenset()
    single: StandNumber | None = None
    is_list: bool = False


class StandNumbers:
    """All numbers of one stand file."""

    def __init__(self, stand: Stand, document: Mapping[str, Any]) -> None:
        """`document`: the keys of the file of `stand`, as `toml.parse` gives them; it is not changed."""
        self._stand, self._document = stand, document
        self._top = _Table()
        self._read_tables()

    def __iter__(self) -> Iterator[StandNumber]:
        """Every number once, those of zeros that the file leaves out too; in the order of the file's tables."""
        seen: set[str] = set()
        for each in _leaves(self._top):
            if each.path not in seen:
                seen.add(each.path)
                yield each

    def find(self, pattern: str) -> list[StandNumber]:
        """The numbers of a path, or of all paths that a pattern with `*` matches, in the order of the file.

        A path that ends at a vector stands for all its elements. Names that match, but that do not have such a number,
        are left out. Raises UsageError.
        """
        steps = _INDEX.sub(r".\1", pattern).split(".")
        if not all(steps):
            raise UsageError(f"{show(pattern)} is no path; expected names joined by dots, such as carrier.mass")
        found: dict[str, StandNumber] = {}
        refusals: list[UsageError] = []
        for name in self._names(steps[0], pattern):
            try:
                found |= {each.path: each for each in _below(self._top.inside[name], steps[1:], name, pattern)}
            except UsageError as error:  # of a pattern: only what some of its names have is meant
                refusals.append(error)
        if not found:
            raise refusals[0] if refusals else UsageError(f"{pattern}: matches no number of {self._stand.name}")
        return list(found.values())

    def written_out(self, numbers: Iterable[StandNumber]) -> dict[str, Any]:
        """A copy of the document in which lists that have these numbers stand in SI, element by element."""
        document: dict[str, Any] = deepcopy(dict(self._document))
        for each in numbers:
            if each.whole is not None:
                *way, last = each.place
                holder: Any = document
                for step in way:
                    holder = holder[step] if isinstance(step, int) else holder.setdefault(step, {})
                holder[last] = exact(each.whole)
        return document

    def with_values(self, values: Mapping[StandNumber, float]) -> dict[str, Any]:
        """A copy of the document with other numbers, SI. Raises UsageError, StandError."""
        document = self.written_out(values)
        put(document, {each.path: value for each, value in values.items()})
        return document

    def mass(self, name: str) -> float:
        """Mass of a body of the file, kg."""
        return float(next(body.mass for body in self._stand.bodies if body.name == name))

    def _names(self, first: str, pattern: str) -> list[str]:
        headers = {key for key in self._top.inside if key not in self._top.written}
        tables = [name for name in self._top.inside if name not in headers]
        if "*" in first:
            names = [name for name in tables if fnmatchcase(name, first)]
            if not names:
                raise UsageError(f"{pattern}: no name matches {show(first)}{suggestion(first.strip('*'), tables)}")
            return names
        if first not in self._top.inside:
            known = [*tables, *headers]
            raise UsageError(f"{pattern}: {self._stand.name} has no {show(first)}{suggestion(first, known)}")
        return [first]

    # -- tables ------------------------------------------------------------------------------------------------------

    def _read_tables(self) -> None:
        """All tables of the file by name, then the keys outside any table."""
        document, found = self._document, self._top.inside
        for key, table in tables().items():
            if key in document:
                found[key] = self._table(table, document[key], key, (key,))
        for key, table in arrays().items():
            for i, item in enumerate(document.get(key, [])):
                if "name" in item:
                    found[item["name"]] = self._table(table, item, item["name"], (key, i))
                else:
                    items = found.setdefault(key, _Table(is_list=True))
                    assert isinstance(items, _Table)
                    items.inside[str(i)] = self._table(table, item, f"{key}[{i}]", (key, i))
        if "hold" in document:
            found.setdefault("hold", self._table(hold_table(), document["hold"], "hold", ("hold",)))
        self._top.written = frozenset(found)
        for header in headers():
            keys = {key: value for key, value in document.items() if key in keys_of(header)}
            for key, each in self._table(header, keys, "", ()).inside.items():
                found.setdefault(key, each)

    def _table(self, schema: type[Table], raw: Mapping[str, Any], path: str, place: Steps) -> _Table:
        values = schema.model_validate(raw)
        found = _Table(written=frozenset(key for key in raw if key not in _IDLE))
        by_sheet = issubclass(schema, FlywheelForm) and any(key in raw for key in _SHEET)
        for name, info in schema.model_fields.items():
            key = info.alias or name
            below = f"{path}.{key}".lstrip(".")
            if key in _IDLE:
                found.inside[key] = "acts in no table of the C; expected a number of a body or a law"
            elif by_sheet and key in _BY_TENSOR:
                found.inside[key] = f"the file of {self._stand.name} gives {path} by {', '.join(_SHEET)}"
            elif key == "unbalance":
                found.inside[key] = self._table(UnbalanceTable, self._unbalance(path, raw), below, (*place, key))
            else:
                quantity, inner = quantity_and_table((info.annotation, *info.metadata))
                value = getattr(values, name)
                along = self._along_freedom(schema, values, name) if value is not None else None
                if along is not None:
                    quantity, value = QuantityValidator(float, along), number(value, along)
                found.inside[key] = self._key(quantity, inner, value, raw.get(key), below, (*place, key))
        return found

    def _key(
        self,
        quantity: QuantityValidator | None,
        inner: type[Table] | None,
        value: Any,
        raw: Any,
        path: str,
        place: Steps,
    ) -> _Table | StandNumber | str:
        """What is below one key; `value`: of the valid table, `raw`: in the file."""
        body, key = path.partition(".")[0].partition("[")[0], str(place[-1])
        if value is None:
            return f"the file of {self._stand.name} has no {path} to vary"
        if inner is not None and isinstance(value, list | tuple):
            items = {str(i): self._table(inner, raw[i], f"{path}[{i}]", (*place, i)) for i in range(len(value))}
            return _Table(dict(items), is_list=True)
        if inner is not None:
            return self._table(inner, raw or {}, path, place)
        dimension = PLAIN if quantity is None or quantity.dimension is None else quantity.dimension
        if isinstance(value, float):
            bounds = (None,) * 3 if quantity is None else (quantity.least, quantity.above, quantity.most)
            return StandNumber(path, body, key, _of_element(dimension, 0, 0), value, *bounds)
        if not isinstance(value, tuple) or not value or not isinstance(value[0], tuple | float):
            return f"{path} is no number, so it cannot vary"
        found = _Table(is_list=True)
        if isinstance(value[0], float):
            for i, x in enumerate(value):
                found.inside[str(i)] = StandNumber(
                    f"{path}[{i}]", body, key, _of_element(dimension, i, i), x, place=place, whole=value
                )
            if key == "transverse_inertia" and not isinstance(raw, list) and not _has_list(raw):  # one for both axes
                found.single = StandNumber(path, body, key, _of_element(dimension, 0, 0), value[0])
            return found
        if not all(isinstance(x, float) for row in value for x in row):
            return f"{path} is no number, so it cannot vary"
        for i, row in enumerate(value):
            cells = _Table(is_list=True)
            for j, x in enumerate(row):
                a, b = (min(i, j), max(i, j)) if key in _SYMMETRIC else (i, j)
                shown = f"{path}.J{a + 1}{b + 1}" if key == "inertia" else f"{path}[{a}][{b}]"
                element = (a, b) if key in _SYMMETRIC else None
                cells.inside[str(j)] = StandNumber(
                    shown, body, key, _of_element(dimension, a, b), x, place=place, whole=value, element=element
                )
            found.inside[str(i)] = cells
        return found

    def _along_freedom(self, schema: type[Table], table: Any, key: str) -> Dimension | None:
        """Dimension of a number of friction or a stop, which is that of its freedom; None of other numbers."""
        law = next((law for law in held_laws() if schema is law.item.table()), None)
        hold = self._stand.hold
        if law is None or hold is None:
            return None
        return law.item.dimension(key, hold.freedoms[find_freedom(hold, table.freedom)].kind)

    def _unbalance(self, name: str, raw: Mapping[str, Any]) -> Mapping[str, Any]:
        """Unbalance of a flywheel, however its file gives it."""
        if any(key in raw for key in _BY_TENSOR):
            wheel = next(each for each in self._stand.flywheels if each.name == name)
            return {key: exact(value) for key, value in unbalance_of(wheel).items()}
        given: Mapping[str, Any] = raw.get("unbalance", {})
        return given


def _leaves(node: _Table | StandNumber | str) -> Iterator[StandNumber]:
    if isinstance(node, StandNumber):
        yield node
    elif isinstance(node, _Table):
        if node.single is not None:
            yield node.single
        for each in node.inside.values():
            yield from _leaves(each)


def _below(node: _Table | StandNumber | str, steps: list[str], shown: str, pattern: str) -> Iterator[StandNumber]:
    """Numbers that the rest of a pattern names below a part of a path, `shown`. Raises UsageError."""
    if isinstance(node, str):
        raise UsageError(f"{pattern}: {node}")
    if isinstance(node, StandNumber):
        if steps:
            raise UsageError(f"{pattern}: {shown} is one number; expected no more after it")
        yield node
    elif not steps:
        yield from _all_elements(node, shown, pattern)
    elif node.is_list:
        element = _ELEMENT.fullmatch(steps[0])
        step, *rest = (*(str(int(x) - 1) for x in element.groups()), *steps[1:]) if element else steps
        if step != "*" and step not in node.inside:
            found = f", found [{step}]" if step else ""
            raise UsageError(f"{pattern}: {shown}: expected a place from [0] to [{len(node.inside) - 1}]{found}")
        for i in node.inside if step == "*" else [step]:
            yield from _below(node.inside[i], rest, f"{shown}[{i}]", pattern)
    else:
        step, *rest = steps
        if "*" not in step and step not in node.inside:
            raise UsageError(f"{pattern}: unknown key {show(step)}{suggestion(step, list(node.inside))}")
        keys = [key for key in node.inside if fnmatchcase(key, step) and key in node.written] if "*" in step else [step]
        for key in keys:
            yield from _below(node.inside[key], rest, f"{shown}.{key}", pattern)


def _all_elements(node: _Table, shown: str, pattern: str) -> Iterator[StandNumber]:
    """The elements of a vector, to which a path leads that ends there. Raises UsageError."""
    first = next(iter(node.inside.values()), None)
    if not node.is_list:
        key = "mass" if "mass" in node.inside else next(iter(node.inside))
        raise UsageError(f"{pattern}: is a table; expected the path of a number, such as {shown}.{key}")
    if node.single is not None:
        yield node.single
    elif isinstance(first, StandNumber):
        yield from (each for each in node.inside.values() if isinstance(each, StandNumber))
    else:
        *_, example = (each.path for each, _ in zip(_leaves(node), range(2), strict=False))
        raise UsageError(f"{pattern}: expected an element of the matrix, such as {example}")


def _of_element(dimension: Any, i: int, j: int) -> Dimension:
    """Dimension of one element, where it depends on the block of a 6x6."""
    found: Dimension = dimension[i // 3][j // 3] if isinstance(dimension, tuple) else dimension
    return found


def _has_list(raw: Any) -> bool:
    return isinstance(raw, dict) and isinstance(raw.get("value"), list)
