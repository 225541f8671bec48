"""Tables of n stands that differ in numbers: made of arrays over the keys of the stand file, prepared by the C."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import status_words
from mahovik.core.program.arrays import fill_record
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.read import read
from mahovik.core.stand.structure import structure
from mahovik.core.toolchain.block import LANES
from mahovik.core.toolchain.compiled import CompiledLibrary, lower_structure
from mahovik.errors import InputError, StandError, UsageError
from mahovik.out.api.stands import Stand
from mahovik.out.api.variants import Samples, Variants, change_values, variants

PLACE_OF_HOLD = ("pivot", "position", "angles")
"""Keys of a hold that say where it holds the carrier."""

_ALIGNMENT = 64

Blocks = Mapping[str, NDArray[Any]]
"""Memory by argument of the C."""

Prepare = Callable[[bool], tuple[Blocks, NDArray[np.int32]]]
"""Makes the blocks of tables, with mountings or without; and statuses."""


class Tables:
    """Prepared numbers of n stands of one structure, for the functions of the model that made them.

    Attributes: `base`, the stand that all differ from; `samples`, by path the values that differ; `real`, as that of
    the model.
    """

    def __init__(self, made_of: CoreStand, real: str, samples: Samples, variants: Variants, prepare: Prepare) -> None:
        """`found`: the numbers of all samples; `prepare`: makes the blocks. Raises StandError."""
        self.made_of, self.base, self.real, self.samples = made_of, Stand.of(made_of), real, samples
        self._found, self._prepare = variants, prepare
        self._blocks, _ = prepare(False)

    def __len__(self) -> int:
        """How many stands."""
        return self.samples.n

    def block(self, argument: str) -> NDArray[Any]:
        """The tables as the C reads them; mountings are made where they are asked for first."""
        if argument not in self._blocks:
            self._blocks, _ = self._prepare(True)
        return self._blocks[argument]

    def laws(self) -> dict[str, Any]:
        """Numbers of the laws between E0 and the carrier, by member of a table, with the samples last."""
        from mahovik.core.lower.values import columns, law_struct, reals

        layout, _program = lower_structure(structure(self.made_of), self.real)
        varied = iter(self._found.varied)
        for _ in reals(layout.parameters, self._found.parameters):
            next(varied)
        return columns(law_struct(layout), self._found.table, varied, len(self))

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


def make_tables(
    of: CoreStand,
    made: CompiledLibrary,
    real: str,
    element: np.dtype[Any],
    threads: int,
    changes: Mapping[str, Any],
    n: int | None,
) -> Tables:
    """See `Model.tables`."""
    stand, samples = Stand.of(of), Samples.of(changes, n)
    _refuse_numbers_of_holds(stand, samples)
    tables = variants(stand, real, samples)
    for number in np.flatnonzero(tables.doubtful):
        check_sample(stand, samples, int(number))

    def prepare(mountings: bool) -> tuple[Blocks, NDArray[np.int32]]:
        blocks, status = prepare_tables(made, element, threads, tables, samples.n, mountings)
        refused = np.flatnonzero(status < 0)
        if refused.size:
            first = int(refused[0])
            check_sample(stand, samples, first)
            name = status_words(int(status[first]))
            raise StandError([f"{stand.name}, sample {first}: refused by prepare: {name}"])
        return blocks, status

    return Tables(of, real, samples, tables, prepare)


def check_sample(stand: Stand, samples: Samples, number: int) -> None:
    """Read the stand of one sample as a stand file is read. Raises StandError, UsageError."""
    read(change_values(stand, samples.values(number)), f"{stand.name}, sample {number}")


def prepare_tables(
    made: CompiledLibrary, element: np.dtype[Any], threads: int, variants: Variants, n: int, mountings: bool
) -> tuple[Blocks, NDArray[np.int32]]:
    """Tables by argument of the C, with `mountings` these too where there are flywheels; and statuses."""
    lanes = LANES[element.itemsize]
    names = [name for name in made.tables if mountings or name != "mounting"]
    blocks = {name: _aligned_memory(made.of_tables.block_bytes(name == "mounting") * -(-n // lanes)) for name in names}
    status = np.zeros(n, dtype=np.int32)
    if n:
        arguments, _columns = prepare_arguments(made, element, variants, blocks)
        made.of_tables.call("prepare", n, arguments, status, threads)
    return blocks, status


def prepare_arguments(
    made: CompiledLibrary, element: np.dtype[Any], variants: Variants, blocks: Blocks
) -> tuple[list[NDArray[Any]], list[NDArray[Any]]]:
    """The arguments of `prepare` of n stands, and the columns whose addresses they have."""
    columns = [np.zeros(0) if x is None else np.ascontiguousarray(x, dtype=element) for x in variants.varied]
    addresses: NDArray[np.uintp] = np.array([x.ctypes.data if x.size else 0 for x in columns], dtype=np.uintp)
    parameters = fill_record(made.parameters, element, variants.parameters)
    table = fill_record(made.records["table"], element, variants.table)
    none = np.zeros(0)
    arguments = [parameters, table, addresses, *(blocks.get(name, none) for name in made.tables)]
    return arguments, columns


def _aligned_memory(size: int) -> NDArray[np.uint8]:
    """Memory as the registers of the processor read it best, and the C demands it."""
    memory = np.zeros(size + _ALIGNMENT, dtype=np.uint8)
    start = -memory.ctypes.data % _ALIGNMENT
    return memory[start : start + size]
