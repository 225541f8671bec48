"""The modules of derive/, whose functions give formulas here, read from the data file of the package without SymPy.

`carrying.weight(True)` is `mahovik.core.derive.carrying.weight(True)` with its operations in the order of
tools/formulas.py. Type checkers and editors see the module of derive/ itself: names and arguments are checked, and a
definition is found. `python tools/formulas.py` writes the file.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TypeAlias

from mahovik.core.program.expression import Expr, Negate, real
from mahovik.core.program.vector import Vector

FILE = Path(__file__).with_name("derived.json")

MODULES = ("attitude", "carrying", "regressor")
"""Modules of derive/ that give formulas."""


Formula: TypeAlias = "str | float | list[Any]"
"""A name such as `mu[0]`, a number, or an operation: ["+", a, b], ["-", a, b], ["*", a, b], ["-", a]."""


@dataclass(frozen=True)
class Matrix:
    """Formulas of a matrix, row by row. Indexed as SymPy's: [k], [:3], [i, :], [:3, :]."""

    rows: int
    columns: int
    elements: list[Formula]

    def __len__(self) -> int:
        return len(self.elements)

    def __iter__(self) -> Iterator[Formula]:
        return iter(self.elements)

    def __getitem__(self, index: Any) -> Any:
        if not isinstance(index, tuple):
            return self.elements[index]
        rows = _selection(index[0], self.rows)
        columns = _selection(index[1], self.columns)
        return Matrix(len(rows), len(columns), [self.elements[self.columns * i + j] for i in rows for j in columns])


def _selection(index: int | slice, count: int) -> range:
    return range(count)[index] if isinstance(index, slice) else range(count)[index : index + 1]


def key(module: str, function: str, *arguments: object) -> str:
    """The name of a formula in the file: the call that derives it."""
    return f"{module}.{function}({', '.join(map(str, arguments))})"


class FormulaModule:
    """A module of derive/: its functions give formulas and records of them."""

    def __init__(self, module: str) -> None:
        self._module = module

    def __getattr__(self, name: str) -> Callable[..., Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        return lambda *arguments: _formulas()[key(self._module, name, *arguments)]


@cache
def _formulas() -> dict[str, Any]:
    """All formulas by key."""
    formulas: dict[str, Any] = json.loads(FILE.read_bytes(), object_hook=_value)
    return formulas


def _value(members: dict[str, Any]) -> Any:
    """A matrix, a record or a dict of formulas."""
    if "elements" in members:
        return Matrix(**members)
    return SimpleNamespace(**members["record"]) if "record" in members else members


# -- as expressions of a program ---------------------------------------------------------------------------------------

Binding = Mapping[str, Any]
"""Meaning of a name in a formula: a scalar expression, or something that is indexed (a place, a list)."""

_INDEXED = re.compile(r"(\w+)\[(\d+)\]")


def translate(formula: Any, binding: Binding) -> Expr:
    """`formula` as a program expression. Raises KeyError for a name that `binding` lacks."""
    match formula:
        case str():
            return _place(formula, binding)
        case float():
            return real(formula)
        case ("-", one):
            return Negate(translate(one, binding))
        case ("+", left, right):
            return translate(left, binding) + translate(right, binding)
        case ("-", left, right):
            return translate(left, binding) - translate(right, binding)
        case ("*", left, right):
            return translate(left, binding) * translate(right, binding)
    raise TypeError(f"{formula} is no formula")


def _place(name: str, binding: Binding) -> Expr:
    indexed = _INDEXED.fullmatch(name)
    operand = binding[name] if indexed is None else binding[indexed[1]][int(indexed[2])]
    assert isinstance(operand, Expr)
    return operand


def formula(values: Any, **binding: Any) -> Any:
    """A formula, or those of a vector or matrix (row by row), as expressions."""
    if not isinstance(values, Matrix):
        return translate(values, binding)
    return Vector(translate(value, binding) for value in values)


if TYPE_CHECKING:
    from mahovik.core.derive import attitude, carrying, regressor
else:
    attitude, carrying, regressor = (FormulaModule(f"core.derive.{name}") for name in MODULES)

__all__ = [
    "FILE",
    "MODULES",
    "Formula",
    "FormulaModule",
    "Matrix",
    "attitude",
    "carrying",
    "formula",
    "key",
    "regressor",
]
