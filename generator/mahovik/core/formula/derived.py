"""The modules of derive/, whose functions give formulas here, read from the data file of the package without SymPy.

`wrench.weight(True)` is `mahovik.core.derive.wrench.weight(True)` with its operations in the order of
formula/ordering. Type checkers and editors see the module of derive/ itself: names and arguments are checked, and a
definition is found. `python tools/formulas.py` writes the file.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TypeAlias

FILE = Path(__file__).with_name("derived.json")

MODULES = ("attitude", "carrying", "regressor", "wrench")
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


if TYPE_CHECKING:
    from mahovik.core.derive import attitude, carrying, regressor, wrench
else:
    attitude, carrying, regressor, wrench = (FormulaModule(f"core.derive.{name}") for name in MODULES)

__all__ = [
    "FILE",
    "MODULES",
    "Formula",
    "FormulaModule",
    "Matrix",
    "attitude",
    "carrying",
    "key",
    "regressor",
    "wrench",
]
