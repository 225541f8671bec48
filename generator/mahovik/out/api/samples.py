"""Values of n samples by path of the stand file: arrays with the samples first, or one value for all."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.columns import Column, Run
from mahovik.core.stand.units import show
from mahovik.errors import InputError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Samples:
    """`given`: by path an array with the samples first, a mapping with such an array, or a value for all samples."""

    given: Mapping[str, Any]
    n: int

    @staticmethod
    def of(changes: Mapping[str, Any], n: int | None) -> Samples:
        """The values of a caller, checked for their shapes. Raises InputError."""
        if not isinstance(changes, Mapping):
            raise InputError(f"tables: expected a mapping from paths to arrays, found {type(changes).__name__}")
        given = {str(path): _value(str(path), value) for path, value in changes.items()}
        sizes = {path: len(x) for path, value in given.items() for x in _arrays(value)}
        if n is not None:
            if isinstance(n, bool) or not isinstance(n, int | np.integer) or n < 0:
                raise InputError(f"tables: n: expected a number of samples, found {n!r:.40}")
            sizes = {"n": int(n)} | sizes
        if len(set(sizes.values())) > 1:
            found = ", ".join(f"{name} {size}" for name, size in sizes.items())
            raise InputError(f"tables: different numbers of samples: {found}")
        if not sizes:
            raise InputError("tables: no array of samples is given; expected one, or n")
        return Samples(given, next(iter(sizes.values())))

    def of_sample(self, value: Any, number: int) -> Any:
        """The value of one sample."""
        if isinstance(value, Mapping):
            return {key: self.of_sample(each, number) for key, each in value.items()}
        return value[number].tolist() if isinstance(value, np.ndarray) else value

    def values(self, number: int) -> dict[str, Any]:
        """The values of one sample by path."""
        return {path: self.of_sample(value, number) for path, value in self.given.items()}

    def part(self, rows: NDArray[np.int64]) -> Samples:
        """Some of the samples, by their numbers."""
        return Samples({path: _part(value, rows) for path, value in self.given.items()}, len(rows))

    def columns(self, rows: NDArray[np.int64], run: Run) -> dict[str, Any]:
        """The values of some samples by path, columns in the place of numbers."""
        return {path: _columns(value, rows, run, frozenset((path,))) for path, value in self.given.items()}


def _value(path: str, value: Any) -> Any:
    """A value with its numbers of samples as an array of floats."""
    if isinstance(value, Mapping):
        return {str(key): _value(path, each) for key, each in value.items()}
    if isinstance(value, str | int | float | bool | None) or not hasattr(value, "__len__"):
        return value
    try:
        found = np.asarray(value)
    except (ValueError, TypeError):
        found = np.array(None)
    if found.dtype.kind not in "iuf" or found.ndim == 0:
        raise InputError(f"tables: {path}: expected an array of numbers, one of each sample, found {show(value)}")
    return np.asarray(found, dtype=np.float64)


def _part(value: Any, rows: NDArray[np.int64]) -> Any:
    if isinstance(value, Mapping):
        return {key: _part(each, rows) for key, each in value.items()}
    return value[rows] if isinstance(value, np.ndarray) else value


def _arrays(value: Any) -> Iterator[Array]:
    if isinstance(value, Mapping):
        for each in value.values():
            yield from _arrays(each)
    elif isinstance(value, np.ndarray):
        yield value


def _columns(value: Any, rows: NDArray[np.int64], run: Run, keys: frozenset[str]) -> Any:
    if isinstance(value, Mapping):
        return {key: _columns(each, rows, run, keys) for key, each in value.items()}
    return _lists(value[rows], run, keys) if isinstance(value, np.ndarray) else value


def _lists(values: Array, run: Run, keys: frozenset[str]) -> Any:
    """Lists of columns, as deep as the array has axes besides that of the samples."""
    if values.ndim == 1:
        return Column(values, run, keys)
    return [_lists(values[:, i], run, keys) for i in range(values.shape[1])]
