"""Functions for arrays of states as plain data: what each takes and gives, and how it lies in memory.

Three orders of memory: `components`, component i of state j at [i * n + j]; `states`, the record of state j at [j];
`alike`, one record for all states.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from mahovik.core.program.types import Kind, NamedCount, Struct

Order = Literal["components", "states", "alike"]


@dataclass(frozen=True)
class Member:
    """A member of a record: of reals, of ints, or of records (`members`). `axes`: what each axis counts, or ""."""

    name: str
    kind: str
    shape: tuple[int, ...] = ()
    axes: tuple[str, ...] = ()
    unit: str = ""
    meaning: str = ""
    members: tuple[Member, ...] = ()

    @classmethod
    def of_json(cls, raw: Mapping[str, Any]) -> Member:
        """The member of its fields as JSON has them."""
        lists = {"shape": tuple(raw["shape"]), "axes": tuple(raw["axes"])}
        return cls(**{**raw, **lists, "members": tuple(map(cls.of_json, raw["members"]))})

    @property
    def size(self) -> int:
        """Numbers in it, or records."""
        return math.prod(self.shape)

    @property
    def numbers(self) -> int:
        """Numbers in it, those of inner records included."""
        return self.size * (sum(inner.numbers for inner in self.members) if self.members else 1)


@dataclass(frozen=True)
class ArgumentLayout:
    """An argument: its direction, the order of its memory, and the members of its record."""

    name: str
    direction: str
    order: Order
    members: tuple[Member, ...]

    @cached_property
    def components(self) -> int:
        """Numbers of one state."""
        return sum(member.numbers for member in self.members)


@dataclass(frozen=True)
class ArrayFunction:
    """A function of n states. `wide`: states side by side in the registers of the processor, else one by one."""

    name: str
    purpose: str
    wide: bool
    arguments: tuple[ArgumentLayout, ...]

    @classmethod
    def of_json(cls, raw: Mapping[str, Any]) -> ArrayFunction:
        """The function of its fields as JSON has them."""
        arguments = ({**a, "members": tuple(map(Member.of_json, a["members"]))} for a in raw["arguments"])
        return cls(**{**raw, "arguments": tuple(ArgumentLayout(**a) for a in arguments)})


def members(struct: Struct) -> tuple[Member, ...]:
    """The members of a struct."""
    return tuple(member(f.name, f.type, f.shape, f.unit, f.comment) for f in struct.fields)


def member(
    name: str, type_: Kind | Struct, shape: Sequence[int | NamedCount], unit: str = "", meaning: str = ""
) -> Member:
    """One member of a record."""
    sizes = tuple(int(count) for count in shape)
    axes = tuple(count.name if isinstance(count, NamedCount) else "" for count in shape)
    if isinstance(type_, Struct):
        return Member(name, "record", sizes, axes, unit, meaning, members(type_))
    return Member(name, "int" if type_ is Kind.INT else "real", sizes, axes, unit, meaning)


def record(of: Sequence[Member], real: np.dtype[Any]) -> np.dtype[Any]:
    """A record as NumPy lays it out, which is how C does."""
    types: list[tuple[str, Any, tuple[int, ...]]] = []
    for member in of:
        inner = {"real": real, "int": np.dtype(np.int32)}.get(member.kind)
        types.append((member.name, record(member.members, real) if inner is None else inner, member.shape))
    return np.dtype(types, align=True)


def fill_record(of: Sequence[Member], real: np.dtype[Any], value: Mapping[str, Any]) -> NDArray[Any]:
    """One record in an array of one, from dicts (records), lists (arrays) and numbers."""
    result = np.zeros(1, dtype=record(of, real))
    _fill(of, result[0], value)
    return result


def _fill(of: Sequence[Member], place: Any, value: Mapping[str, Any]) -> None:
    for member in of:
        if member.kind != "record":
            place[member.name] = value[member.name]
        elif member.shape:
            for i, inner in enumerate(value[member.name]):
                _fill(member.members, place[member.name][i], inner)
        else:
            _fill(member.members, place[member.name], value[member.name])
