"""Judge of the steps with a carry: the reference integrated by SciPy, over few steps and over very many short ones."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np

from mahovik.contract.status import status_words
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.functions.coarse import coarse_row
from mahovik.proof.verify.functions.steps import AGREEMENT, SHORTER, Motion

SHORT_STEPS = {"double": 10_000, "float": 100_000}
"""Short steps of order 2 in a motion that 32 steps follow: in float most increments are below the last place."""

AFTER_SHORT_STEPS = {"double": 1e-10, "float": 4e-6}
"""Accepted after them, relative to state and change. In float the rates themselves are good to 1e-6 of their terms;
without a carry the difference is 1e-4 to 1e-2."""


def carried_rows(case: Case, function: str) -> Iterator[Check]:
    """Agreement of a motion in some steps of order 4, and in a great number of short steps of order 2."""
    few = Check(function, "state at the end of a motion", AGREEMENT[case.real])
    many = Check(function, "likewise, in very many steps", AFTER_SHORT_STEPS[case.real])
    for name, state in case.states:
        if few.states and many.states:
            break
        motion = Motion(case, function, state, None)
        try:
            off = motion.first(SHORTER, motion.least_error)
            if off is not None:
                few.note(off, name)
            off = motion.first(SHORTER, partial(_error, case, function, motion, state))
            if off is not None:
                many.note(off, name)
        except StateError as error:
            few.refuse(error, name)
    yield few
    yield many
    yield coarse_row(case, function)


def _error(case: Case, function: str, motion: Motion, state: State, time: float) -> float:
    """Difference of the ends of a motion in very many steps."""
    return motion.difference(end_of_steps(case.backend, function, state, time, SHORT_STEPS[case.real]), time)


def end_of_steps(
    backend: CBackend, function: str, state: State, time: float, steps: int, order: int = 2
) -> dict[str, Any]:
    """The state after equal steps, called in place: a state is not read between them. Raises StateError."""
    ffi, name = backend.library.ffi, backend.program.name
    given = backend.arguments(state)
    x = ffi.new(f"{name}_state *", given["x"])
    known: dict[str, Any] = {
        "table": given["table"],
        "x": x,
        "tau": ffi.new(f"{name}_real[]", [*given["tau"], 0.0]),
        "phi_ddot": ffi.new(f"{name}_real[]", [*given["phi_ddot"], 0.0]),
        "wrench": ffi.new(f"{name}_real[]", [*given["wrench"], 0.0]),
        "locked": ffi.new("int[]", len(state.phi) + 1),
        "dt": time / steps,
        "order": order,
        "carry": ffi.new(f"{name}_step_carry *"),
        "next": x,
    }
    arguments = [known[a.name] for a in backend.program.function(function).arguments]
    call = backend.library.function(function)
    for _ in range(steps):
        status = call(*arguments)
        if status < 0:
            raise StateError(f"{function} refused with status {status_words(status)}")
    return {f.name: np.array(list(getattr(x, f.name)), dtype=np.float64) for f in backend.layout.state.fields}
