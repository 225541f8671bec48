"""Formulas of the derivation as program expressions: the tree of a formula is the order of its operations."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from mahovik.core.formula.derived import Matrix
from mahovik.core.program.expression import Expr, Negate, real
from mahovik.core.program.vector import Vector

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
