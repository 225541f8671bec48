"""Many stands read as one: a column stands for a number, and has the number of each sample.

Code that reads a stand file does with a column what it does with a float: the same operations, sample by sample, so
the same bits. Where it decides by a comparison, the first sample of the column decides; samples for which the answer is
another one are noted in `Run.diverged`: what was computed is not true of them, and they are read again by themselves.

`polar` has r cos(a) and r sin(a) rounded correctly: the same bits on every machine, which no libm promises. One number
is computed with 40 digits. Arrays are computed as sums of two doubles (Dekker 1971), with an error below 2^-93 of r:
where both ends of that interval round to one double it is the answer, elsewhere 40 digits decide.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache, partial
from typing import Any, TypeVar, cast

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import NDArray

Array = NDArray[np.float64]
Tree = TypeVar("Tree")
_COMPARISONS = (np.equal, np.not_equal, np.less, np.less_equal, np.greater, np.greater_equal)


@dataclass
class Run:
    """One reading of many samples. `diverged`: samples that would not have gone the way of the first."""

    diverged: NDArray[np.bool_]

    @staticmethod
    def of(n: int) -> Run:
        """A reading of n samples, none of which has diverged."""
        return Run(np.zeros(n, dtype=np.bool_))


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
    found = np.fromiter(map(function, *(values_of(x, n).tolist() for x in numbers)), np.float64, n)
    return Column(found, columns[0].run, _keys(columns))


def numbers(value: Any) -> Iterator[Any]:
    """Every number of a stand or a part of it."""
    if is_dataclass(value):
        for f in fields(value):
            yield from numbers(getattr(value, f.name))
    elif isinstance(value, tuple | list):
        for each in value:
            yield from numbers(each)
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
            results.append(function(_with_numbers(partial(_of_sample, k), value)))
        except ValueError as error:
            results.append(error)
    columns[0].run.diverged |= [isinstance(x, ValueError) != isinstance(results[0], ValueError) for x in results]
    if isinstance(results[0], ValueError):
        raise results[0]
    rows = [list(numbers(x if not isinstance(x, ValueError) else results[0])) for x in results]
    stacked = iter(np.array(rows, dtype=np.float64).T)
    keys = _keys(columns)
    return cast(Tree, _with_numbers(lambda _: Column(next(stacked), columns[0].run, keys), results[0]))


def _of_sample(k: int, number: Any) -> Any:
    return number.values[k].item() if isinstance(number, Column) else number


def _with_numbers(change: Callable[[Any], Any], value: Any) -> Any:
    """The data with other numbers, in the order of `numbers`."""
    if is_dataclass(value) and not isinstance(value, type):
        return replace(value, **{f.name: _with_numbers(change, getattr(value, f.name)) for f in fields(value)})
    if isinstance(value, tuple | list):
        return type(value)(_with_numbers(change, each) for each in value)
    return change(value) if isinstance(value, float | Column) else value


# -- r cos(a), r sin(a) ----------------------------------------------------------------------------------------------

Double = tuple[Any, Any]
"""An unevaluated sum: the second is below half a place of the first."""

_DIGITS = 40
_PARTS = 64
"""Parts of a half turn for which sine and cosine are in a table."""
_LARGEST = 1e3
"""rad; beyond, and for lengths whose products leave the range of doubles, 40 digits are used at once."""
_ERROR = 2.0**-93
_SPLIT = 134217729.0  # 2^27 + 1


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
    with np.errstate(all="ignore"):
        U, m = np.asarray(length, dtype=np.float64), np.asarray(divisor, dtype=np.float64)
        ratio = _quotient(U, m)
        if isinstance(angle, np.ndarray):
            cosine, sine = _cos_sin(angle)
            error = np.abs(ratio[0]) * _ERROR
        else:  # with all digits, also near a zero
            cosine, sine = _double(_high(float(angle), "cos")), _double(_high(float(angle), "sin"))
            error = np.zeros(())
        found = []
        uncertain: NDArray[np.bool_] = ~(
            (np.abs(ratio[0]) > 1e-200) & (np.abs(ratio[0]) < 1e200) & (np.abs(U) > 1e-200)
        )
        uncertain = uncertain | ~((np.abs(m) < 1e200) & (np.abs(m) > 1e-200)) | ~(np.abs(angle) <= _LARGEST)
        for part in (cosine, sine):
            high, low = _product(ratio, part)
            bound = error + np.abs(high) * _ERROR
            uncertain = uncertain | (high + (low + bound) != high + (low - bound))
            found.append(np.array(high + low) + 0.0)
    for j in np.flatnonzero(uncertain):
        each = (float(x[j] if isinstance(x, np.ndarray) else x) for x in (length, angle, divisor))
        found[0][j], found[1][j] = _exact(*each)
    return found[0], found[1]


def _exact(length: float, angle: float, divisor: float) -> tuple[float, float]:
    if angle == 0.0:
        return length / divisor + 0.0, 0.0
    import mpmath  # takes as long to start as all else of a small stand

    with mpmath.workdps(_DIGITS):
        ratio, at = mpmath.mpf(length) / mpmath.mpf(divisor), mpmath.mpf(angle)
        return float(ratio * mpmath.cos(at)) + 0.0, float(ratio * mpmath.sin(at)) + 0.0


# -- sums of two doubles ---------------------------------------------------------------------------------------------


def _sum(a: Array, b: Array) -> Double:
    """a + b exactly."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def _times(a: Any, b: Any) -> Double:
    """a b exactly."""
    p = a * b
    u, v = a * _SPLIT, b * _SPLIT
    a1, b1 = u - (u - a), v - (v - b)
    a2, b2 = a - a1, b - b1
    return p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2


