"""Tables of n stands of one structure: arrays over the keys of the stand file, read together, prepared by the C."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import status_words
from mahovik.core.program.arrays import fill_record
from mahovik.core.program.interpret import Interpreter, plain
from mahovik.core.stand.columns import Column, Run, of_sample
from mahovik.core.stand.columns import numbers as numbers_of
from mahovik.core.stand.hold import PLACE_OF_HOLD
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.numbers import put
from mahovik.core.stand.physical import doubtful_samples
from mahovik.core.stand.stand_file import read
from mahovik.core.stand.structure import structure
from mahovik.core.stand.units import show
from mahovik.core.toolchain.compiled import LANES, CompiledLibrary, Motors, lower_structure
from mahovik.errors import InputError, StandError, UsageError
from mahovik.out.api.inputs import is_count
from mahovik.out.api.stands import Stand

Array = NDArray[np.float64]

_ALIGNMENT = 64


class Tables:
    """Prepared numbers of n stands of one structure, for the functions of the model that made them.

    Attributes: `base`, the stand that all differ from; `samples`, by path the values that differ; `real`, as that of
    the model.
    """

    def __init__(self, made: CompiledLibrary, threads: int, changes: Mapping[str, Any], n: int | None) -> None:
        """Prepares tables of the stand that `made` was compiled for, with `changes` by path, of `n` samples.

        `Model.tables` says what changes may be. Raises InputError, StandError, UsageError.
        """
        self._made, self._threads = made, threads
        self.made_of, self.real = made.source.stand, made.source.real
        self.base, self.samples = Stand.of(self.made_of), Samples.of(changes, n)
        _refuse_numbers_of_holds(self.base, self.samples)
        self._variants = variants(self.base, self.real, self.samples)
        for number in np.flatnonzero(self._variants.doubtful):
            check_sample(self.base, self.samples, int(number))
        self.motors = self._variants.motors
        self._blocks = self._prepared(mountings=False)

    def __len__(self) -> int:
        """How many stands."""
        return self.samples.n

    def block(self, argument: str) -> NDArray[Any]:
        """The tables as the C reads them; mountings are made where they are asked for first."""
        if argument not in self._blocks:
            self._blocks = self._prepared(mountings=True)
        return self._blocks[argument]

    def _prepared(self, mountings: bool) -> dict[str, NDArray[Any]]:
        """Memory by argument of the C, with `mountings` these too where there are flywheels. Raises StandError."""
        made, n, none = self._made, len(self), np.zeros(0)
        names = [name for name in made.tables if mountings or name != "mounting"]
        count, status = -(-n // LANES[made.element.itemsize]), np.zeros(n, dtype=np.int32)
        blocks = {name: _aligned_memory(made.of_tables.block_bytes(name == "mounting") * count) for name in names}
        varied = [none if x is None else np.ascontiguousarray(x, dtype=made.element) for x in self._variants.varied]
        addresses: NDArray[np.uintp] = np.array([x.ctypes.data if x.size else 0 for x in varied], dtype=np.uintp)
        parameters = fill_record(made.parameters, made.element, self._variants.parameters)
        table = fill_record(made.records["table"], made.element, self._variants.table)
        arguments = [parameters, table, addresses, *(blocks.get(name, none) for name in made.tables)]
        if n and made.of_tables.call("prepare", n, arguments, status, self._threads) < 0:
            first = int(np.flatnonzero(status < 0)[0])
            check_sample(self.base, self.samples, first)
            words = status_words(int(status[first]))
            raise StandError([f"{self.base.name}, sample {first}: refused by prepare: {words}"])
        return blocks

    def laws(self) -> dict[str, Any]:
        """Numbers of the laws between E0 and the carrier, by member of a table, with the samples last."""
        from mahovik.core.lower.values import columns, law_struct, reals

        layout, _program = lower_structure(structure(self.made_of), self.real)
        varied = iter(self._variants.varied)
        for _ in reals(layout.parameters, self._variants.parameters):
            next(varied)
        return columns(law_struct(layout), self._variants.table, varied, len(self))

    def part(self, rows: NDArray[np.int64]) -> Tables:
        """Tables of some of the stands, by their numbers."""
        return Tables(self._made, self._threads, self.samples.part(rows).changes, len(rows))

    def stand(self, number: int) -> Stand:
        """The stand of one sample, as `base.replace` makes it. Raises InputError."""
        n = len(self)
        if isinstance(number, bool) or not isinstance(number, int | np.integer) or not -n <= number < n:
            raise InputError(f"stand: expected a number from 0 to {n - 1}, found {number!r:.40}")
        return self.base.replace(self.samples.values(int(number) % n))

    def __repr__(self) -> str:
        names = list(self.samples.changes)
        paths = ", ".join(names if len(names) <= 4 else [*names[:3], f"{len(names) - 3} more"]) or "nothing"
        return f"<Tables of {len(self)} stands {self.base.name}: {paths}; {self.real}>"


def _refuse_numbers_of_holds(stand: Stand, samples: Samples) -> None:
    """UsageError: a sample would move along other freedoms. Place, friction and stops of a hold may vary."""
    if stand.hold is None or any(body.name == "hold" for body in stand.bodies):
        return
    for path in samples.changes:
        keys = path.replace("[", ".").split(".")
        if keys[0] == "hold" and not {*keys[1:2]} & {*PLACE_OF_HOLD, "friction", "stop"}:
            raise UsageError(
                f"{path}: decides how the carrier can move, the same for all samples; make a model of each"
            )


def check_sample(stand: Stand, samples: Samples, number: int) -> None:
    """Read the stand of one sample as a stand file is read. Raises StandError, UsageError."""
    read(change_values(stand, samples.values(number)), f"{stand.name}, sample {number}")


def _aligned_memory(size: int) -> NDArray[np.uint8]:
    """Memory as the registers of the processor read it best, and the C demands it."""
    memory = np.zeros(size + _ALIGNMENT, dtype=np.uint8)
    start = -memory.ctypes.data % _ALIGNMENT
    return memory[start : start + size]


# -- reading the samples -----------------------------------------------------------------------------------------------


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


@dataclass(frozen=True)
class Variants:
    """What `prepare_batch` takes.

    parameters  of a stand, where its numbers are the same for all
    table       its laws, likewise
    varied      for each number of both an array of all samples; None where all have the same
    doubtful    samples that only their own stand file shows to be in order
    motors      of the flywheels of each sample; None: those of the stand
    """

    parameters: dict[str, Any]
    table: dict[str, Any]
    varied: list[NDArray[Any] | None]
    doubtful: NDArray[np.bool_]
    motors: Sequence[Motors] | None


def variants(stand: Stand, real: str, samples: Samples) -> Variants:
    """Read all samples; those that a decision parts from the first are read again, together.

    Raises StandError for a sample that cannot be read, UsageError, InputError.
    """
    from mahovik.core.lower.values import variant

    wanted, n = structure(stand), samples.n
    layout, program = lower_structure(wanted, real)
    interpreter, doubtful = Interpreter(program), np.zeros(n, dtype=np.bool_)
    parameters: dict[str, Any] = {}
    table: dict[str, Any] = {}
    nominal: Motors = tuple(wheel.motor for wheel in stand.flywheels)
    motors = [nominal] * n
    readings: list[tuple[NDArray[np.int64], NDArray[np.bool_], list[Any]]] = []
    rows: NDArray[np.int64] = np.arange(n)
    while rows.size or not readings:
        run = Run(len(rows))
        # of no sample at all the stand itself is read
        sampled, document = _read(stand, samples.columns(rows, run) if rows.size else {}, samples, rows)
        if replace(structure(sampled), motor_points=wanted.motor_points) != wanted:
            raise UsageError(
                f"{document}: is of another structure than {stand.name}: gravity, or the part of a law, is zero "
                "there and not here, or the other way round; build a model of its own"
            )
        of_body, of_laws, numbers = variant(sampled, layout, interpreter)
        if not readings:
            parameters, table = _first(of_body), _first(plain(of_laws))
        unsure = doubtful_samples(sampled, len(rows))
        _check_acting(sampled, numbers)
        kept = ~run.diverged
        doubtful[rows[kept]] = unsure[kept]
        of_motors = tuple(wheel.motor for wheel in sampled.flywheels)
        if any(isinstance(x, Column) for x in numbers_of(of_motors)) or of_motors != nominal:
            for k in np.flatnonzero(kept).tolist():
                motors[rows[k]] = of_sample(of_motors, k)
        readings.append((rows[kept], kept, numbers))
        rows = rows[run.diverged]
    varied = [_varied([(at, kept, numbers[i]) for at, kept, numbers in readings], n) for i in range(len(numbers))]
    return Variants(parameters, table, varied, doubtful, motors if any(of is not nominal for of in motors) else None)


def _varied(readings: Sequence[tuple[NDArray[np.int64], NDArray[np.bool_], Any]], n: int) -> Array | None:
    """One number of all samples, of the samples of each reading; None where all have the same."""
    first = readings[0][2]
    if not any(isinstance(x, Column) or x != first for _, _, x in readings):
        return None
    result = np.zeros(n)
    for rows, kept, x in readings:
        result[rows] = x.values[kept] if isinstance(x, Column) else x
    return result


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


def first_reason(error: Exception, source: str) -> str:
    """The first line of a refusal, without the name of what is refused."""
    return str(error).splitlines()[0].removeprefix(f"{source}: ")


def change_values(stand: Stand, values: dict[str, Any]) -> dict[str, Any]:
    """The keys of a stand file with other values by path. Raises UsageError, StandError."""
    document = stand.to_dict()
    put(document, values)
    return document


def _check_acting(stand: CoreStand, numbers: list[Any]) -> None:
    """Refuse a number of the stand that is in no table, decides no torque of a motor and no state of a held carrier."""
    motors = [replace(s.motor, constant=None, resistance=None, supply=None) for s in stand.flywheels if s.motor]
    beside = numbers_of((*motors, stand.hold))
    acting = frozenset[str]().union(*(x.keys for x in (*numbers, *beside) if isinstance(x, Column)))
    for x in numbers_of(stand):
        for path in sorted(x.keys - acting) if isinstance(x, Column) else ():
            raise UsageError(f"{path}: acts in no function that takes tables; expected a number of a body or a law")


def _first(value: Any) -> Any:
    """Plain data with the number of the first sample in place of a column."""
    if isinstance(value, Mapping):
        return {key: _first(part) for key, part in value.items()}
    if isinstance(value, list | tuple):
        return [_first(part) for part in value]
    return value.values[0] if isinstance(value, Column) else value
