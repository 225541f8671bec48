"""Types of a program: scalar kinds, structs, and the element type (float or double)."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from enum import Enum
from math import prod
from typing import Any, TypeAlias

import numpy as np

from mahovik.contract.quantities import BOUNDS


class ProgramError(TypeError):
    """What no program has: kinds, lengths or numbers that do not fit. The compiler of kernels adds file and line."""


class Kind(Enum):
    """Scalar kinds. REAL is the program's element type; WORD the unsigned integer of the same width."""

    REAL = "real"
    INT = "int"
    WORD = "word"
    BOOL = "bool"
    STATUS = "status"


class NamedNumber(float):
    """A real constant with a name in the emitted code; what is computed with it is a number without a name."""

    def __new__(cls, value: float, name: str, comment: str) -> NamedNumber:
        made = super().__new__(cls, value)
        made.name, made.comment = name, comment
        return made

    name: str
    comment: str

    def __reduce__(self) -> tuple[Any, ...]:
        return NamedNumber, (float(self), self.name, self.comment)


@dataclass(frozen=True)
class Precision:
    """An element type: C name, IEEE width, significand (with the hidden bit), exponent bias, NumPy scalar."""

    name: str
    width: int
    significand: int
    bias: int
    scalar: Any
    word: Any
    max_phase: float  # largest accepted flywheel phase, rad (docs/c-interface.md, Ranges)

    @property
    def epsilon(self) -> float:
        """Distance from 1 to the next larger number."""
        return float(2.0 ** (1 - self.significand))

    @property
    def largest(self) -> NamedNumber:
        """Largest finite number."""
        return NamedNumber(float(np.finfo(self.scalar).max), "LARGEST", "largest finite number")

    @property
    def smallest(self) -> NamedNumber:
        """Smallest positive number with all its digits; its reciprocal is finite."""
        return NamedNumber(float(np.finfo(self.scalar).smallest_normal), "SMALLEST", "smallest number with all digits")


DOUBLE = Precision("double", 64, 53, 1023, np.float64, np.uint64, BOUNDS["MAX_PHASE"].at("double"))
FLOAT = Precision("float", 32, 24, 127, np.float32, np.uint32, BOUNDS["MAX_PHASE"].at("float"))


@dataclass(frozen=True)
class Field:
    """A member of a struct. `shape` () is a scalar; `unit` and `frame` are for the reader.

    of_hold  it follows from the hold, with others: nobody changes it alone
    """

    name: str
    type: Kind | Struct
    shape: Shape = ()
    unit: str = ""
    comment: str = ""
    of_hold: bool = False


@dataclass(frozen=True)
class NamedCount:
    """A constant with a name in the emitted code, such as the number of flywheels."""

    name: str
    value: int
    comment: str = ""

    def __int__(self) -> int:
        return self.value

    __index__ = __int__  # of `range`, in the text of kernels


Shape: TypeAlias = tuple[int | NamedCount, ...]
"""Lengths of an array, the outermost first; () is a scalar."""


@dataclass(frozen=True)
class Struct:
    """A record type. `name` has no prefix: the printer puts the stand's name before it."""

    name: str
    purpose: str
    fields: tuple[Field, ...]

    def field(self, name: str) -> Field | None:
        """The member of that name, or None."""
        return next((f for f in self.fields if f.name == name), None)

    def inner_structs(self) -> Iterator[Struct]:
        """The structs that it holds, directly or not, each after those that it holds itself; it comes last."""
        structs: dict[str, Struct] = {}
        for f in self.fields:
            if isinstance(f.type, Struct):
                structs |= {struct.name: struct for struct in f.type.inner_structs() if struct.name not in structs}
        yield from structs.values()
        yield self


def leaves(type_: Kind | Struct, shape: Shape, value: Any) -> Iterator[tuple[Kind, Any]]:
    """Kind and number of every scalar of a value, dicts or records (structs), lists (arrays), numbers; C's order."""
    if shape:
        for element in value:
            yield from leaves(type_, shape[1:], element)
    elif isinstance(type_, Struct):
        for f in type_.fields:
            yield from leaves(f.type, f.shape, member(value, f.name))
    else:
        yield type_, value


def numbers(type_: Kind | Struct, shape: Shape = (), kinds: Collection[Kind] = tuple(Kind)) -> int:
    """How many scalars of these kinds a value has."""
    of = (numbers(f.type, f.shape, kinds) for f in type_.fields) if isinstance(type_, Struct) else [type_ in kinds]
    return sum(of) * prod(map(int, shape))


def member(value: Any, name: str) -> Any:
    """A member of a struct, given as a mapping or as an object."""
    return value[name] if isinstance(value, Mapping) else getattr(value, name)
