"""Problems of a stand file in words: file, key path, what was found, what was expected. One line each."""

from __future__ import annotations

import re
import types
import typing
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel, ValidationError

from mahovik.core.stand.units import show
from mahovik.nearest import suggestion

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

    def add_schema_errors(self, where: str, table: type[BaseModel], error: ValidationError) -> None:
        """Note everything pydantic found in the table that `where` names."""
        for item in error.errors(include_url=False):
            location, kind = item["loc"], item["type"]
            if kind == "extra_forbidden":
                known = keys_of(_table_at(table, location[:-1]))
                path, reason = (
                    location[:-1],
                    f"unknown key {show(location[-1])}{_instead(str(location[-1]), known)}",
                )
            elif kind == "missing":
                path, reason = location, "required, but missing"
            elif kind in ("model_type", "model_attributes_type"):
                path, reason = location, f"expected a table, found {show(item['input'])}"
            elif kind == "list_type":
                path, reason = location, f"expected a list, found {show(item['input'])}"
            else:
                path, reason = location, item["msg"]
            key = item.get("ctx", {}).get("key", "")  # what a check of the whole table found in one of its keys
            self.add(where, *_words(path), key, reason)


OF_FLYWHEELS = {
    "shape": "a flywheel has numbers in the place of a shape, spin_inertia and transverse_inertia; "
    "for a thin disc transverse_inertia = spin_inertia/2",
    "added_mass": "that of a flywheel would turn with it; give it to the carrier or an instrument",
}
"""Keys that flywheels do not have, and what there is instead."""


def _instead(key: str, known: list[str]) -> str:
    """What to write instead of an unknown key."""
    if key in OF_FLYWHEELS and "transverse_inertia" in known:
        return f": {OF_FLYWHEELS[key]}"
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


def keys_of(table: type[BaseModel]) -> list[str]:
    """The keys that a table may have."""
    return [info.alias or name for name, info in table.model_fields.items()]


def _table_at(table: type[BaseModel], location: tuple[int | str, ...]) -> type[BaseModel]:
    """The table model that a location inside `table` leads to."""
    for step in location:
        if isinstance(step, str) and step in table.model_fields:  # others are keys of a table of tables
            table = _model_in(table.model_fields[step].annotation) or table
    return table


def _model_in(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and not isinstance(annotation, types.GenericAlias):
        return annotation if issubclass(annotation, BaseModel) else None
    for argument in typing.get_args(annotation):
        found = _model_in(argument)
        if found is not None:
            return found
    return None
