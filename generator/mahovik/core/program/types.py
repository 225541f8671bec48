"""Types of a program: scalar kinds, structs, and the element type (float or double)."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from mahovik.contract.quantities import BOUNDS


class Kind(Enum):
    """Scalar kinds. REAL is the program's element type; WORD the unsigned integer of the same width."""

    REAL = "real"
    INT = "int"
    WORD = "word"
    BOOL = "bool"
    STATUS = "status"


@dataclass(frozen=True)
class Precision:
    """An element type: C name, IEEE width, significand (with the hidden bit), exponent bias, NumPy scalar."""

    name: str
    width: int
    significand: int
    bias: int
    scalar: Any
    word: Any
    max_phase: float  # largest accepted flywheel phase, rad (stand.md)

    @property
    def epsilon(self) -> float:
        """Distance from 1 to the next larger number."""
        return float(2.0 ** (1 - self.significand))

    @property
    def largest(self) -> float:
        """Largest finite number."""
        return float(np.finfo(self.scalar).max)

    @property
    def smallest(self) -> float:
        """Smallest positive number with all its digits; its reciprocal is finite."""
        return float(np.finfo(self.scalar).smallest_normal)


DOUBLE = Precision("double", 64, 53, 1023, np.float64, np.uint64, BOUNDS["MAX_PHASE"].at("double"))
FLOAT = Precision("float", 32, 24, 127, np.float32, np.uint32, BOUNDS["MAX_PHASE"].at("float"))


@dataclass(frozen=True)
class Field:
    """A member of a struct. `shape` () is a scalar; `unit` and `frame` are for the reader."""

    name: str
    type: Kind | Struct
    shape: tuple[int | NamedCount, ...] = ()
    unit: str = ""
    comment: str = ""


@dataclass(frozen=True)
class NamedCount:
    """A constant with a name in the emitted code, such as the number of flywheels."""

    name: str
    value: int
    comment: str = ""

    def __int__(self) -> int:
        return self.value


@dataclass(frozen=True)
class Struct:
    """A record type. `name` has no prefix: the printer puts the stand's name before it."""

    name: str
    purpose: str
    fields: tuple[Field, ...]

    def field(self, name: str) -> Field | None:
        """The member of that name, or None."""
        return next((f for f in self.fields if f.name == name), None)
