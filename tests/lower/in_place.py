"""Very many steps of the C, called in place: a state is not read between them."""

from __future__ import annotations

from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.stand.model import State
from mahovik.errors import StateError
from mahovik.proof.verify.c_backend import CBackend


def end_of_steps(
    backend: CBackend, function: str, state: State, time: float, steps: int, order: int = 2, carried: bool = False
) -> dict[str, Any]:
    """The state after equal steps, by a function, with a carry or without. Raises StateError."""
    ffi, name = backend.library.ffi, backend.program.name
    values = backend.arguments(state)
    x = ffi.new(f"{name}_state *", values["x"])
    known: dict[str, Any] = {
        "table": values["table"],
        "x": x,
        "tau": ffi.new(f"{name}_real[]", [*values["tau"], 0.0]),
        "phi_ddot": ffi.new(f"{name}_real[]", [*values["phi_ddot"], 0.0]),
        "wrench": ffi.new(f"{name}_real[]", [*values["wrench"], 0.0]),
        "locked": ffi.new("int[]", len(state.phi) + 1),
        "dt": time / steps,
        "order": order,
        "carry": ffi.new(f"{name}_step_carry *") if carried else ffi.NULL,
        "next": x,
    }
    arguments = [known[a.name] for a in backend.program.function(function).arguments]
    call = backend.library.function(function)
    for _ in range(steps):
        status = call(*arguments)
        if status < 0:
            raise StateError(f"{function} refused with status {status_words(status)}")
    return {f.name: np.array(list(getattr(x, f.name)), dtype=np.float64) for f in backend.layout.state.fields}
