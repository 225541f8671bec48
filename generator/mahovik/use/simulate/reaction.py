"""Reaction of a flywheel with given acceleration, as a wrench on a carrier that has it locked."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.proof.verify.c_backend import CBackend
from mahovik.use.simulate.case import Array


class Reaction:
    """-sum I_s phi_s'' of (8) at the state `x`, which its owner updates; `place`: index of the carrier's wrench.

    `coupled` and `step` lock a flywheel at constant speed only. A known acceleration is a term
    without unknowns in (8) and can be added to F; it does not appear in the rows of other flywheels.
    """

    def __init__(self, c: CBackend, x: Any) -> None:
        ffi = c.library.ffi
        function = c.program.function("matrices")
        self._call = c.library.function("matrices")
        self._out = ffi.new(f"{c.program.name}_matrices_result *")
        self._I = np.frombuffer(ffi.buffer(ffi.addressof(self._out, "I")), dtype=np.float64).reshape(6, -1)
        zero = ffi.new(f"{c.program.name}_real[]", 6 * max(len(c.inputs), 1))
        known = {"table": c.library.default("default"), "x": x, "wrench": zero, "out": self._out}
        self._arguments = [known[a.name] for a in function.arguments]
        first = 6 * c.inputs.index("carrier")
        self.place = slice(first, first + 6)

    def wrench(self, accelerations: Array) -> Array:
        """Force and moment about O1 in E1 for these phi'' (N, rad/s2; zero if not given)."""
        if self._call(*self._arguments) < 0:
            return np.zeros(6)  # if the state is out of range, the next step refuses it as well
        return -(self._I @ accelerations)
