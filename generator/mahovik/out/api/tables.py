"""Tables of n stands that differ in numbers: made of arrays over the keys of the stand file, prepared by the C."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import status_words
from mahovik.core.program.arrays import filled
from mahovik.core.stand.model import Stand as CoreStand
from mahovik.core.stand.read import read
from mahovik.errors import InputError, StandError
from mahovik.out.api.compiled import Compiled
from mahovik.out.api.samples import Samples
from mahovik.out.api.stands import Stand
from mahovik.out.api.variants import Variants, changed, variants

LANES = {8: 8, 4: 16}
"""Stands side by side in a block, by the bytes of a real."""

_ALIGNMENT = 64


@dataclass(frozen=True, eq=False, repr=False)
class Tables:
    """Prepared numbers of n stands of one structure, for the functions of the model that made them.

    made_of   the stand of the model
    base      the same with the keys of its file: the stand that all differ from
    samples   by path the values that differ
    blocks    by argument of the C, as it reads them
    """

    made_of: CoreStand
    base: Stand
    real: str
    samples: Samples
    blocks: Mapping[str, NDArray[Any]]

    def __len__(self) -> int:
        """How many stands."""
        return self.samples.n

    def stand(self, number: int) -> Stand:
        """The stand of one sample, as `base.replace` makes it. Raises InputError."""
        n = len(self)
        if isinstance(number, bool) or not isinstance(number, int | np.integer) or not -n <= number < n:
            raise InputError(f"stand: expected a number from 0 to {n - 1}, found {number!r:.40}")
        return self.base.replace(self.samples.values(int(number) % n))

    def __repr__(self) -> str:
        names = list(self.samples.given)
        paths = ", ".join(names if len(names) <= 4 else [*names[:3], f"{len(names) - 3} more"]) or "nothing"
        return f"<Tables of {len(self)} stands {self.base.name}: {paths}; {self.real}>"


def make_tables(
    of: CoreStand,
    made: Compiled,
    real: str,
    element: np.dtype[Any],
    threads: int,
    changes: Mapping[str, Any],
    n: int | None,
) -> Tables:
    """See `Model.tables`."""
    stand, samples = Stand.of(of), Samples.of(changes, n)
    found = variants(stand, real, samples)
    for number in np.flatnonzero(found.doubtful):
        _check(stand, samples, int(number))
    blocks, status = _prepare(made, element, threads, found, samples.n)
    refused = np.flatnonzero(status < 0)
    if refused.size:
        first = int(refused[0])
        _check(stand, samples, first)
        raise StandError([f"{stand.name}, sample {first}: refused by prepare: {status_words(int(status[first]))}"])
    return Tables(of, stand, real, samples, blocks)


def _check(stand: Stand, samples: Samples, number: int) -> None:
    """Read the stand of one sample as a stand file is read. Raises StandError, UsageError."""
    read(changed(stand, samples.values(number)), f"{stand.name}, sample {number}")


def _prepare(
    made: Compiled, element: np.dtype[Any], threads: int, found: Variants, n: int
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int32]]:
    """Tables, and mountings where there are flywheels, by the C; and statuses."""
    lanes = LANES[element.itemsize]
    blocks = {name: _aligned(made.library.block_bytes(name == "mounting") * -(-n // lanes)) for name in made.tables}
    columns = [None if x is None else np.ascontiguousarray(x, dtype=element) for x in found.varied]
    addresses: NDArray[np.uintp] = np.array([0 if x is None else x.ctypes.data for x in columns], dtype=np.uintp)
    parameters = filled(made.parameters, element, found.parameters)
    table = filled(made.records["table"], element, found.table)
    status = np.zeros(n, dtype=np.int32)
    passed = [parameters, table, addresses, *(blocks[name] for name in made.tables)]
    if n:
        made.library.call("prepare", n, passed, status, threads)
    return blocks, status


def _aligned(size: int) -> NDArray[np.uint8]:
    """Memory as the registers of the processor read it best, and the C demands it."""
    memory = np.zeros(size + _ALIGNMENT, dtype=np.uint8)
    start = -memory.ctypes.data % _ALIGNMENT
    return memory[start : start + size]
