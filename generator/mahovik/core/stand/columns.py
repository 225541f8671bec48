"""Many stands read as one: a column stands for a number, and has the number of each sample.

Code that reads a stand file does with a column what it does with a float: the same operations, sample by sample, so
the same bits. Where it decides by a comparison, the first sample of the column decides; samples for which the answer is
another one are noted in `Run.diverged`: what was computed is not true of them, and they are read again by themselves.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.polar import polar as numbers_of_polar


@dataclass
class Run:
    """One reading of many samples. `diverged`: samples that would not have gone the way of the first."""

    diverged: NDArray[np.bool_]

    @staticmethod
    def of(n: int) -> Run:
        """A reading of n samples, none of which has diverged."""
        return Run(np.zeros(n, dtype=np.bool_))


class Column:
    """A number of each sample; `keys`: paths of the stand file that it depends on."""

    __slots__ = ("keys", "run", "values")
    __array_ufunc__ = None  # numbers of NumPy leave operators to this class

    def __init__(self, values: NDArray[Any], run: Run, keys: frozenset[str] = frozenset()) -> None:
        self.values, self.run, self.keys = values, run, keys

    def map(self, function: Callable[[NDArray[Any]], NDArray[Any]]) -> Column:
        """A column of a function of the numbers."""
        with np.errstate(all="ignore"):
            return Column(function(self.values), self.run, self.keys)

    def _with(self, other: Any, function: Callable[[Any, Any], Any]) -> Any:
        if isinstance(other, Column):
            with np.errstate(all="ignore"):
                return Column(function(self.values, other.values), self.run, self.keys | other.keys)
        if isinstance(other, int | float | np.number):
            with np.errstate(all="ignore"):
                return Column(function(self.values, other), self.run, self.keys)
        return NotImplemented

    def decide(self, answers: NDArray[np.bool_]) -> bool:
        """The answer of the first sample; samples with another one have diverged."""
        first = bool(answers[0])
        self.run.diverged |= answers != first
        return first

    def _compare(self, other: Any, function: Callable[[Any, Any], Any]) -> Any:
        found = self._with(other, function)
        return found if found is NotImplemented else self.decide(found.values)

    def finite(self) -> bool:
        """Is the first sample's number finite?"""
        return self.decide(np.isfinite(self.values))

    # -- operators of floats -----------------------------------------------------------------------------------------

    def __add__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a + b)

    def __radd__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: b + a)

    def __sub__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a - b)

    def __rsub__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: b - a)

    def __mul__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a * b)

    def __rmul__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: b * a)

    def __truediv__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a / b)

    def __rtruediv__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: b / a)

    def __neg__(self) -> Column:
        return self.map(np.negative)

    def __abs__(self) -> Column:
        return self.map(np.abs)

    # -- operators of words, in which reals are taken apart ----------------------------------------------------------

    def __and__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a & a.dtype.type(b) if isinstance(b, int) else a & b)

    def __xor__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a ^ a.dtype.type(b) if isinstance(b, int) else a ^ b)

    def __lshift__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a << a.dtype.type(b))

    def __rshift__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a >> a.dtype.type(b))

    # -- decisions ---------------------------------------------------------------------------------------------------

    def __bool__(self) -> bool:
        return self.decide(self.values != 0)

    def __eq__(self, other: object) -> bool:
        found: bool = self._compare(other, lambda a, b: a == b)
        return found

    def __ne__(self, other: object) -> bool:
        found: bool = self._compare(other, lambda a, b: a != b)
        return found

    def __lt__(self, other: Any) -> Any:
        return self._compare(other, lambda a, b: a < b)

    def __le__(self, other: Any) -> Any:
        return self._compare(other, lambda a, b: a <= b)

    def __gt__(self, other: Any) -> Any:
        return self._compare(other, lambda a, b: a > b)

    def __ge__(self, other: Any) -> Any:
        return self._compare(other, lambda a, b: a >= b)

    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<{len(self.values)} numbers>"

    def __format__(self, spec: str) -> str:
        return repr(self)


def values_of(number: Any, n: int) -> NDArray[np.float64]:
    """The numbers of n samples, of a column or of one number for all."""
    return np.asarray(number.values if isinstance(number, Column) else np.full(n, number), dtype=np.float64)


def hypot(*numbers: Any) -> Any:
    """Length of a vector."""
    return _by_sample(math.hypot, *numbers)


def atan2(a: Any, b: Any) -> Any:
    """Angle of (b, a), rad."""
    return _by_sample(math.atan2, a, b)


def _by_sample(function: Callable[..., float], *numbers: Any) -> Any:
    """A function of `math`, for columns sample by sample: other libraries round it otherwise."""
    columns = [x for x in numbers if isinstance(x, Column)]
    if not columns:
        return function(*numbers)
    n, keys = len(columns[0].values), frozenset[str]().union(*(x.keys for x in columns))
    found = np.fromiter(map(function, *(values_of(x, n).tolist() for x in numbers)), np.float64, n)
    return Column(found, columns[0].run, keys)


def polar(length: Any, angle: Any, divisor: Any) -> tuple[Any, Any]:
    """`length / divisor` times (cos, sin) of `angle`, each correctly rounded."""
    numbers = (length, angle, divisor)
    columns = [each for each in numbers if isinstance(each, Column)]
    found = numbers_of_polar(*(each.values if isinstance(each, Column) else each for each in numbers))
    if not columns:
        return found
    keys = frozenset[str]().union(*(each.keys for each in columns))
    return Column(found[0], columns[0].run, keys), Column(found[1], columns[0].run, keys)
