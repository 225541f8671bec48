"""Inputs of the self-test, drawn from an integer generator by exact operations: the target draws the same bits.

A plan says in which order which inputs of the public functions are drawn and how. Python follows it here; `emit`
prints it as C.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import prod
from typing import Any

from mahovik.contract.quantities import DRAWN_STEP, QUANTITIES, TABLES, Draw
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Program
from mahovik.core.program.types import Kind, NamedCount, Precision, Struct

SEED = 0x6D61686F
"""Seed of the first state of a sweep; each further state goes on from the one before."""

FAST_EVERY, FAST = 4, 32
"""Every fourth state of a sweep has phases and speeds 32 times as large."""

OPTIONS_EVERY, OMITTED_EVERY = 2, 3
"""Every second state of a sweep has drawn options; in every third the arrays that may be left out are null."""

REFUSED_EVERY = 16
"""Every sixteenth has an attitude of twice the unit length, which is out of range."""

FAST_INPUTS = ("phi", "phi_dot")

MASS_FACTOR = "mass_factor"
"""Name of the factor by which masses and inertias of the default parameters are multiplied."""

SCALED = ("mass", "inertia")
"""Members of a body that the factor multiplies: a body remains one that can exist."""

OPTIONS = "options"
"""Name of the options of `inverse` and the like."""

DEMAND = "demand"
"""Name of what the functions of tasks take, one number for each row."""

SINE, COSINE = "sine", "cosine"
"""Names of inputs that are drawn together."""


@dataclass(frozen=True)
class Input:
    """One input: where it stands among the inputs, and how it is drawn."""

    path: tuple[str, ...]
    rule: Draw
    shape: tuple[int | NamedCount, ...] = ()
    largest: float = 1.0

    @property
    def name(self) -> str:
        return self.path[-1]

    @property
    def count(self) -> int:
        return prod(int(n) for n in self.shape)


def inputs(program: Program) -> tuple[Argument, ...]:
    """Arguments of the public functions that a test must choose, each once. Raises ValueError.

    Arguments of one name are one input: the functions of a stand give one name to one thing. The demands of tasks
    differ in length: the longest is drawn, and a function takes its first numbers (`first_of`).
    """
    by_name: dict[str, Argument] = {}
    for function in program.functions:
        for a in function.arguments if function.public else ():
            if a.direction == "out" or (isinstance(a.type, Struct) and a.type.name in TABLES):
                continue
            known = by_name.setdefault(a.name, a)
            if a.name == DEMAND:
                by_name[a.name] = longer(known, a)
            elif (known.type, known.shape) != (a.type, a.shape):
                raise ValueError(f"{function.name}: {a.name} is something else than in another function")
    return tuple(by_name.values())


def longer(one: Argument, other: Argument) -> Argument:
    """The longer of two arguments of one name; the first of equals."""
    return other if one.name == DEMAND and int(other.shape[0]) > int(one.shape[0]) else one


def first_of(a: Argument, values: Any) -> Any:
    """Numbers of an input that an argument takes: of a demand as many as the task has rows, else all."""
    return values[: int(a.shape[0])] if a.name == DEMAND else values


def plan(program: Program) -> tuple[Input, ...]:
    """All inputs in the order in which they are drawn."""
    rows = [row for a in inputs(program) for row in _inputs_of(a.name, a.type, a.shape, ())]
    return (*rows, Input((MASS_FACTOR,), Draw.FACTOR, (), 0.125))


def options_plan(program: Program) -> tuple[Input, ...]:
    """Options of `inverse` and the like in the order in which they are drawn; none where no function takes them."""
    options = next((a for f in program.functions if f.public for a in f.arguments if a.name == OPTIONS), None)
    return () if options is None else tuple(_inputs_of(OPTIONS, options.type, (), ()))


def _inputs_of(name: str, type_: Kind | Struct, shape: tuple[Any, ...], within: tuple[str, ...]) -> Iterator[Input]:
    path = (*within, name)
    if isinstance(type_, Struct):
        if shape:
            raise ValueError(f"{name}: arrays of structs are not drawn")
        for f in type_.fields:
            yield from _inputs_of(f.name, f.type, f.shape, path)
        return
    row = QUANTITIES.get(name)
    draw = row.draw if row else Draw.FLAGS if type_ is Kind.INT else Draw.REALS
    if draw is not Draw.NEVER:
        yield Input(path, draw, shape, row.largest_drawn if row else 1.0)


class Generator:
    """xorshift32: the same integers on every machine."""

    def __init__(self, seed: int = SEED) -> None:
        self._word = seed

    def word(self) -> int:
        """The next 32 bits, never 0."""
        x = self._word
        x ^= x << 13 & 0xFFFFFFFF
        x ^= x >> 17
        x ^= x << 5 & 0xFFFFFFFF
        self._word = x
        return x

    def real(self, largest: float) -> float:
        """The upper 24 bits as a real in [-largest, largest): exact for a power of two."""
        return largest * (((self.word() >> 8) - (1 << 23)) / (1 << 23))

    def attitude(self, precision: Precision) -> list[Any]:
        """A unit quaternion."""
        word = self.word()
        a = 2 * (word >> 25) - 127  # odd: the sum of squares is not 0
        b, c, d = ((word >> shift & 0xFF) - 128 for shift in (16, 8, 0))
        length = precision.scalar(a * a + b * b + c * c + d * d)
        parts = (a * a - b * b - c * c - d * d, 2 * a * b, 2 * a * c, 2 * a * d)
        return [precision.scalar(part) / length for part in parts]

    def turn(self, precision: Precision) -> tuple[float, float]:
        """Sine and cosine of an angle."""
        word = self.word()
        a, b = 2 * (word >> 25) - 127, (word >> 16 & 0xFF) - 128
        length = precision.scalar(a * a + b * b)
        return float(precision.scalar(2 * a * b) / length), float(precision.scalar(a * a - b * b) / length)


def draw(
    planned: tuple[Input, ...], generator: Generator, precision: Precision, factors: Mapping[str, float] | None = None
) -> dict[str, Any]:
    """Inputs by argument name. `factors` multiply those of a name, exactly where they are powers of two."""
    drawn: dict[str, Any] = {}
    for row in planned:
        factor = (factors or {}).get(row.name, 1.0)
        place = drawn
        for name in row.path[:-1]:
            place = place.setdefault(name, {})
        if row.rule is Draw.TURNS:
            turns = [generator.turn(precision) for _ in range(row.count)]
            place[SINE], place[COSINE] = [s * factor for s, _ in turns], [c * factor for _, c in turns]
        else:
            place[row.name] = _value(row, generator, precision, factor)
    return drawn


def _value(row: Input, generator: Generator, precision: Precision, factor: float) -> Any:
    match row.rule:
        case Draw.ATTITUDE:
            return [float(x) * factor for x in generator.attitude(precision)]
        case Draw.ORDER:
            return 4 if generator.word() & 0x100 else 2
        case Draw.STEP:
            return DRAWN_STEP * factor
        case Draw.SHARE:
            return abs(generator.real(1.0))
        case Draw.FACTOR:
            return (1.0 + generator.real(row.largest)) * factor
        case Draw.FLAGS:
            numbers: list[Any] = [int(generator.word() >> 30 == 0) for _ in range(row.count)]
        case Draw.POWER:
            numbers = [row.largest * 2.0 ** (generator.word() >> 27) for _ in range(row.count)]
        case _:
            numbers = [generator.real(row.largest) * factor for _ in range(row.count)]
    return _reshape(numbers, row.shape)


def _reshape(numbers: list[Any], shape: tuple[Any, ...]) -> Any:
    """Numbers in rows, a scalar where there is no shape."""
    if not shape:
        return numbers[0]
    if len(shape) == 1:
        return numbers
    size = len(numbers) // int(shape[0])
    return [_reshape(numbers[i : i + size], shape[1:]) for i in range(0, len(numbers), size)]


def sweep_factors(state: int) -> dict[str, float]:
    """Factors in a state of a sweep, by its number from 0."""
    factors: dict[str, float] = {}
    if state % FAST_EVERY == FAST_EVERY - 1:
        factors |= dict.fromkeys(FAST_INPUTS, float(FAST))
    if state % REFUSED_EVERY == REFUSED_EVERY - 1:
        factors["attitude"] = 2.0
    return factors
