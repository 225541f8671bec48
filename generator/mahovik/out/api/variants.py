"""Numbers of n stands of one structure, by path of the stand file, read together: columns where they differ."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.core.program.interpret import Interpreter, plain
from mahovik.core.stand.columns import Column, Run
from mahovik.core.stand.columns import numbers as numbers_of
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.numbers import put
from mahovik.core.stand.read import read
from mahovik.core.stand.screening import doubtful_samples
from mahovik.core.stand.structure import structure
from mahovik.core.stand.units import show
from mahovik.core.toolchain.compiled import lower_structure
from mahovik.errors import InputError, StandError, UsageError
from mahovik.out.api.inputs import is_count
from mahovik.out.api.stands import Stand

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Samples:
    """Values of n samples by path: an array with the samples first, a mapping with such an array, or one for all."""

    changes: Mapping[str, Any]
    n: int

    @staticmethod
    def of(changes: Mapping[str, Any], n: int | None) -> Samples:
        """The values of a caller, checked for their shapes. Raises InputError."""
        if not isinstance(changes, Mapping):
            raise InputError(f"tables: expected a mapping from paths to arrays, found {type(changes).__name__}")
        values = {str(path): _value(str(path), value) for path, value in changes.items()}
        sizes: dict[str, int] = {}
        if n is not None:
            if not is_count(n):
                raise InputError(f"tables: n: expected a number of samples, found {n!r:.40}")
            sizes["n"] = int(n)
        for path, value in values.items():
            _with_arrays(value, lambda array, path=path: sizes.update({path: len(array)}))
        if len(set(sizes.values())) > 1:
            counts = ", ".join(f"{name} {size}" for name, size in sizes.items())
            raise InputError(f"tables: different numbers of samples: {counts}")
        if not sizes:
            raise InputError("tables: no array of samples is given; expected one, or n")
        return Samples(values, next(iter(sizes.values())))

    def _changed(self, change: Callable[[Array], Any]) -> dict[str, Any]:
        return {path: _with_arrays(value, change) for path, value in self.changes.items()}

    def values(self, number: int) -> dict[str, Any]:
        """The values of one sample by path."""
        return self._changed(lambda array: array[number].tolist())

    def part(self, rows: NDArray[np.int64]) -> Samples:
        """Some of the samples, by their numbers."""
        return Samples(self._changed(lambda array: array[rows]), len(rows))

    def columns(self, rows: NDArray[np.int64], run: Run) -> dict[str, Any]:
        """The values of some samples by path, columns in the place of numbers."""
        return {
            path: _with_arrays(value, lambda array, path=path: _lists(array[rows], run, frozenset((path,))))
            for path, value in self.changes.items()
        }


def _with_arrays(value: Any, change: Callable[..., Any]) -> Any:
    """The value with its arrays changed, those in mappings too."""
    if isinstance(value, Mapping):
        return {key: _with_arrays(part, change) for key, part in value.items()}
    return change(value) if isinstance(value, np.ndarray) else value


def _value(path: str, value: Any) -> Any:
    """A value with its numbers of samples as an array of floats. Raises InputError."""
    if isinstance(value, Mapping):
        return {str(key): _value(path, part) for key, part in value.items()}
    if isinstance(value, str | int | float | bool | None) or not hasattr(value, "__len__"):
        return value
    try:
        result = np.asarray(value)
    except (ValueError, TypeError):
        result = np.array(None)
    if result.dtype.kind not in "iuf" or result.ndim == 0:
        raise InputError(f"tables: {path}: expected an array of numbers, one of each sample, found {show(value)}")
    return np.asarray(result, dtype=np.float64)


def _lists(values: Array, run: Run, keys: frozenset[str]) -> Any:
    """Lists of columns, as deep as the array has axes besides that of the samples."""
    if values.ndim == 1:
        return Column(values, run, keys)
    return [_lists(values[:, i], run, keys) for i in range(values.shape[1])]


@dataclass
class Variants:
    """What `prepare_batch` takes.

    parameters  of a stand, where its numbers are the same for all
    table       its laws, likewise
    varied      for each number of both an array of all samples; None where all have the same
    doubtful    samples that only their own stand file shows to be in order
    """

    parameters: dict[str, Any]
    table: dict[str, Any]
    varied: list[NDArray[Any] | None]
    doubtful: NDArray[np.bool_]


def variants(stand: Stand, real: str, samples: Samples, refused: dict[int, str] | None = None) -> Variants:
    """Read all samples; those that a decision parts from the first are read again, together.

    Raises StandError for a sample that cannot be read, UsageError, InputError. With `refused` a sample that cannot be
    read, or is of another structure, is noted there by number with the reason, and the others are read.
    """
    from mahovik.core.lower.values import variant

    wanted, n = structure(stand), samples.n
    layout, program = lower_structure(wanted, real)
    interpreter = Interpreter(program)
    whole: Variants | None = None
    same: list[Any] = []
    rows: NDArray[np.int64] = np.arange(n)
    while rows.size or whole is None:
        run = Run.of(len(rows))
        # of no sample at all the stand itself is read
        try:
            sampled, document = _read(stand, samples.columns(rows, run) if rows.size else {}, samples, rows)
            if structure(sampled) != wanted:
                raise UsageError(
                    f"{document}: is of another structure than {stand.name}: gravity, or the part of a law, is zero "
                    "there and not here, or the other way round; build a model of its own"
                )
        except (StandError, UsageError) as error:
            if refused is None or not rows.size:
                raise
            refused |= {int(i): reason_of(stand, samples, int(i), error) for i in rows[~run.diverged]}
            rows = rows[run.diverged]
            continue
        parameters, table, numbers = variant(sampled, layout, interpreter)
        unsure = doubtful_samples(sampled, len(rows))
        _check_acting(sampled, numbers)
        kept = ~run.diverged
        if whole is None:
            whole, same = (
                Variants(_first(parameters), _first(plain(table)), [None] * len(numbers), np.zeros(n, np.bool_)),
                numbers,
            )
        _merge(whole.varied, same, numbers, rows, kept, n)
        whole.doubtful[rows[kept]] = unsure[kept]
        rows = rows[run.diverged]
    return whole


def _read(stand: Stand, values: dict[str, Any], samples: Samples, rows: NDArray[np.int64]) -> tuple[CoreStand, str]:
    """The stand of samples, with columns; and the name of the first in messages.

    Where the first cannot be read the message is that of the reader of stand files.
    """
    name = f"{stand.name}, sample {rows[0]}" if rows.size else stand.name
    try:
        return read(change_values(stand, values), name, physics=False), name
    except (StandError, UsageError):
        if rows.size:
            read(change_values(stand, samples.values(int(rows[0]))), name)
        raise


def reason_of(stand: Stand, samples: Samples, number: int, error: Exception) -> str:
    """Why one sample cannot be, in one line, as the reader of stand files says it; else as `error` does."""
    try:
        read(change_values(stand, samples.values(number)), stand.name)
    except (StandError, UsageError) as first:
        error = first
    return first_reason(error, stand.name)


def first_reason(error: Exception, source: str) -> str:
    """The first line of a refusal, without the name of what is refused."""
    return str(error).splitlines()[0].removeprefix(f"{source}: ")


def change_values(stand: Stand, values: dict[str, Any]) -> dict[str, Any]:
    """The keys of a stand file with other values by path. Raises UsageError, StandError."""
    document = stand.to_dict()
    put(document, values)
    return document


def _check_acting(stand: CoreStand, numbers: list[Any]) -> None:
    """Refuse a number of the stand that is in no table, such as one of a motor."""
    acting = frozenset[str]().union(*(x.keys for x in numbers if isinstance(x, Column)))
    for x in numbers_of(stand):
        for path in sorted(x.keys - acting) if isinstance(x, Column) else ():
            raise UsageError(f"{path}: acts in no function that takes tables; expected a number of a body or a law")


def _merge(
    varied: list[NDArray[Any] | None],
    same: list[Any],
    numbers: list[Any],
    rows: NDArray[np.int64],
    kept: NDArray[np.bool_],
    n: int,
) -> None:
    """Put the numbers of some samples among those of all; `same`: those of the first that were read."""
    for i, x in enumerate(numbers):
        if isinstance(x, Column) and kept.all() and len(rows) == n:
            varied[i] = x.values
            continue
        array = varied[i]
        if array is None:
            if not isinstance(x, Column) and not isinstance(same[i], Column) and x == same[i]:
                continue
            array = varied[i] = np.full(n, _first(same[i]), dtype=np.float64)
        array[rows[kept]] = x.values[kept] if isinstance(x, Column) else x


def _first(value: Any) -> Any:
    """Plain data with the number of the first sample in place of a column."""
    if isinstance(value, Mapping):
        return {key: _first(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_first(part) for part in value]
    return value.values[0] if isinstance(value, Column) else value
