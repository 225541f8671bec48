"""Many stands read as one: a column stands for a number, and has the number of each sample.

Code that reads a stand file does with a column what it does with a float: the same operations, sample by sample, so
the same bits. Where it decides by a comparison, the first sample of the column decides; samples for which the answer is
another one are noted in `Run.diverged`: what was computed is not true of them, and they are read again by themselves.

`polar` has r cos(a) and r sin(a) rounded correctly: the same bits on every machine, which no libm promises. One number
is computed with 40 digits. Arrays are computed in long double: where both ends of the interval that its error leaves
round to one double it is the answer, elsewhere 40 digits decide.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar, cast

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import NDArray

Array = NDArray[np.float64]
Tree = TypeVar("Tree")
_COMPARISONS = (np.equal, np.not_equal, np.less, np.less_equal, np.greater, np.greater_equal)


class Run:
    """One reading of many samples. `diverged`: samples that would not have gone the way of the first."""

    def __init__(self, n: int) -> None:
        self.diverged: NDArray[np.bool_] = np.zeros(n, dtype=np.bool_)


class Column(NDArrayOperatorsMixin):
    """A number of each sample; `keys`: paths of the stand file that it depends on."""

    __slots__ = ("keys", "run", "values")
    __hash__ = object.__hash__

    def __init__(self, values: NDArray[Any], run: Run, keys: frozenset[str] = frozenset()) -> None:
        self.values, self.run, self.keys = values, run, keys

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        """A column of a function of columns and numbers; the answer of a comparison."""
        if method != "__call__" or options or not all(isinstance(x, Column | int | float | np.number) for x in inputs):
            return ufunc is np.not_equal if ufunc in (np.equal, np.not_equal) else NotImplemented
        with np.errstate(all="ignore"):
            values = ufunc(*(x.values if isinstance(x, Column) else x for x in inputs))
        return self.decide(values) if ufunc in _COMPARISONS else Column(values, self.run, _keys(inputs))

    def map(self, function: Callable[[NDArray[Any]], NDArray[Any]]) -> Column:
        """A column of a function of the numbers."""
        with np.errstate(all="ignore"):
            return Column(function(self.values), self.run, self.keys)

    def decide(self, answers: NDArray[np.bool_]) -> bool:
        """The answer of the first sample; samples with another one have diverged."""
        first = bool(answers[0])
        self.run.diverged |= answers != first
        return first

    def finite(self) -> bool:
        """Is the first sample's number finite?"""
        return self.decide(np.isfinite(self.values))

    def __bool__(self) -> bool:
        return self.decide(self.values != 0)

    def __repr__(self) -> str:
        return f"<{len(self.values)} numbers>"

    def __format__(self, spec: str) -> str:
        return repr(self)


def _keys(numbers: Any) -> frozenset[str]:
    """Paths that any of some numbers depends on."""
    return frozenset[str]().union(*(x.keys for x in numbers if isinstance(x, Column)))


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
    n = len(columns[0].values)
    by_sample = np.fromiter(map(function, *(values_of(x, n).tolist() for x in numbers)), np.float64, n)
    return Column(by_sample, columns[0].run, _keys(columns))


def numbers(value: Any) -> Iterator[Any]:
    """Every number of a stand or a part of it."""
    if is_dataclass(value):
        for f in fields(value):
            yield from numbers(getattr(value, f.name))
    elif isinstance(value, tuple | list):
        for entry in value:
            yield from numbers(entry)
    elif isinstance(value, float | Column):
        yield value


def by_sample(function: Callable[[Any], Tree], value: Any) -> Tree:
    """A function of data, sample by sample where there are columns in it; its result has columns for its numbers.

    Raises what it raises for the first sample; samples that part from the first in this have diverged.
    """
    columns = [x for x in numbers(value) if isinstance(x, Column)]
    if not columns:
        return function(value)
    results: list[Any] = []
    for k in range(len(columns[0].values)):
        try:
            results.append(function(of_sample(value, k)))
        except ValueError as error:
            results.append(error)
    columns[0].run.diverged |= [isinstance(x, ValueError) != isinstance(results[0], ValueError) for x in results]
    if isinstance(results[0], ValueError):
        raise results[0]
    rows = [list(numbers(x if not isinstance(x, ValueError) else results[0])) for x in results]
    stacked = iter(np.array(rows, dtype=np.float64).T)
    keys = _keys(columns)
    return cast(Tree, _with_numbers(lambda _: Column(next(stacked), columns[0].run, keys), results[0]))


def of_sample(value: Tree, k: int) -> Tree:
    """The data of one sample."""
    return cast(Tree, _with_numbers(lambda x: x.values[k].item() if isinstance(x, Column) else x, value))


def _with_numbers(change: Callable[[Any], Any], value: Any) -> Any:
    """The data with other numbers, in the order of `numbers`."""
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{f.name: _with_numbers(change, getattr(value, f.name)) for f in fields(value)})
    if isinstance(value, tuple | list):
        return type(value)(_with_numbers(change, entry) for entry in value)
    return change(value) if isinstance(value, float | Column) else value


# -- r cos(a), r sin(a) ----------------------------------------------------------------------------------------------

_DIGITS = 40

_LONG = np.finfo(np.longdouble)
_IS_LONGER = _LONG.nmant in (63, 112)
"""Whether long double has more digits than double; elsewhere 40 digits are used for every sample."""

_ERROR = 4 * _LONG.eps
"""Most relative error of a quotient times a cosine in long double, each rounded within one place of its last digit."""


def polar(length: Any, angle: Any, divisor: Any) -> tuple[Any, Any]:
    """`length / divisor` times (cos, sin) of `angle`, each correctly rounded."""
    numbers = (length, angle, divisor)
    columns = [x for x in numbers if isinstance(x, Column)]
    if not columns:
        return _exact(float(length), float(angle), float(divisor))
    y, z = _polar_of_arrays(*(x.values if isinstance(x, Column) else x for x in numbers))
    return Column(y, columns[0].run, _keys(columns)), Column(z, columns[0].run, _keys(columns))


def _polar_of_arrays(length: Any, angle: Any, divisor: Any) -> tuple[Array, Array]:
    """`length / divisor` times (cos, sin) of `angle`, each correctly rounded; one of them is an array."""
    U, a, m = np.broadcast_arrays(*(np.asarray(x, dtype=np.longdouble) for x in (length, angle, divisor)))
    parts, uncertain = [], np.full(U.shape, not _IS_LONGER)
    with np.errstate(all="ignore"):
        for function in (np.cos, np.sin):
            value = U / m * function(a)
            error = np.abs(value) * _ERROR
            least, most = (value - error).astype(np.float64), (value + error).astype(np.float64)
            uncertain |= (least != most) | ((value != 0.0) & (np.abs(most) < np.finfo(np.float64).tiny))
            parts.append(most + 0.0)
    for j in np.flatnonzero(uncertain):
        parts[0][j], parts[1][j] = _exact(float(U[j]), float(a[j]), float(m[j]))
    return parts[0], parts[1]


def _exact(length: float, angle: float, divisor: float) -> tuple[float, float]:
    if angle == 0.0:
        return length / divisor + 0.0, 0.0
    import mpmath  # takes as long to start as all else of a small stand

    with mpmath.workdps(_DIGITS):
        ratio, at = mpmath.mpf(length) / mpmath.mpf(divisor), mpmath.mpf(angle)
        return float(ratio * mpmath.cos(at)) + 0.0, float(ratio * mpmath.sin(at)) + 0.0
