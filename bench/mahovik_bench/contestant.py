"""A contestant: one library of a program with the works it has, its records, calls and results in this process."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from mahovik.errors import ToolchainError
from mahovik_bench.build import Built, Effort, Recipe, tool
from mahovik_bench.cases import Array, Case
from mahovik_bench.works import WORKS, Work

NONE = Effort(0.0, 0.0)


@dataclass(frozen=True)
class Peer:
    """One build of a program for one case.

    `program` is whose it is, `build` how it was made; `model` is the file that `peer_setup` reads; `generation` what
    writing its code took; `counted`: callgrind can run it and its figures are shown; `timed`: its times are;
    `states`: of one call, which lie by component in its records and results where they are more than one.
    """

    program: str
    build: str
    works: tuple[str, ...]
    recipe: Recipe
    model: str = ""
    generation: Effort = NONE
    counted: bool = False
    timed: bool = True
    states: int = 1

    @property
    def name(self) -> str:
        """Name of the peer in tables."""
        return f"{self.program} {self.build}"


@cache
def harness() -> ctypes.CDLL:
    """native/harness.c, compiled and loaded."""
    loaded = ctypes.CDLL(str(tool("harness.c", "-shared", "-fPIC")))
    loaded.independent.restype = ctypes.c_double
    loaded.chained.restype = ctypes.c_double
    return loaded


def pointer(array: Array) -> Any:
    """A C array of doubles."""
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


class Contestant:
    """A peer with its records of the case's states."""

    def __init__(self, peer: Peer, built: Built, case: Case) -> None:
        self.peer, self.built, self.case = peer, built, case
        self._library = ctypes.CDLL(str(built.library))
        if self._library.peer_setup(peer.model.encode()) != 0:
            raise ToolchainError(f"{peer.name}: it refuses {peer.model}")
        self._size = int(self._library.peer_size())
        self._states = peer.states
        flat = np.ascontiguousarray(case.flat)
        if self._states > 1:  # one record of all states, again and again
            flat = np.resize(flat, (1, self._states * flat.shape[1]))
        self._records = np.zeros((len(flat), self._size))
        for row, record in zip(flat, self._records, strict=True):
            self._library.peer_pack(pointer(row), pointer(record))
        self._out = np.zeros(self._states * max(work.size(case.N) for work in WORKS.values()) + 64)

    @property
    def name(self) -> str:
        """Name of its peer."""
        return self.peer.name

    def results(self, work: Work) -> Array:
        """Results of the library, one row per state."""
        call = getattr(self._library, work.symbol)
        size = work.size(self.case.N)
        if self._states > 1:
            call(pointer(self._records[0]), pointer(self._out))
            return self._out[: size * self._states].reshape(size, self._states)[:, : len(self.case.states)].T.copy()
        rows = []
        for record in self._records:
            self._out[:] = np.nan
            call(pointer(record), pointer(self._out))
            rows.append(self._out[:size].copy())
        return np.array(rows)

    def block(self, work: Work, chained: bool) -> Callable[[int], float]:
        """Nanoseconds of a state in a block of that many calls."""
        call = getattr(self._library, work.symbol)
        records, out = pointer(self._records), pointer(self._out)
        counts = (self._size, len(self._records))
        timer = harness()
        V, phi, N = int(self._library.peer_V()), int(self._library.peer_phi()), self.case.N

        def once(calls: int) -> float:
            if chained:
                return float(timer.chained(call, records, *counts, calls, out, V, phi, N)) / self._states
            return float(timer.independent(call, records, *counts, calls, out)) / self._states

        return once
