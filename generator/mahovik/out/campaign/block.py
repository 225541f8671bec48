"""Samples that are computed together: their memory, calls of the C with it, and which of them are refused."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import status_words
from mahovik.core.stand.model import Stand
from mahovik.out.api.compiled import COURSE, CompiledLibrary
from mahovik.out.api.tables import LANES, Tables
from mahovik.out.campaign.pose import Array

PER_BLOCK = LANES[8]
"""Samples of one block of tables."""

TABLES = ("table", "mounting")

RESULTS = {"forward": ("V_dot",), "coupled": ("V_dot", "phi_ddot"), "torque": ("tau",)}
"""Results that further functions take: they are put where these find them."""


class Block:
    """n samples from `first` of `tables`, a multiple of PER_BLOCK.

    given  memory of what the C takes, by argument: `x` (13 + 2 N, n), `phi_ddot`, `tau` (N, n), `V_dot` (6, n),
           `wrench` (6 W, n), `locked` (N), `dt`, `order`
    found  memory of results that nothing takes, by function
    status  of each sample the first negative status, or 0; `at` where it was, in words
    """

    def __init__(self, stand: Stand, made: CompiledLibrary, tables: Tables, first: int, n: int) -> None:
        self.stand, self.n, self.first, self._made, self._tables = stand, n, first, made, tables
        N, wrenches = len(stand.flywheels), 6 * len(made.inputs)
        self.given: dict[str, NDArray[Any]] = {
            "x": np.zeros((13 + 2 * N, n)),
            "phi_ddot": np.zeros((N, n)),
            "tau": np.zeros((N, n)),
            "V_dot": np.zeros((6, n)),
            "wrench": np.zeros((wrenches, n)),
            "locked": np.zeros(N, dtype=np.int32),
            "dt": np.zeros(1),
            "order": np.zeros(1, dtype=np.int32),
        }
        self.found: dict[str, Array] = {}
        self.status: NDArray[np.int32] = np.zeros(n, dtype=np.int32)
        self.at: list[str] = [""] * n
        self._now: NDArray[np.int32] = np.zeros(n, dtype=np.int32)
        self._calls: dict[str, Callable[[], int]] = {}

    @property
    def x(self) -> Array:
        """States (13 + 2 N, n)."""
        return self.given["x"]

    def has(self, function: str) -> bool:
        """Whether the stand has a function of the C."""
        return function in self._made.functions

    def call(self, function: str, t: float | None = None) -> None:
        """Call a function for all samples; those that it refuses are noted, at the time `t`."""
        call = self._calls.get(function)
        if call is None:
            call = self._calls[function] = self._prepare_call(function)
        if call() < 0:
            self.refuse(self._now, lambda _: "" if t is None else f"at t = {t:.6g} s ", function)

    def refuse(self, status: NDArray[np.int32], where: Callable[[int], str], function: str) -> None:
        """Note the samples with a negative status that have none yet."""
        for j in np.flatnonzero((status < 0) & (self.status >= 0)):
            self.status[j] = status[j]
            self.at[j] = f"{where(int(j))}{function}"

    def reason(self, j: int) -> str:
        """Why sample j is refused; "" where it is not."""
        if self.status[j] >= 0:
            return ""
        return f"{self.at[j]} returned {status_words(int(self.status[j]))}: the motion leaves its ranges"

    def course(self, rows: Mapping[str, NDArray[Any]]) -> Callable[[], int]:
        """A call of many steps under given speeds, which reads and writes `rows`: see the C."""
        names = ("phi", "phi_dot", "phi_ddot", "end_phi_ddot", "dt", "count")
        arrays: list[NDArray[Any]] = [self._table("table"), self.x, self.given["phi_ddot"]]
        arrays += [*(rows[name] for name in names)]
        arrays += [self.given["order"], *(rows[name] for name in ("stretches", "kept", "states", "V_dot", "refused"))]
        arrays.append(self._now)
        if self.given["wrench"].size:
            arrays += [self.given["wrench"], rows["wrench"], rows["end_wrench"]]
        if self.stand.hold is not None and self.stand.hold.freedoms:
            arrays.append(np.zeros((len(self.stand.hold.freedoms), self.n)))
        return self._made.of_tables.repeat_call(COURSE, self.n, arrays, rows["status"])

    def _table(self, name: str) -> NDArray[np.uint8]:
        size = self._made.of_tables.block_bytes(name == "mounting")
        begin = self.first // PER_BLOCK * size
        return self._tables.block(name)[begin : begin + -(-self.n // PER_BLOCK) * size]

    def _prepare_call(self, function: str) -> Callable[[], int]:
        arrays: list[NDArray[Any]] = []
        for a in self._made.functions[function].arguments:
            if a.name in TABLES:
                arrays.append(self._table(a.name))
            elif a.direction == "inout":
                arrays.append(np.empty(0))  # null: no carry
            elif a.name == "next":
                arrays.append(self.x)
            elif a.direction == "in" or a.name in RESULTS.get(function, ()):
                arrays.append(self.given[a.name])
            elif a.order == "components":
                self.found[function] = np.zeros((a.components, self.n))
                arrays.append(self.found[function])
            else:  # of a function without batch, state by state
                arrays.append(np.zeros((self.n, a.components)))
                self.found[function] = arrays[-1].T
        if not any(a.name in TABLES for a in self._made.functions[function].arguments):  # a clamped carrier's forward
            return self._made.library.repeat_call(function, self.n, arrays, self._now)
        return self._made.of_tables.repeat_call(f"{function}_of", self.n, arrays, self._now)

    def member(self, function: str, name: str) -> Array:
        """A member of the results of a function, a view with the samples last."""
        row = 0
        for m in self._made.functions[function].arguments[-1].members:
            if m.name == name:
                return self.found[function][row : row + m.numbers].reshape(*m.shape, self.n)
            row += m.numbers
        raise KeyError(name)
