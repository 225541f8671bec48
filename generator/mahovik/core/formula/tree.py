"""Formulas as data: names, numbers and operations in the order in which they are done; matrices of them; as JSON."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any, TypeAlias

Formula: TypeAlias = "str | float | tuple[Any, ...]"
"""A name such as `mu[0]`, a number, or an operation: ("+", a, b), ("-", a, b), ("*", a, b), ("-", a)."""

_NAME = re.compile(r"[a-zA-Z_]\w*(\[\d+\])?")
_OPERANDS = {"+": (2,), "-": (1, 2), "*": (2,)}


@dataclass(frozen=True)
class Matrix:
    """Formulas of a matrix, row by row. Indexed as SymPy's: [k], [:3], [i, :], [:3, :]."""

    rows: int
    columns: int
    elements: tuple[Formula, ...]

    def __len__(self) -> int:
        return len(self.elements)

    def __iter__(self) -> Iterator[Formula]:
        return iter(self.elements)

    def __getitem__(self, index: Any) -> Any:
        if not isinstance(index, tuple):
            return self.elements[index]
        rows = _selection(index[0], self.rows)
        columns = _selection(index[1], self.columns)
        return Matrix(
            len(rows), len(columns), tuple(self.elements[self.columns * i + j] for i in rows for j in columns)
        )


def _selection(index: int | slice, count: int) -> range:
    return range(count)[index] if isinstance(index, slice) else range(count)[index : index + 1]


def rename_symbols(formula: Formula, names: Mapping[str, str]) -> Formula:
    """A copy of the formula with its symbols renamed."""
    if isinstance(formula, str):
        return names.get(formula, formula)
    if isinstance(formula, tuple):
        return (formula[0], *(rename_symbols(part, names) for part in formula[1:]))
    return formula


def names_of(formula: Formula) -> set[str]:
    """The names in a formula."""
    if isinstance(formula, str):
        return {formula}
    return set().union(*(names_of(part) for part in formula[1:])) if isinstance(formula, tuple) else set()


def omitting(formula: Formula, name: str) -> Formula:
    """The formula where that name is zero: its products are left out. 0.0 where nothing is left."""
    if not isinstance(formula, tuple):
        return 0.0 if formula == name else formula
    operator, *parts = formula
    if len(parts) == 1:
        one = omitting(parts[0], name)
        return 0.0 if one == 0.0 else (operator, one)
    left, right = omitting(parts[0], name), omitting(parts[1], name)
    if operator == "*":
        return 0.0 if 0.0 in (left, right) else (operator, left, right)
    if right == 0.0:
        return left
    if left == 0.0:
        return right if operator == "+" else ("-", right)
    return (operator, left, right)


def as_json(value: Any) -> Any:
    """Formulas, matrices, tuples, dicts and records of them, as JSON has them."""
    match value:
        case str() | float():
            return value
        case Matrix(rows, columns, elements):
            return {"matrix": [rows, columns], "elements": [as_json(each) for each in elements]}
        case dict():
            return {"dict": {name: as_json(each) for name, each in value.items()}}
        case SimpleNamespace():
            return {"record": {name: as_json(each) for name, each in vars(value).items()}}
        case (str(operator), *parts) if operator in _OPERANDS:
            return [operator, *(as_json(part) for part in parts)]
        case tuple():
            return {"tuple": [as_json(each) for each in value]}
    raise TypeError(f"{value!r} is no formula")


def from_json(value: Any) -> Any:
    """What `as_json` has written. Raises ValueError, KeyError or TypeError for anything else."""
    match value:
        case str() if _NAME.fullmatch(value):
            return value
        case float():
            return value
        case [str(operator), *parts] if len(parts) in _OPERANDS.get(operator, ()):
            return (operator, *(_operand(part) for part in parts))
        case {"matrix": [int(rows), int(columns)], "elements": list(elements)} if len(elements) == rows * columns:
            return Matrix(rows, columns, tuple(_operand(each) for each in elements))
        case {"dict": dict(members)}:
            return {name: from_json(each) for name, each in members.items()}
        case {"record": dict(members)}:
            return SimpleNamespace(**{name: from_json(each) for name, each in members.items()})
        case {"tuple": list(members)}:
            return tuple(from_json(each) for each in members)
    raise ValueError(f"{value!r} is no formula")


def _operand(value: Any) -> Any:
    """A part of a formula: no matrix or record."""
    if isinstance(value, dict):
        raise ValueError(f"{value!r} is no formula")
    return from_json(value)
