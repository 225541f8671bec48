"""States that are computed together: their memory, calls of the C with it, and which of them are refused."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mahovik.contract.status import status_words
from mahovik.core.program.arrays import record
from mahovik.core.stand.model import Stand
from mahovik.core.toolchain.compiled import ArrayLibrary, CompiledLibrary

Array = NDArray[Any]

LANES = {8: 8, 4: 16}
"""Stands side by side in a block of tables, by the bytes of a real."""

PER_BLOCK = LANES[8]
"""Samples of one block of tables."""

TABLES = ("table", "mounting")

RESULTS = {"forward": ("V_dot",), "coupled": ("V_dot", "phi_ddot"), "torque": ("tau",)}
"""Results that further functions take: they are put where these find them."""


class Block:
    """n states with the numbers of the stand itself, or of stands that differ from it in numbers.

    tables  by argument of the C, tables of many stands; None: those of the library
    first   number of the first state among these stands, a multiple of all LANES
    given  memory of what the C takes, by argument: `x` (13 + 2 N, n), `phi_ddot`, `tau` (N, n), `V_dot` (6, n),
           `wrench` (6 W, n), `locked` (N), `dt`, `order`; with `carried` the `carry` of steps, a record a state
    found  memory of results that nothing takes, by function
    status  of each state the first negative status, or 0; `at` where it was, in words
    """

    def __init__(
        self,
        stand: Stand,
        made: CompiledLibrary,
        n: int,
        tables: Callable[[str], Array] | None = None,
        first: int = 0,
        carried: bool = False,
    ) -> None:
        self.stand, self.n, self.first, self._made, self._tables = stand, n, first, made, tables
        N, real = len(stand.flywheels), made.element
        self.given: dict[str, Array] = {
            "x": np.zeros((13 + 2 * N, n), real),
            "phi_ddot": np.zeros((N, n), real),
            "tau": np.zeros((N, n), real),
            "V_dot": np.zeros((6, n), real),
            "wrench": np.zeros((6 * len(made.inputs), n), real),
            "locked": np.zeros(N, dtype=np.int32),
            "dt": np.zeros(1, real),
            "order": np.zeros(1, dtype=np.int32),
        }
        self.given["next"] = self.given["x"]
        if carried:
            (carry,) = (a for a in made.functions["step"].arguments if a.name == "carry")
            self.given["carry"] = np.zeros(n, record(carry.members, real))
        self.found: dict[str, Array] = {}
        self.status: NDArray[np.int32] = np.zeros(n, dtype=np.int32)
        self.at: list[str] = [""] * n
        self._now: NDArray[np.int32] = np.zeros(n, dtype=np.int32)
        self._calls: dict[str, Callable[[], int]] = {}

    @property
    def x(self) -> Array:
        """States (13 + 2 N, n)."""
        return self.given["x"]

    @property
    def inputs(self) -> tuple[str, ...]:
        """Bodies that take a run-time wrench, in the order of `wrench`."""
        return self._made.inputs

    def has(self, function: str) -> bool:
        """Whether the stand has a function of the C."""
        return function in self._made.functions

    def run(self, function: str) -> int:
        """Call a function for all states; return the first negative status, else 0."""
        call = self._calls.get(function)
        if call is None:
            call = self._calls[function] = self._prepare_call(function)
        return call()

    def call(self, function: str, t: float | None = None) -> None:
        """Call a function for all states; those that it refuses are noted, at the time `t`."""
        if self.run(function) < 0:
            self.refuse(self._now, lambda _: "" if t is None else f"at t = {t:.6g} s ", function)

    def refuse(self, status: NDArray[np.int32], where: Callable[[int], str], function: str) -> None:
        """Note the states with a negative status that have none yet."""
        for j in np.flatnonzero((status < 0) & (self.status >= 0)):
            self.status[j] = status[j]
            self.at[j] = f"{where(int(j))}{function}"

    def reason(self, j: int) -> str:
        """Why state j is refused; "" where it is not."""
        if self.status[j] >= 0:
            return ""
        return f"{self.at[j]} returned {status_words(int(self.status[j]))}: the motion leaves its ranges"

    def _table(self, name: str) -> Array:
        if self._tables is None:
            return self._made.tables[name]
        size = self._made.of_tables.block_bytes(name == "mounting")
        lanes = LANES[self._made.element.itemsize]
        begin = self.first // lanes * size
        return self._tables(name)[begin : begin + -(-self.n // lanes) * size]

    def _prepare_call(self, function: str) -> Callable[[], int]:
        library, name, arrays = self._arranged(function)
        return library.repeat_call(name, self.n, arrays, self._now)

    def address(self, function: str) -> tuple[int, list[Array]]:
        """Where the machine code of a function lies, and what is passed to it with this memory."""
        library, name, arrays = self._arranged(function)
        return library.address(name), arrays

    def _arranged(self, function: str) -> tuple[ArrayLibrary, str, list[Array]]:
        """The library of a function, its name there, and what is passed to it."""
        taken = [a.name for a in self._made.functions[function].arguments]
        tables = {name: self._table(name) for name in TABLES if name in taken}
        results = {name: self.given[name] for name in ("next", *RESULTS.get(function, ())) if name in self.given}
        arrays, made = self._made.arrange(function, self.n, self.given | tables, results)
        for a, memory in made:
            if a.direction == "out" and a.name not in results:
                memory.view(np.uint8)[...] = 0  # what a refused state leaves is a number
                of_states = memory.view(self._made.element).reshape(self.n, -1).T  # of a function without batch
                self.found[function] = memory if a.order == "components" else of_states
        if self._tables is None or not tables:  # a clamped carrier's forward
            return self._made.library, function, arrays
        return self._made.of_tables, f"{function}_of", arrays

    def member(self, function: str, name: str) -> Array:
        """A member of the results of a function, a view with the states last."""
        row = 0
        for m in self._made.functions[function].arguments[-1].members:
            if m.name == name:
                return self.found[function][row : row + m.numbers].reshape(*m.shape, self.n)
            row += m.numbers
        raise KeyError(name)