def _product(a: Double, b: Double) -> Double:
    p, e = _times(a[0], b[0])
    return _sum(p, e + (a[0] * b[1] + a[1] * b[0]))


def _plus(a: Double, b: Double) -> Double:
    s, e = _sum(a[0], b[0])
    t, f = _sum(a[1], b[1])
    s, e = _sum(s, e + t)
    return _sum(s, e + f)


def _quotient(a: Array, b: Array) -> Double:
    q = a / b
    p, e = _times(q, b)
    second = ((a - p) - e) / b
    p2, e2 = _times(second, b)
    rest = (((a - p) - e) - p2) - e2
    high, low = _sum(q, second)
    return _sum(high, low + rest / b)


def _negative(a: Double) -> Double:
    return -a[0], -a[1]


# -- sine and cosine -------------------------------------------------------------------------------------------------


def _high(x: float, name: str) -> Any:
    import mpmath

    with mpmath.workdps(_DIGITS):
        return getattr(mpmath, name)(mpmath.mpf(x))


def _double(x: Any, parts: int = 2) -> Any:
    """A number of many digits as a sum of doubles."""
    import mpmath

    with mpmath.workdps(3 * _DIGITS):
        found = []
        for _ in range(parts):
            found.append(np.float64(float(x)))
            x = x - mpmath.mpf(float(x))
    return tuple(found)


@cache
def _constants() -> tuple[Array, Array, Array, tuple[Double, ...]]:
    """pi / 64 in three parts; cosine and sine of its multiples; 1/2!, 1/3!, ... 1/7! as sums of two doubles."""
    import mpmath

    with mpmath.workdps(3 * _DIGITS):
        unit = mpmath.pi / _PARTS
        cosines = np.array([_double(mpmath.cos(unit * k)) for k in range(2 * _PARTS)])
        sines = np.array([_double(mpmath.sin(unit * k)) for k in range(2 * _PARTS)])
        fractions = tuple(_double(1 / mpmath.factorial(k)) for k in range(8))
        return np.array(_double(unit, 3)), cosines, sines, fractions


def _cos_sin(angle: Array) -> tuple[Double, Double]:
    """Cosine and sine, error below 2^-95: reduced to |r| <= pi/128 by a table, then series."""
    unit, cosines, sines, over = _constants()
    k = np.rint(angle / unit[0])
    first, second, third = (_times(k, np.float64(each)) for each in unit)
    r = _plus(_plus(_sum(angle, -first[0]), _sum(-first[1], -second[0])), _sum(-second[1], -third[0]))
    z = _product(r, r)
    x = z[0]
    # from the eighth power on doubles suffice
    tail = x * x * x * x * (1 / 40320.0 - x * (1 / 3628800.0 - x * (1 / 479001600.0)))
    series = _plus(over[4], _product(_negative(over[6]), z))
    series = _plus(_negative(over[2]), _product(series, z))
    cosine = _plus(_plus((np.float64(1.0), np.float64(0.0)), _product(series, z)), (tail, np.zeros_like(tail)))
    tail = x * x * x * x * (1 / 362880.0 - x * (1 / 39916800.0 - x * (1 / 6227020800.0)))
    series = _plus(over[5], _product(_negative(over[7]), z))
    series = _plus(_negative(over[3]), _product(series, z))
    ratio = _plus(_plus((np.float64(1.0), np.float64(0.0)), _product(series, z)), (tail, np.zeros_like(tail)))
    sine = _product(r, ratio)
    place = np.mod(np.where(np.isfinite(k), k, 0.0), 2 * _PARTS).astype(np.int64)
    C, S = ((each[place, 0], each[place, 1]) for each in (cosines, sines))
    return (
        _plus(_product(C, cosine), _negative(_product(S, sine))),
        _plus(_product(S, cosine), _product(C, sine)),
    )
