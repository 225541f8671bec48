"""What a flywheel of given acceleration asks of the carrier, as a wrench on a carrier that has it locked."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.proof.verify.c_backend import CBackend
from mahovik.use.simulate.case import Array


class Reaction:
    """-sum I_s phi_s'' of (8) at the state `x`, which its owner moves; `place`: of the carrier's among the wrenches.

    `coupled` and `step` lock a flywheel at constant speed only. Its acceleration, where it is known, is in (8) a term
    without unknowns, and can stand on the side of F; the rows of other flywheels do not have it.
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
        """For these phi'' (N, rad/s2; zero where not given): force and moment about O1 in E1."""
        if self._call(*self._arguments) < 0:
            return np.zeros(6)  # a state out of its ranges: the step that follows refuses it as well
        return -(self._I @ accelerations)
