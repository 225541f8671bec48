"""Tables of files as classes: an annotated attribute is a key, and its annotation says how the key is read.

    class Place(Table):
        at: Annotated[float, scalar(LENGTH)]       by the validator that is in the annotation
        of: Body | None = None                     a table inside, of a class of tables
        more: Sequence[Body] = ()                  a list of tables; Mapping[str, ...] likewise
        anything: Any = None                       as it stands in the file

A dataclass that is `Data` is read likewise. All values are then what the program works with, in SI.
"""

from __future__ import annotations

import inspect
import re
import types
import typing
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from typing import Any, ClassVar, TypeVar

from mahovik.core.stand.units import Dimension, QuantityError, show
from mahovik.nearest import nearest_name, suggestion

T = TypeVar("T")
Blocks = tuple[tuple[Dimension, Dimension], tuple[Dimension, Dimension]]
"""Dimensions of a 6x6 by its four 3x3 blocks: (force, moment) rows by (linear, angular) columns."""

Context = Mapping[str, Any]
"""What some keys need to be read, such as the number of flywheels."""

NOTHING: Mapping[str, Any] = types.MappingProxyType({})


ALIKE = 0.8
"""Minimum similarity (0 to 1) of an unknown key to one that has an answer."""


class TableError(QuantityError):
    """Keys of a table do not go together; `key`: the one that is to be mended."""

    def __init__(self, words: str, key: str = "") -> None:
        super().__init__(words)
        self.key = key


class Data:
    """Base of dataclasses that are tables of a file as well."""


class Table:
    """Base of all tables. `present`: keys that the file has.

    instead  unknown keys that people write, or are like these, and what to write in their place
    """

    instead: ClassVar[Mapping[str, str]] = NOTHING

    def __init__(self, **values: Any) -> None:
        defaults = {key.name: key.default for key in declared_keys(type(self)) if key.default is not MISSING}
        vars(self).update(defaults | values)
        self.present = values.keys()
        self.check()

    def check(self) -> None:
        """Raises TableError where keys do not go together."""


# -- what is said of a key -------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class QuantityValidator:
    """How a key is read, by a function of what the file has and the context, which raises QuantityError.

    dimension  of its numbers, of a 6x6 by blocks; None where it reads none
    least      smallest accepted number, above: one that is too small, most: the largest; SI, None: no bound
    write      value of the file for one of the data, where it is another
    words      texts that it accepts, each with what it means; empty where it reads none
    shape      what it reads, in words, where its type does not say so
    """

    read: Callable[[Any, Context], Any]
    dimension: Dimension | Blocks | None = None
    least: float | None = None
    above: float | None = None
    most: float | None = None
    write: Callable[[Any], Any] | None = None
    words: tuple[tuple[str, Any], ...] = ()
    shape: str = ""


@dataclass(frozen=True)
class Default:
    """The value of a key that the file leaves out; `written`: does a file that is written have it even so?"""

    value: Any
    written: bool = True


@dataclass(frozen=True)
class Alias:
    """The key where it is not the name of the attribute."""

    key: str


@dataclass(frozen=True)
class Key:
    """A key of a table: `name` is that of its attribute, `default` MISSING where the file must have it.

    validator  in its annotation; table: the class of tables in it; None where there is none
    """

    key: str
    name: str
    annotation: Any
    default: Any
    validator: QuantityValidator | None
    table: type | None


_KEYS: dict[type, tuple[Key, ...]] = {}


def declared_keys(table: type) -> tuple[Key, ...]:
    """The keys that a table may have."""
    if table not in _KEYS:
        _KEYS[table] = tuple(_keys(table))
    return _KEYS[table]


def annotations_of(table: type) -> dict[str, Any]:
    """Annotations of a class and its bases, in a third of the time of typing.get_type_hints."""
    bases = [inspect.get_annotations(base, eval_str=True) for base in reversed(table.__mro__)]
    return {name: hint for hints in bases for name, hint in hints.items()}


def _keys(table: type) -> Iterator[Key]:
    hints = annotations_of(table)
    data = {f.name: f.default for f in fields(table)} if is_dataclass(table) else None
    for name in hints if data is None else data:
        marks = {type(mark): mark for mark in getattr(hints[name], "__metadata__", ())}
        default = getattr(table, name, MISSING) if data is None else data[name]
        if Default in marks and default is MISSING:
            default = marks[Default].value
        if typing.get_origin(hints[name]) is not ClassVar:
            key = marks[Alias].key if Alias in marks else name
            yield Key(key, name, hints[name], default, *_inside(hints[name]))


def keys_of(table: type) -> list[str]:
    """The keys that a table may have, as the file has them."""
    return [key.key for key in declared_keys(table)]


def make_table(data: type, base: type[Table], hints: Mapping[str, tuple[Any, Any]]) -> type[Table]:
    """The tables of a class of data, with these keys more: annotation, and default; MISSING: it must be there."""
    defaults = {key: default for key, (_, default) in hints.items() if default is not MISSING}
    annotations = {key: hint for key, (hint, _) in hints.items()}
    members: dict[str, Any] = {"__doc__": data.__doc__, "__module__": data.__module__, "__annotations__": annotations}
    members["instead"] = getattr(data, "instead", base.instead)
    return type(f"{data.__name__}Table", (base,), members | defaults)


