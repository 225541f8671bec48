"""Problems of a stand file in words: file, key path, what was found, what was expected. One line each."""

from __future__ import annotations

import re
import types
import typing
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any, TypeVar

from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic.fields import FieldInfo

from mahovik.core.stand.units import show
from mahovik.nearest import suggestion

T = TypeVar("T")
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
        """The table that `raw` holds; None if it has problems, which are noted. Some fields use the `context`."""
        try:
            return TypeAdapter(table).validate_python(raw, context=context)
        except ValidationError as error:
            self.add_schema_errors(where, table, error)
            return None

    def add_schema_errors(self, where: str, table: type, error: ValidationError) -> None:
        """Note everything pydantic found in the table that `where` names."""
        for item in error.errors(include_url=False):
            location, kind = item["loc"], item["type"]
            if kind in ("extra_forbidden", "unexpected_keyword_argument"):
                known = keys_of(_table_at(table, location[:-1]))
                path, reason = (
                    location[:-1],
                    f"unknown key {show(location[-1])}{_instead(str(location[-1]), known)}",
                )
            elif kind == "missing":
                path, reason = location, "required, but missing"
            elif kind in ("model_type", "model_attributes_type", "dict_type"):
                path, reason = location, f"expected a table, found {show(item['input'])}"
            elif kind == "dataclass_type":
                keys = ", ".join(keys_of(_table_at(table, location)))
                path, reason = location, f"expected a table with {keys}, found {show(item['input'])}"
            elif kind == "list_type":
                path, reason = location, f"expected a list, found {show(item['input'])}"
            else:
                path, reason = location, item["msg"]
            key = item.get("ctx", {}).get("key", "")  # what a check of the whole table found in one of its keys
            self.add(where, *_words(path), key, reason)


_GRADE = "static unbalance is mass times G over speed: G 2.5 at 3000 rpm of 2 kg is static = 2 * 2.5e-3 / 314.16 kg m"
_WORKING = "a catalogue's working moment is twice the static one: unbalance = { static = half of it }"

INSTEAD = {
    "transverse_inertia": {
        "shape": "a flywheel has numbers in the place of a shape, spin_inertia and transverse_inertia; "
        "for a thin disc transverse_inertia = spin_inertia/2",
        "added_mass": "that of a flywheel would turn with it; give it to the carrier or an instrument",
        "momentum": "it is spin_inertia times speed: 0.4 N m s at 6000 rpm is spin_inertia = 0.4 / 628.32 kg m^2",
        "grade": f"{_GRADE}, in unbalance = {{ static = ... }}",
        "working_moment": _WORKING,
        "static_moment": "unbalance = { static = ... } has it",
        "static_unbalance": "unbalance = { static = ... } has it",
        "dynamic_unbalance": "unbalance = { dynamic = ... } has it",
    },
    "static_at": {"grade": _GRADE, "working_moment": _WORKING},
    "harmonics": {"frequency": "a motion has `period` = 1 / frequency, in seconds"},
}
"""Unknown keys that people write, by a key that the table does have, and what to write instead."""


def _instead(key: str, known: list[str]) -> str:
    """What to write instead of an unknown key."""
    for present, answers in INSTEAD.items():
        if present in known and key in answers:
            return f": {answers[key]}"
    return suggestion(key, known)


def _words(location: tuple[int | str, ...]) -> list[str]:
    """`("damping", "terms", 0, "value")` as `["damping", "terms[0]", "value"]`."""
    words: list[str] = []
    for step in location:
        if isinstance(step, int) and words:
            words[-1] += f"[{step}]"
        else:
            words.append(str(step))
    return words


def keys_of(table: Any) -> list[str]:
    """The keys that a table may have."""
    return [key for key, _, _ in _fields_of(table)]


def _fields_of(table: Any) -> list[tuple[str, str, Any]]:
    """Key, name and type of each field of a table, a model or a dataclass."""
    if issubclass(table, BaseModel):
        return [(info.alias or name, name, info.annotation) for name, info in table.model_fields.items()]
    hints = typing.get_type_hints(table, include_extras=True)
    marks = {name: getattr(hint, "__metadata__", ()) for name, hint in hints.items()}
    aliases = {name: mark.alias for name in hints for mark in marks[name] if isinstance(mark, FieldInfo) and mark.alias}
    return [(aliases.get(f.name, f.name), f.name, hints[f.name]) for f in fields(table)]


def _table_at(table: type, location: tuple[int | str, ...]) -> type:
    """The table that a location inside `table` leads to."""
    for step in location:
        kinds: dict[Any, Any] = {key: kind for key, _, kind in _fields_of(table)}
        table = _table_in(kinds.get(step)) or table  # others are keys of a table of tables, or places in a list
    return table


def _table_in(annotation: Any) -> type | None:
    if isinstance(annotation, type) and not isinstance(annotation, types.GenericAlias):
        return annotation if issubclass(annotation, BaseModel) or is_dataclass(annotation) else None
    for argument in typing.get_args(annotation):
        table = _table_in(argument)
        if table is not None:
            return table
    return None
