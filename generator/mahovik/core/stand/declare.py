"""Tables of the stand file as the classes of their data declare them.

Each field of such a class is annotated with all that is known of it, beside the type and the validator that reads it
from the stand file. `Annotated[float, scalar(STIFFNESS, least=0.0), Default(0.0), InC(), uniform(50.0, 500.0), TIMES]`
is a key of the file that may be missing, a member of the struct in C, a number that random stands draw, and one that is
measured with an error. The table of the file, its text, its numbers, the struct, draws and errors are made of these.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import MISSING, dataclass, fields, replace
from functools import cache
from typing import Annotated, Any, ClassVar, Protocol, Self, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.fields import ZERO6, Mat6, Vec3
from mahovik.core.stand.tables import Default, QuantityValidator, Table, annotations_of, declared_keys, make_table

Array = NDArray[np.float64]

_LENGTH = 0.3  # m, makes 6x6 matrices of the right units out of numbers of one size


class Draw:
    """Pieces of a stand, drawn from one generator in a fixed order."""

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng

    def flag(self, fixed: bool | None) -> bool:
        drawn = bool(self.rng.random() < 0.5)  # drawn always, so that one option does not shift the others
        return drawn if fixed is None else fixed

    def count(self, fixed: int | None, most: int) -> int:
        drawn = int(self.rng.integers(most + 1))
        return drawn if fixed is None else fixed

    def uniform(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def vec3(self, size: float) -> Vec3:
        x, y, z = self.rng.normal(size=3) * size
        return (float(x), float(y), float(z))

    def definite6(self, size: float) -> Mat6:
        """A symmetric positive definite 6x6 whose units are `size`, times m, times m2; not block diagonal."""
        factor = self.rng.normal(size=(6, 6)) * 0.3 + np.eye(6)
        scale = np.array([1.0] * 3 + [_LENGTH] * 3)
        matrix = size * (factor @ factor.T) * scale[:, None] * scale[None, :]
        return cast(Mat6, rows((matrix + matrix.T) / 2))


class Errors:
    """Errors of at most `share`, drawn one after the other."""

    def __init__(self, rng: np.random.Generator, share: float) -> None:
        self.rng, self.share = rng, share

    def errors(self, count: int) -> Array:
        return self.rng.uniform(-self.share, self.share, count)

    def times(self, value: float) -> float:
        return value * (1.0 + float(self.errors(1)[0]))

    def vector(self, value: Vec3) -> Vec3:
        size = float(np.linalg.norm(value)) / math.sqrt(3.0)
        return cast(Vec3, tuple((np.array(value) + size * self.errors(3)).tolist()))

    def direction(self) -> Array:
        return self.errors(3) / math.sqrt(3.0)

    def matrix(self, value: Mat6 | None) -> Mat6 | None:
        if value is None:
            return None
        S = np.sqrt(1.0 + self.errors(6))
        return cast(Mat6, tuple(map(tuple, (S[:, None] * np.array(value) * S).tolist())))


def rows(matrix: Array) -> tuple[tuple[float, ...], ...]:
    """A matrix as rows of floats."""
    return tuple(tuple(float(x) for x in row) for row in matrix)


Mark = TypeVar("Mark")


class Note(Protocol):
    """Notes a problem of the file: the parts of the key path, the last the reason."""

    def __call__(self, *words: str) -> None: ...


# -- what is said of a field -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Tables:
    """A list of tables inside, each of this class."""

    of: type[Declared]


@dataclass(frozen=True)
class Inside:
    """A table inside, of this class."""

    of: type[Declared]


@dataclass(frozen=True)
class InC:
    """A member of the struct in C, with its comment; `unit`: where the C writes another than the file."""

    comment: str = ""
    unit: str | None = None


@dataclass(frozen=True)
class Size:
    """A body of a random stand: `mass` (kg) and `size` (m); `mean`, the average mass of such bodies."""

    mass: float = 1.0
    size: float = 1.0
    mean: float = 1.0


@dataclass(frozen=True)
class Drawn:
    """How random stands draw it."""

    draw: Callable[[Draw, Size], Any]


def uniform(low: float, high: float) -> Drawn:
    """A number of this range."""
    return Drawn(lambda draw, of: draw.uniform(low, high))


def normal(size: float) -> Drawn:
    """A vector with components of this size."""
    return Drawn(lambda draw, of: draw.vec3(size))


@dataclass(frozen=True)
class Spread:
    """The error that it is measured with; those that are `late` are drawn after all others of their table."""

    add: Callable[[Errors, Any], Any]
    late: bool = False


TIMES = Spread(Errors.times)
TIMES_EACH = Spread(lambda errors, values: tuple(map(errors.times, values)))
AS_VECTOR = Spread(Errors.vector, late=True)
AS_MATRIX = Spread(Errors.matrix, late=True)


@dataclass(frozen=True)
class Warns:
    """A 6x6 matrix that does this, where it has a negative number on its diagonal: `check` warns of it."""

    does: str


BRAKES = Warns("it drives where it should brake; coefficients that damp are positive")
PULLS_BACK = Warns("it pushes away where it should pull back; what pulls back is positive")


# -- tables ----------------------------------------------------------------------------------------------------------


class Declared:
    """A dataclass that declares a table of the stand file by the annotations of its fields.

    keys   base of its table: keys that are none of its fields, and what several keys tell together
    """

    keys: ClassVar[type[Table]] = Table

    @classmethod
    @cache
    def annotations(cls) -> dict[str, tuple[Any, ...]]:
        """Type of each field, and what is said of it."""
        hints = annotations_of(cls)
        result = {f.name: hints[f.name] for f in fields(cls)}  # type: ignore[arg-type]  # every subclass is a dataclass
        return {
            name: (hint.__origin__, *hint.__metadata__) if hasattr(hint, "__metadata__") else (hint,)
            for name, hint in result.items()
        }

    @classmethod
    def marked(cls, kind: type[Mark]) -> dict[str, Mark]:
        """What is said of fields in a word of one kind, by their names."""
        every = ((name, [x for x in said if isinstance(x, kind)]) for name, said in cls.annotations().items())
        return {name: result[0] for name, result in every if result}

    @classmethod
    @cache
    def table(cls) -> type[Table]:
        """The table of the file: its keys are the fields that a validator reads, or that are tables inside."""
        hints: dict[str, Any] = {}
        for name, said in cls.annotations().items():
            for mark in said:
                if isinstance(mark, QuantityValidator):
                    hints[name] = Annotated[said[0], mark]
                elif isinstance(mark, Tables):
                    hints[name] = list[mark.of.table()]  # type: ignore[misc]  # made here
                elif isinstance(mark, Inside):
                    hints[name] = mark.of.table()
        defaults = cls.marked(Default)
        hints = {name: (hint, defaults[name].value if name in defaults else MISSING) for name, hint in hints.items()}
        return make_table(cls, cls.keys, hints)

    @classmethod
    def of_table(cls, table: Table, **more: Any) -> Self:
        """The data of a valid table; a 6x6 of zeros, which tables have as None, with its zeros."""
        values: dict[str, Any] = {}
        lists, inside = cls.marked(Tables), cls.marked(Inside)
        for name in cls.annotations().keys() & {key.name for key in declared_keys(type(table))}:
            value = getattr(table, name)
            if name in lists:
                value = tuple(map(lists[name].of.of_table, value))
            elif name in inside and value is not None:
                value = inside[name].of.of_table(value)
            elif value is None and cls.annotations()[name][0] == Mat6:
                value = ZERO6
            values[name] = value
        return cls(**(values | more))

    def as_keys(self) -> dict[str, Any]:
        """Its keys in a stand file, in SI."""
        readers, defaults = self.marked(QuantityValidator), self.marked(Default)
        in_file = {key.name for key in declared_keys(self.table())}
        result: dict[str, Any] = {}
        for name in self.annotations():
            value = getattr(self, name)
            left_out = name in defaults and not defaults[name].written and value == defaults[name].value
            if name in in_file and value is not None and not left_out:
                write = readers[name].write if name in readers else None
                result[name] = _in_file(write(value) if write else value)
        return result

    @classmethod
    def random(cls, draw: Draw, of: Size = Size()) -> Self:
        """A random one, field by field."""
        return cls(**{name: mark.draw(draw, of) for name, mark in cls.marked(Drawn).items()})

    def with_errors(self, errors: Errors) -> Self:
        """One that was measured a little wrong: numbers and tables inside first, then vectors and matrices."""
        changed: dict[str, Any] = {}
        spreads = self.marked(Spread)
        for late in (False, True):
            for f in fields(self):  # type: ignore[arg-type]  # every subclass is a dataclass
                value, spread = getattr(self, f.name), spreads.get(f.name)
                if spread is not None and spread.late is late:
                    changed[f.name] = spread.add(errors, value)
                elif not late and isinstance(value, tuple) and value and isinstance(value[0], Declared):
                    changed[f.name] = tuple(entry.with_errors(errors) for entry in value)
        return replace(self, **changed)  # type: ignore[type-var]  # every subclass is a dataclass


def _in_file(value: Any) -> Any:
    """A value with its tables as keys of the file."""
    if isinstance(value, Declared):
        return value.as_keys()
    return [_in_file(item) for item in value] if isinstance(value, tuple) else value
