"""Keys and numbers of a stand file by their paths: `carrier.center_of_mass[0]`, `w*.inertia.J12`, `leg[0].stiffness`.

A path begins with the name of a body, a point or a law's part, or with a key of the file. `[i]` is a place in a list,
`[i][j]` an element of a matrix, `J12` one of an inertia, `*` what there is. `put` changes any keys of a document,
`StandNumbers` has all numbers, flattened once from the tables: value, dimension, bounds; `written_numbers` those with
units, as they are written.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from copy import deepcopy
from dataclasses import dataclass
from decimal import Decimal
from fnmatch import fnmatchcase
from functools import partial
from itertools import chain
from numbers import Integral, Real
from typing import Any

from mahovik.core.stand import datasheet
from mahovik.core.stand.columns import atan2, hypot
from mahovik.core.stand.datasheet import FlywheelForm, UnbalanceTable, moments_of
from mahovik.core.stand.fields import (
    ADDED_MASS,
    SHARE,
    asymmetries,
    beyond_a_turn,
    list_item,
    scalar,
    text_with_unit,
    vector,
)
from mahovik.core.stand.hold import find_freedom
from mahovik.core.stand.laws import arrays, carrier_laws, headers, held_laws, hold_table, tables
from mahovik.core.stand.masses import inertia_about_origin
from mahovik.core.stand.model import Flywheel, Hold, Stand
from mahovik.core.stand.tables import Blocks, Problems, QuantityValidator, Table, declared_keys, keys_of, read_table
from mahovik.core.stand.units import ANGLE, INERTIA, PLAIN, Dimension, number, show
from mahovik.errors import StandError, UsageError
from mahovik.nearest import suggestion

Way = tuple[str | int, ...]
"""Keys and indices that lead to a value of a document."""
Steps = tuple[str, ...]
"""Names, keys and places, as text, of a path."""

_PLACE = re.compile(r"\[(\d+|\*)\]")
_ELEMENT = re.compile(r"J([1-3])([1-3])")

_VECTORS = frozenset(("angles", "center_of_mass", "gravity", "pivot", "position", "stream"))
"""Keys whose three numbers are zero where the file does not give them."""
_SYMMETRIC = ("inertia", "added_mass")
_IDLE = frozenset(("encoder", "inverse_weight", "inverse_most", "schema", "constant", "resistance", "supply"))
"""Keys whose numbers decide no motion; beside them `motor` where torques are given."""
_SHEET = ("spin_inertia", "transverse_inertia", "unbalance")
_BY_TENSOR = ("center_of_mass", "inertia")
_BODIES = ("carrier", "instrument", "flywheel")


def steps_of(path: str) -> Steps:
    """The steps of a path or a pattern. Raises UsageError."""
    steps: list[str] = []
    for step in _PLACE.sub(r".\1", path).split("."):
        if not step or "[" in step or "]" in step:
            words = "is no path; expected names joined by dots, and places in brackets, as carrier.center_of_mass[0]"
            raise UsageError(f"{path}: {words}")
        element = _ELEMENT.fullmatch(step) if steps and steps[-1] == "inertia" else None
        steps += [str(int(x) - 1) for x in element.groups()] if element else [step]
    return tuple(steps)


def path_of(steps: Iterable[str]) -> str:
    """The path of steps."""
    path = "".join(f"[{step}]" if step.isdigit() else f".{step}" for step in steps).removeprefix(".")
    element = re.compile(r"(?<=\binertia)\[([0-2])\]\[([0-2])\]$")
    return element.sub(lambda result: f".J{int(result[1]) + 1}{int(result[2]) + 1}", path)


# -- changes of a document -------------------------------------------------------------------------------------------


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


def in_si(value: float | str, dimension: Dimension) -> float:
    """A number that is in SI, also as a text, or a text with a unit. Raises QuantityError."""
    try:
        return float(value)
    except ValueError:
        return number(exact(value), dimension)


def put(document: dict[str, Any], changes: Mapping[str, Any]) -> None:
    """Set values by path in the document, the keys of a stand file; a None takes a key away.

    Numbers of `unbalance` are set last, those of a flywheel together: a static unbalance is as given, whatever
    mass and centre of mass are set beside it. Items of lists go at the end, so that places are those of the document.
    Raises UsageError, StandError.
    """
    unbalances: dict[Way, dict[str, Any]] = {}
    removed = set[Way]()
    for path, value in changes.items():
        for way in ways_of(document, path):
            if value is None and isinstance(way[-1], int):
                removed.add(way)
            elif way[-2:-1] == ("unbalance",):
                unbalances.setdefault(way[:-2], {})[str(way[-1])] = value
            else:
                _put(document, way, value, path)
    for way, keys in unbalances.items():
        wheel = value_at(document, way)
        if "inertia" in wheel or "center_of_mass" in wheel:
            wheel.update(_unbalance_keys(document, wheel, keys))
        else:
            for key, value in keys.items():
                _put(document, (*way, "unbalance", key), value, f"{wheel.get('name')}.unbalance.{key}")
    for way in sorted(removed, reverse=True):
        del value_at(document, way[:-1])[way[-1]]


def value_at(document: Any, way: Way) -> Any:
    """What is in the document where a way leads; tables that are missing are made."""
    for step in way:
        if isinstance(step, str) and step not in document:
            document[step] = {}
        document = document[step]
    return document


def _put(document: dict[str, Any], way: Way, value: Any, path: str) -> None:
    place: Any = value_at(document, way[:-1])
    last: Any = way[-1]
    if value is not None:
        place[last] = exact(value)
    elif last in place:
        del place[last]
    else:
        raise UsageError(f"{path}: there is no {show(last)} to take away{suggestion(last, place)}")


def ways_of(document: dict[str, Any], path: str) -> list[Way]:
    """Where a path or a pattern leads in a document; of a symmetric matrix both elements are meant.

    Lists that the document gives by one unit, by their diagonal, or not at all as they are zero are written out in it,
    so that each way is that of a number. Raises UsageError.
    """
    first, *rest = steps_of(path)
    parts = [part for law in carrier_laws() if law.key == first for part in law.made_of if part in document]
    if parts and len(rest) > 1:
        raise UsageError(f"{path}: [[{parts[0]}]] make it: expected a number of one of them")
    starts: dict[str, Way] = {key: (key,) for key, value in document.items() if isinstance(value, dict)}
    starts |= {name: way for name, (way, _) in _named(document).items()}
    if "*" not in first and not (first in starts or first in document or first in _VECTORS or not rest):
        known = [*(key for key in document if key != "schema"), *starts]
        raise UsageError(f"{path}: {document.get('name', 'the stand')} has no {show(first)}{suggestion(first, known)}")
    ways: list[Way] = []
    for name in names_of(document, path):
        start = starts.get(name, ())
        ways += _below(value_at(document, start), start, rest if start else [name, *rest], path)
    if not ways:
        raise UsageError(f"{path}: matches no key of {document.get('name', 'the stand')}")
    return ways


def _named(document: Mapping[str, Any]) -> dict[str, tuple[Way, type[Table]]]:
    """Ways to all tables that have a name, and their classes."""
    named: dict[str, tuple[Way, type[Table]]] = {"carrier": (("carrier",), tables()["carrier"])}
    for key, table in arrays().items():
        items = document.get(key)
        for i, item in enumerate(items if isinstance(items, list) else ()):
            if isinstance(item, dict) and "name" in item:
                named[item["name"]] = ((key, i), table)
    return named


def names_of(document: Mapping[str, Any], path: str) -> list[str]:
    """What a path begins with, or the names that its pattern matches, of tables that may have the key after it.

    These are bodies; where none may have it, points and parts of laws that have a name. Raises UsageError.
    """
    first, *rest = steps_of(path)
    if "*" not in first:
        return [first]
    named = _named(document)
    matching = {name: named[name] for name in named if fnmatchcase(name, first)}
    if not matching:
        raise UsageError(f"{path}: no name matches {show(first)}{suggestion(first.strip('*'), named)}")
    known = {name: keys_of(table) for name, (_, table) in matching.items()}
    names = [name for name in matching if not rest or any(fnmatchcase(key, rest[0]) for key in known[name])]
    if not names:
        keys = list(chain.from_iterable(known.values()))
        raise UsageError(f"{path}: unknown key {show(rest[0])} of {', '.join(matching)}{suggestion(rest[0], keys)}")
    return [name for name in names if matching[name][0][0] in _BODIES] or names


def _below(place: Any, way: Way, steps: list[str], path: str) -> Iterator[Way]:
    """Where steps lead from a value of a document on, `way` from its top."""
    if not steps:
        yield way
        return
    step, *rest = steps
    if isinstance(place, list):
        for i in range(len(place)) if step == "*" else [_index(place, step, path)]:
            yield from _below(place[i], (*way, i), rest, path)
        return
    if not isinstance(place, dict):
        raise UsageError(f"{path}: {show(place)} has no keys, so there is no {show(step)} in it")
    for key in [name for name in place if fnmatchcase(name, step)] if "*" in step else [step]:
        pairs = [rest]
        if rest and (rest[0].isdigit() or rest[0] == "*"):
            if key == "inertia" and key not in place:
                raise UsageError(f"{path}: expected the inertia as a matrix or its diagonal, but the file gives none")
            _write_out(place, key, rest)
            if place.get(key) is None:  # what reads the document says what it should be
                yield (*way, key)
                continue
            if key in _SYMMETRIC and len(rest) > 1 and rest[0] != rest[1]:
                pairs.append([rest[1], rest[0], *rest[2:]])
        for pair in pairs:
            yield from _below(place.get(key, {}), (*way, key), pair, path)


def _index(place: list[Any], step: str, path: str) -> int:
    """The place in a list that a step gives, by its number or by a name. Raises UsageError."""
    names = {item["name"]: i for i, item in enumerate(place) if isinstance(item, dict) and "name" in item}
    if step in names:
        return names[step]
    if step.isascii() and step.isdigit() and int(step) < len(place):
        return int(step)
    if names:
        raise UsageError(f"{path}: no {show(step)}{suggestion(step, names)}")
    raise UsageError(f"{path}: {show(step)}, expected {_places(len(place))}")


def _places(count: int) -> str:
    """The places of a list with so many items, in words."""
    return f"a place from 0 to {count - 1}" if count > 1 else "0, the only place" if count else "none, as it is empty"


def _write_out(place: dict[str, Any], key: str, inside: list[str]) -> None:
    """Write the value of a key as a list of numbers; as a list of rows where the path has two places."""
    value = place.get(key)
    if value is None and key in _VECTORS:
        value = [0, 0, 0]
    if isinstance(value, dict) and value.keys() == {"value", "unit"}:
        value = _with_unit(value["value"], value["unit"])
    if not isinstance(value, list):
        return
    if len(inside) > 1 and inside[1].isdigit() and not any(isinstance(entry, dict | list) for entry in value):
        value = [[entry if i == k else 0 for k in range(len(value))] for i, entry in enumerate(value)]
    place[key] = value


def _with_unit(value: Any, unit: str | list[str]) -> Any:
    if isinstance(unit, list):  # of a curve: one of each column
        return [[_with_unit(number, of) for number, of in zip(row, unit, strict=True)] for row in value]
    return [_with_unit(number, unit) for number in value] if isinstance(value, list) else f"{value} {unit}"


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
    form = problems.valid(arrays()["flywheel"], dict(table), where)
    wheel = None if form is None else Flywheel.read(form, partial(problems.add, where), moments_of(table))
    if wheel is None:
        raise StandError(problems.lines)
    (x, _, _), J = wheel.center_of_mass, inertia_about_origin(wheel).tolist()
    unbalance = problems.valid(UnbalanceTable, exact(unbalance_of(wheel) | dict(keys)), f"{where} unbalance")
    if unbalance is None:
        raise StandError(problems.lines)
    _, y, z = datasheet.center_of_mass(wheel.mass, unbalance)
    for i, product in enumerate(datasheet.inertia(J[0][0], (J[1][1], J[2][2]), unbalance)[0]):
        J[0][i] = J[i][0] = product
    return {"center_of_mass": exact([x, y, z]), "inertia": exact(J), "inertia_about": "origin"}


# -- numbers of the tables -------------------------------------------------------------------------------------------


def tables_in(document: Mapping[str, Any]) -> Iterator[tuple[type[Table], Mapping[str, Any], Steps, Way]]:
    """Every table of a valid stand file but its header, with its keys, its name or place, and the way to it."""
    for key, table in (tables() | arrays() | {"hold": hold_table()}).items():
        items = document.get(key, [])
        if isinstance(items, dict):
            yield table, items, (key,), (key,)
        else:
            for i, item in enumerate(items):
                yield table, item, (item["name"],) if "name" in item else (key, str(i)), (key, i)


def dimension_along(hold: Hold | None, table: type[Table], freedom: str | None, key: str) -> Dimension | None:
    """Dimension of a number of friction or a stop, which is that of its freedom; None of other numbers."""
    law = next((law for law in held_laws() if table is law.item.table()), None)
    if law is None or hold is None:
        return None
    return law.item.dimension(key, hold.freedoms[find_freedom(hold, freedom)].kind)


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
    place: Way = ()
    whole: tuple[Any, ...] | None = None
    element: tuple[int, int] | None = None


class StandNumbers:
    """All numbers of one stand file."""

    def __init__(self, stand: Stand, document: Mapping[str, Any], motors: bool = False) -> None:
        """`document`: the keys of the file of `stand`, as `parse_toml` gives them; it is not changed.

        motors  whether motors act in what is computed
        """
        self._stand, self._document, self._idle = stand, document, _IDLE if motors else _IDLE | {"motor"}
        self._found: dict[Steps, StandNumber | str] = {}  # a text says why there is no number
        self._written: set[Steps] = set()  # keys that the file has, which `*` stands for
        for schema, raw, steps, way in tables_in(document):
            self._add_table(schema, raw, steps, way)
        names = {steps[0] for steps in self._found}
        for header in headers():
            keys = {key: value for key, value in document.items() if key in keys_of(header)}
            self._add_table(header, keys, (), (), names)

    def __iter__(self) -> Iterator[StandNumber]:
        """Every number once, those of zeros that the file leaves out too; in the order of the file's tables."""
        once = {number.path: number for number in self._found.values() if isinstance(number, StandNumber)}
        return iter(once.values())

    def find(self, pattern: str) -> list[StandNumber]:
        """The numbers of a path, or of all paths that a pattern with `*` matches, in the order of the file.

        A path that ends at a vector stands for all its elements. Names that match, but that do not have such a number,
        are left out. Raises UsageError.
        """
        steps, names = steps_of(pattern), names_of(self._document, pattern)
        below = {at: entry for at, entry in self._found.items() if at[0] in names}
        matching = {at: entry for at, entry in below.items() if self._matches(steps, at)}
        numbers = {
            entry.path: entry
            for at, entry in matching.items()
            if isinstance(entry, StandNumber) and (len(at) == len(steps) or at[:-1] not in matching)
        }
        if not numbers:
            reasons = (reason for reason in matching.values() if isinstance(reason, str))
            raise UsageError(f"{pattern}: {next(reasons, None) or self._reason((names[0], *steps[1:]))}")
        return list(numbers.values())

    def _matches(self, steps: Steps, at: Steps) -> bool:
        """Does a path lead, after its first name, to the steps of a number, or to the vector that has it?"""
        rest = at[len(steps) :]
        return (
            len(at) >= len(steps)
            and (not rest or (len(rest) == 1 and rest[0].isdigit()))
            and all(
                fnmatchcase(name, step) and (name.isdigit() or at[: k + 1] in self._written)
                if "*" in step
                else name == step
                for k, (name, step) in enumerate(zip(at, steps, strict=False))
                if k
            )
        )

    def _reason(self, steps: Steps) -> str:
        """Why a path, or a pattern after its first name, leads to no number: at the first key that matches."""
        at: Steps = ()
        for step in steps:
            inside = self._inside(at)
            if at and not inside:
                reason = self._found[at]
                return reason if isinstance(reason, str) else f"{path_of(at)} is one number; expected no more after it"
            matching = [name for name in inside if (fnmatchcase(name, step) if "*" in step else name == step)]
            if matching:
                at = (*at, matching[0])
            elif at and inside[0].isdigit():
                return f"{path_of(at)}: expected {_places(len(inside))}, found {step}"
            elif at:
                return f"unknown key {show(step)}{suggestion(step, inside)}"
            else:
                return f"{self._stand.name} has no {show(step)}{suggestion(step, inside)}"
        if any("*" in step for step in steps):
            return f"matches no number of {self._stand.name}"
        inside = self._inside(at)
        if inside[0].isdigit():
            *_, example = (name.path for name, _ in zip(self._numbers_below(at), range(2), strict=False))
            return f"expected an element of the matrix, such as {example}"
        key = "mass" if "mass" in inside else inside[0]
        return f"is a table; expected the path of a number, such as {path_of((*at, key))}"

    def _inside(self, at: Steps) -> list[str]:
        """The next steps of all paths that begin with some."""
        n = len(at)
        return list(dict.fromkeys(steps[n] for steps in self._found if len(steps) > n and steps[:n] == at))

    def _numbers_below(self, at: Steps) -> Iterator[StandNumber]:
        yield from (x for steps, x in self._found.items() if steps[: len(at)] == at and isinstance(x, StandNumber))

    def written_out(self, numbers: Iterable[StandNumber]) -> dict[str, Any]:
        """A copy of the document in which lists that have these numbers stand in SI, element by element."""
        document: dict[str, Any] = deepcopy(dict(self._document))
        for leaf in numbers:
            if leaf.whole is not None:
                value_at(document, leaf.place[:-1])[leaf.place[-1]] = exact(leaf.whole)
        return document

    def with_values(self, values: Mapping[StandNumber, float]) -> dict[str, Any]:
        """A copy of the document with other numbers, SI. Raises UsageError, StandError."""
        document = self.written_out(values)
        put(document, {number.path: value for number, value in values.items()})
        return document

    def mass(self, name: str) -> float:
        """Mass of a body of the file, kg."""
        return float(next(body.mass for body in self._stand.bodies if body.name == name))

    def _add_table(
        self, schema: type[Table], raw: Mapping[str, Any], steps: Steps, way: Way, taken: Iterable[str] = ()
    ) -> None:
        """The numbers of a table, but of keys that are `taken` as names."""
        values: Any = read_table(schema, raw)[0]
        by_sheet = issubclass(schema, FlywheelForm) and any(key in raw for key in _SHEET)
        for entry in declared_keys(schema):
            key, quantity = entry.key, entry.validator
            at, below = (*steps, key), (*way, key)
            if key in taken:
                continue
            if key in raw and steps and key not in self._idle:
                self._written.add(at)
            if key in self._idle:
                self._found[at] = "decides nothing that is computed here; expected a number of a body or a law"
            elif by_sheet and key in _BY_TENSOR:
                self._found[at] = f"the file of {self._stand.name} gives {path_of(at)} by {', '.join(_SHEET)}"
            elif key == "unbalance":
                self._add_table(UnbalanceTable, self._unbalance(steps[0], raw), at, below)
            else:
                value, freedom = getattr(values, entry.name), getattr(values, "freedom", None)
                along = dimension_along(self._stand.hold, schema, freedom, key) if value is not None else None
                if along is not None:
                    quantity, value = scalar(along), number(value, along)
                self._add(quantity, entry.table, value, raw.get(key), at, below)

    def _add(
        self, quantity: QuantityValidator | None, inner: type[Table] | None, value: Any, raw: Any, at: Steps, way: Way
    ) -> None:
        """The numbers of one key; `value`: of the valid table, `raw`: in the file."""
        key, dimension = str(way[-1]), PLAIN if quantity is None else quantity.dimension or PLAIN

        def add(places: tuple[int, ...], x: float, **more: Any) -> None:
            steps = (*at, *map(str, places))
            i, j = (*sorted(places), 0, 0)[:2] if key in _SYMMETRIC else (*places, *places, 0, 0)[:2]
            unit = dimension[i // 3][j // 3] if isinstance(dimension, tuple) else dimension
            more |= {"element": (i, j)} if key in _SYMMETRIC and len(places) == 2 else {}
            self._found[steps] = StandNumber(path_of(steps), at[0], key, unit, x, **more)

        if value is None:
            self._found[at] = f"the file of {self._stand.name} has no {path_of(at)} to vary"
        elif inner is not None and isinstance(value, list | tuple):
            for i, item in enumerate(raw or ()):
                self._add_table(inner, item, (*at, str(i)), (*way, i))
        elif inner is not None:
            self._add_table(inner, raw or {}, at, way)
        elif isinstance(value, float):
            limits = ("least", "above", "most") if quantity is not None else ()
            add((), value, **{name: getattr(quantity, name) for name in limits})
        elif not _is_array(value):
            self._found[at] = f"{path_of(at)} is no number, so it cannot vary"
        else:
            if key == "transverse_inertia" and not isinstance(raw["value"] if isinstance(raw, dict) else raw, list):
                add((), value[0])  # one for both axes
            for i, row in enumerate(value):
                for places, x in [((i,), row)] if isinstance(row, float) else [((i, j), x) for j, x in enumerate(row)]:
                    add(places, x, place=way, whole=value)

    def _unbalance(self, name: str, raw: Mapping[str, Any]) -> Mapping[str, Any]:
        """Unbalance of a flywheel, however its file gives it."""
        if any(key in raw for key in _BY_TENSOR):
            wheel = next(flywheel for flywheel in self._stand.flywheels if flywheel.name == name)
            return {key: exact(value) for key, value in unbalance_of(wheel).items()}
        table: Mapping[str, Any] = raw.get("unbalance", {})
        return table


def _is_array(value: Any) -> bool:
    """Is it a vector or a matrix of numbers?"""
    if not isinstance(value, tuple) or not value:
        return False
    return all(isinstance(x, float) for row in value for x in (row if isinstance(row, tuple) else (row,)))


# -- numbers as they are written, with their units, beside what they are in SI -----------------------------------------

Quantity = tuple[Any, Any, str, str]
"""Dimension, or those of the blocks of a 6x6; value in the file; name of the body or the table, and key in it."""


@dataclass(frozen=True)
class Written:
    """A number, or a list of them, with a unit: `where` is the body's name or the table, `key` the path in it.

    `value` is in `unit`, SI: a number, or a tuple of the numbers of a list.
    """

    where: str
    key: str
    text: str
    value: float | tuple[float, ...]
    unit: str

    @property
    def in_si(self) -> str:
        """The value as text with its unit: "5e-08 kg m", "[0.001, 0, 0] m"."""
        if isinstance(self.value, tuple):
            return f"[{', '.join(f'{x:.6g}' for x in self.value)}] {self.unit}"
        return f"{self.value:.6g} {self.unit}"


def written_numbers(document: Mapping[str, Any]) -> tuple[list[Written], list[str]]:
    """All numbers with units of a valid stand file, in its order, and warnings, a line each.

    A list of which some numbers have units is one item, a matrix an item for each row. In the 6x6 matrices, whose
    numbers differ in dimension, each number with a unit is an item. Warnings are on angles without unit, in rad, beyond
    a whole turn, and on symmetric matrices with elements that differ, of which the mean counts.
    """
    numbers = list(_numbers(document))
    items = (_of_matrix6(*number) if isinstance(number[0], tuple) else _of_value(*number) for number in numbers)
    return list(chain.from_iterable(items)), list(_doubts(numbers))


def _doubts(numbers: list[Quantity]) -> Iterator[str]:
    for dimension, raw, where, key in numbers:
        name = f"{where}.{key}".removeprefix("stand.")
        if dimension == ANGLE:
            yield from beyond_a_turn(name, raw)
        blocks = dimension if isinstance(dimension, tuple) else ((dimension,) * 2,) * 2
        rows = raw["value"] if isinstance(raw, dict) else raw
        if (blocks == ADDED_MASS or dimension == INERTIA) and isinstance(rows, list) and any(map(_is_row, rows)):
            pairs = asymmetries(raw, blocks, SHARE if blocks == ADDED_MASS else 0.0)
            yield from (f"{name}: {above} but {below}: not symmetric, their mean counts" for above, below, _ in pairs)


def _numbers(document: Mapping[str, Any]) -> Iterator[Quantity]:
    """All numbers of a valid stand file, in its order."""
    for header in headers():
        yield from _of_table(document, header, "stand", None)
    raw_hold = {key: value for key, value in document.get("hold", {}).items() if key in keys_of(Hold.table())}
    hold = Hold.read(read_table(Hold.table(), raw_hold)[0], Problems("hold").add) if raw_hold else None
    for table, raw, steps, _ in tables_in(document):
        yield from _of_table(raw, table, path_of(steps), hold)


def _of_table(
    raw: Mapping[str, Any], table: type[Table], where: str, hold: Hold | None, path: str = ""
) -> Iterator[Quantity]:
    known = {key.key: key for key in declared_keys(table)}
    for key, value in raw.items():
        if key not in known:  # of another table, beside the keys of a header
            continue
        quantity, inner = known[key].validator, known[key].table
        along = dimension_along(hold, table, raw.get("freedom"), key)
        if along is not None:
            yield along, value, where, path + key
        elif quantity is not None and quantity.dimension is not None:
            yield quantity.dimension, value, where, path + key
        elif inner is not None and isinstance(value, dict):
            yield from _of_table(value, inner, where, hold, f"{path}{key}.")
        elif inner is not None and where == "hold":
            for k, item in enumerate(value):
                yield from _of_table(item, inner, f"hold.{key}[{k}]", hold)


def _of_matrix6(blocks: Blocks, raw: list[Any], where: str, key: str) -> Iterator[Written]:
    """The numbers with units of a 6x6, or of its diagonal."""
    for i, row in enumerate(raw):
        if isinstance(row, list):
            for j, item in enumerate(row):
                yield from _of_value(blocks[i // 3][j // 3], item, where, f"{key}[{i}][{j}]")
        else:
            yield from _of_value(blocks[i // 3][i // 3], row, where, f"{key}[{i}]")


def _of_value(dimension: Dimension, raw: Any, where: str, key: str) -> Iterator[Written]:
    """A number, a list, or the rows of a matrix, as far as they have units."""
    items = raw["value"] if isinstance(raw, dict) else raw
    text = text_with_unit(raw)
    if text is None:
        return
    if isinstance(items, list) and any(_is_row(item) for item in items):
        for i in range(len(items)):
            yield from _of_value(dimension, list_item(raw, i), where, f"{key}[{i}]")
    elif isinstance(items, list):
        yield Written(where, key, text, vector(raw, (len(items),), dimension), dimension.si)
    else:
        yield Written(where, key, text, number(raw, dimension), dimension.si)


def _is_row(raw: Any) -> bool:
    return isinstance(raw["value"] if isinstance(raw, dict) else raw, list)