def _is_table(hint: Any) -> bool:
    return isinstance(hint, type) and issubclass(hint, Table | Data)


def _inside(hint: Any) -> tuple[QuantityValidator | None, type | None]:
    """The validator, or the class of tables, in an annotation."""
    if _is_table(hint):
        return None, hint
    for mark in getattr(hint, "__metadata__", ()):
        if isinstance(mark, QuantityValidator):
            return mark, None
    parts = map(_inside, typing.get_args(hint))
    return next((part for part in parts if part != (None, None)), (None, None))


# -- reading ---------------------------------------------------------------------------------------------------------

Way = tuple[int | str, ...]
"""Keys, and places in lists, from a table to a value in it."""

Problem = tuple[Way, str, str]
"""Way to a table or a value, key of the table where it is known, reason."""


def read_table(table: type[T], raw: Any, context: Context = NOTHING) -> tuple[T | None, list[Problem]]:
    """The table that `raw` holds, and all problems; None where there are some."""
    problems: list[Problem] = []
    return _table(table, raw, context, (), problems), problems


def _table(table: type[T], raw: Any, context: Context, way: Way, problems: list[Problem]) -> T | None:
    if not isinstance(raw, dict):
        with_keys = f" with {', '.join(keys_of(table))}" if issubclass(table, Data) else ""
        problems.append((way, "", f"expected a table{with_keys}, found {show(raw)}"))
        return None
    before, values = len(problems), {}
    for key in declared_keys(table):
        if key.key in raw:
            at = (*way, key.key)
            values[key.name] = _value(key.annotation, raw[key.key], context, at, problems)
        elif key.default is MISSING:
            problems.append(((*way, key.key), "", "required, but missing"))
        elif issubclass(table, Data):
            values[key.name] = key.default
    known, instead = keys_of(table), dict(getattr(table, "instead", {}))
    for unknown in (key for key in raw if key not in known):
        meant = nearest_name(unknown, instead, ALIKE)
        answer = suggestion(str(unknown), known) if meant is None else f": {instead[meant]}"
        problems.append((way, "", f"unknown key {show(unknown)}{answer}"))
    if len(problems) > before:
        return None
    try:
        return table(**values)
    except TableError as error:
        problems.append((way, error.key, str(error)))
        return None


def _value(hint: Any, raw: Any, context: Context, way: Way, problems: list[Problem]) -> Any:
    """A value by its annotation; problems are noted."""
    if _is_table(hint):
        return _table(hint, raw, context, way, problems)
    for mark in getattr(hint, "__metadata__", ()):
        if isinstance(mark, QuantityValidator):
            try:
                return mark.read(raw, context)
            except QuantityError as error:
                problems.append((way, "", str(error)))
                return None
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if hint is Any:
        return raw
    if type(None) in parts or origin is typing.Annotated:
        return _value(parts[0], raw, context, way, problems)
    if origin in (list, Sequence) and isinstance(raw, list | tuple):
        return [_value(parts[0], item, context, (*way, i), problems) for i, item in enumerate(raw)]
    if origin in (dict, Mapping) and isinstance(raw, dict):
        return {key: _value(parts[1], item, context, (*way, key), problems) for key, item in raw.items()}
    problems.append((way, "", f"expected a {'table' if origin in (dict, Mapping) else 'list'}, found {show(raw)}"))
    return None


# -- problems of a file in words: file, key path, what was found, what was expected; a line each -----------------------

_ELEMENT = re.compile(r"((?:\[\d+\])+): (.*)", re.DOTALL)  # what `shapes` says of one element


@dataclass
class Problems:
    """Collects the problems of one file, so that all are reported together."""

    source: str
    lines: list[str] = field(default_factory=list)

    def add(self, *words: str) -> None:
        """Note a problem; `words` are the parts of the key path, the last the reason."""
        *path, reason = (word for word in words if word)
        element = _ELEMENT.fullmatch(reason)
        if element is not None and path:
            path[-1], reason = path[-1] + element[1], element[2]
        line = f"{self.source}: " + (f"{', '.join(path)}: {reason}" if path else reason)
        if line not in self.lines:
            self.lines.append(line)

    def valid(self, table: type[T], raw: Any, where: str = "", **context: Any) -> T | None:
        """The table that `raw` holds; None if it has problems, which are noted. Some keys use the `context`."""
        result, problems = read_table(table, raw, context)
        self.add_all(where, problems)
        return result

    def add_all(self, where: str, problems: list[Problem]) -> None:
        """Note the problems of a table that `where` names."""
        for way, key, reason in problems:
            self.add(where, *_words(way), key, reason)


def _words(way: Way) -> list[str]:
    """`("damping", "terms", 0, "value")` as `["damping", "terms[0]", "value"]`."""
    words: list[str] = []
    for step in way:
        if isinstance(step, int) and words:
            words[-1] += f"[{step}]"
        else:
            words.append(str(step))
    return words
