"""The numbers that stands of one structure may differ in: those of `parameters`, then the laws of a table, in order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.lower.layout import Layout
from mahovik.core.lower.member import member
from mahovik.core.lower.values import laws_of, parameters_of
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Stand

_PLACED = ("origin", "axes")
"""Members of a frame that `prepare` computes."""


def law_struct(layout: Layout) -> Struct:
    """The members of a table that `prepare` leaves as they are: laws, and what its frames belong to."""
    kept: list[Field] = []
    frames = layout.table.field("frame")
    if frames is not None:
        assert isinstance(frames.type, Struct)
        inner = tuple(f for f in frames.type.fields if f.name not in _PLACED)
        kept.append(replace(frames, type=Struct(frames.type.name, frames.type.purpose, inner)))
    return Struct(layout.table.name, layout.table.purpose, (*kept, *layout.laws))


def reals(struct: Struct, value: Any) -> Iterator[Any]:
    """Every real of a struct, given as dicts or records, depth first."""
    for f in struct.fields:
        yield from _elements(f.type, member(value, f.name), len(f.shape))


def _elements(type_: Kind | Struct, value: Any, depth: int) -> Iterator[Any]:
    if depth:
        for each in value:
            yield from _elements(type_, each, depth - 1)
    elif isinstance(type_, Struct):
        yield from reals(type_, value)
    elif type_ is Kind.REAL:
        yield value


def columns(struct: Struct, value: Any, varied: Iterator[NDArray[Any] | None], n: int) -> dict[str, Any]:
    """The members of a struct by name, of n samples: arrays with the samples last, lists of structs.

    `value`: that of the first sample; `varied`: in the order of `reals`, the numbers of all samples, or None.
    """
    return {f.name: _columns(f.type, member(value, f.name), len(f.shape), varied, n) for f in struct.fields}


def _columns(type_: Kind | Struct, value: Any, depth: int, varied: Iterator[NDArray[Any] | None], n: int) -> Any:
    if depth:
        found = [_columns(type_, each, depth - 1, varied, n) for each in value]
        return np.stack(found) if found and type_ is Kind.REAL else found
    if isinstance(type_, Struct):
        return columns(type_, value, varied, n)
    if type_ is not Kind.REAL:
        return value
    numbers = next(varied)
    return np.full(n, float(value)) if numbers is None else numbers


def variant(stand: Stand, layout: Layout, program: Interpreter) -> tuple[dict[str, Any], Any, list[Any]]:
    """Parameters of a stand, a table with its laws, and the reals of both: numbers or columns.

    Raises StandError where a number is out of range.
    """
    parameters, table = parameters_of(stand, layout), laws_of(stand, layout, program)
    return parameters, table, [*reals(layout.parameters, parameters), *reals(law_struct(layout), table)]
