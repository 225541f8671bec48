"""Runs routines with the interpreter and measures errors against mpmath, in units in the last place."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import mpmath as mp
import numpy as np

from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import Precision
from mahovik.core.routines import atan2, exponential, sincos, square_root

Real = Any
"""A number of Python, NumPy or mpmath."""
BITS = 200  # of the reference: arguments near multiples of pi/2 cancel about 60 + 24 of them


@cache
def interpreter(precision: Precision) -> Interpreter:
    """All routines of one precision."""
    functions = tuple(make(precision) for make in (sincos, square_root, atan2, exponential))
    return Interpreter(Program("routines", precision, (), (), functions))


def call_sincos(precision: Precision, x: Real) -> tuple[Any, Any]:
    """(sine, cosine) of a number that is rounded to the element type first."""
    sine, cosine = [precision.scalar(0)], [precision.scalar(0)]
    interpreter(precision).call("sincos", precision.scalar(x), sine, cosine)
    return sine[0], cosine[0]


def call(precision: Precision, name: str, *arguments: Real) -> Any:
    """The value of a routine that returns one."""
    return interpreter(precision).call(name, *(precision.scalar(a) for a in arguments))


def exact(value: Real) -> mp.mpf:
    """A machine number as an mpmath number."""
    return mp.mpf(float(value))


def last_place(precision: Precision, value: Real) -> mp.mpf:
    """The unit in the last place of the machine number next to a real number."""
    return mp.mpf(float(np.spacing(np.abs(precision.scalar(float(value))))))


def error_in_last_places(precision: Precision, got: Real, expected: Real) -> float:
    """|got - expected| in units in the last place of `expected`."""
    return float(abs(exact(got) - expected) / last_place(precision, expected))


def neighbours(precision: Precision, value: Real, reach: int = 3) -> Iterator[Any]:
    """The machine number next to `value` and `reach` more on each side."""
    middle = precision.scalar(float(value))
    for direction in (-np.inf, np.inf):
        x = middle
        for _ in range(reach):
            x = np.nextafter(x, precision.scalar(direction))
            yield x
    yield middle


def convergents(value: Real, largest: float) -> Iterator[tuple[int, int]]:
    """p/q of the continued fraction of `value`, with p below `largest`."""
    p0, q0, p1, q1 = 0, 1, 1, 0
    while True:
        whole = int(mp.floor(value))
        p0, q0, p1, q1 = p1, q1, whole * p1 + p0, whole * q1 + q0
        if p1 >= largest:
            return
        yield p1, q1
        value = 1 / (value - whole)


def closest_to_quarter_turns(precision: Precision, largest: float) -> list[float]:
    """Machine numbers up to `largest` that are extraordinarily close to a multiple of pi/2.

    x = S 2^e is close to k pi/2 where S/k is a convergent of (pi/2)/2^e (Kahan); multiples of a convergent fill
    the significand.
    """
    with mp.workprec(BITS):
        values: set[float] = set()
        limit = 1 << precision.significand
        for exponent in range(-precision.significand, int(np.log2(largest)) - precision.significand + 2):
            for p, _ in convergents(mp.pi / 2 / mp.mpf(2) ** exponent, limit):
                values.update(m * p * 2.0**exponent for m in (1, 2, 3, (limit - 1) // p))
        return sorted(x for x in values if x <= largest)
