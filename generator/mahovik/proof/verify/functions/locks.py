"""Judge of `coupled` with locks: the literal reference without the equations of the locked flywheels."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.hold import accelerations
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales.magnitudes import Magnitudes
from mahovik.proof.verify.scales.wants import coupled as coupled_scale


def lock_patterns(count: int, number: int) -> Array:
    """Pattern of locked flywheels (N, bool): every second, the others, all but one, all, in turn."""
    order = np.arange(count)
    patterns = (order % 2 == 0, order % 2 == 1, order != number % max(count, 1), order >= 0)
    return np.asarray(patterns[number % 4])


def rows_with_locks(case: Case, function: str = "coupled") -> Iterator[Check]:
    """V_dot and phi_ddot with some flywheels locked."""
    names = ("V_dot", "phi_ddot")
    row = Check(function, "V_dot, phi_ddot, with locks", case.bounds.default, case.bounds.floor)
    for number, (name, state) in enumerate(case.states):
        locked, at = lock_patterns(case.count, number), case.at(state)
        given = case.backend.arguments(state) | {"locked": [int(x) for x in locked]}
        scale = coupled_scale(Magnitudes(case.stand, state, at, case.bounds.cuts), locked)
        expected = dict(zip(names, accelerations(at, case.stand, np.array(state.tau), locked), strict=True))
        try:
            found = case.call(function, given)
        except StateError as error:
            row.refuse(error, name)
            continue
        for quantity in names:
            row.compare(found[quantity], expected[quantity], scale[quantity], f"{name}, {quantity}")
    yield row
