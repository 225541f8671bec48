"""Response of flywheels to torque: d phi_ddot / d tau at the present state, by the generated C."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.proof.verify.c_backend import CBackend
from mahovik.use.simulate.case import Array


class Mobility:
    """d phi_ddot / d tau (N x N, 1/(kg m2)) at the state `x`, which its owner updates. Locked flywheels: zero."""

    def __init__(self, c: CBackend, x: Any, locked: list[int]) -> None:
        ffi = c.library.ffi
        function = c.program.function("coupled_jacobian")
        kind, N = f"{c.program.name}_real[]", len(locked)
        self._call = c.library.function("coupled_jacobian")
        self._out = ffi.new(f"{c.program.name}_coupled_jacobian_result *")
        view = np.frombuffer(ffi.buffer(ffi.addressof(self._out, "phi_ddot_tau")), dtype=np.float64)
        self._view = view.reshape(N, N)
        known = {
            "table": c.library.default("default"),
            "x": x,
            "tau": ffi.new(kind, N),
            "locked": ffi.new("int[]", locked),
            "wrench": ffi.new(kind, 6 * max(len(c.inputs), 1)),
            "out": self._out,
        }
        self._arguments = [known[a.name] for a in function.arguments]

    def matrix(self) -> Array:
        """Mobility matrix; unchanged if the state is out of range (the step that follows refuses it as well)."""
        self._call(*self._arguments)
        return np.abs(self._view)
