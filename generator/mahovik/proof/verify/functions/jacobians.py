"""Judges of the Jacobians: automatic differentiation of the second derivation."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mahovik.contract.functions import FUNCTIONS
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.second.evaluate import Derivatives
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.functions.locks import lock_patterns
from mahovik.proof.verify.scales import scales

STATES = 4
"""States at which a Jacobian is judged by automatic differentiation."""

STATES_WITH_LOCKS = 1
"""States at which it is judged with locks; each pattern needs a derivative of its own."""

CONDITION = 10.0
"""Accepted beyond the bound of the function itself: a derivative goes through K^-1 twice."""


def jacobian_rows(case: Case, function: str) -> Iterator[Check]:
    """All matrices of `forward_jacobian` or `coupled_jacobian`: the worst of them."""
    want = function.removesuffix("_jacobian")
    names = _matrices(case, function)
    by = tuple(dict.fromkeys(re.sub("^(V_dot|u_dot|phi_ddot)_", "", name) for name in names))
    row = Check(function, "derivatives", CONDITION * case.bounds.default, case.bounds.floor)
    derivatives = Derivatives(case.second, want, by)
    for name, state in case.states[:STATES]:
        try:
            found = case.call(function, case.backend.arguments(state))
        except StateError as error:
            row.refuse(error, name)
            continue
        try:
            expected, scale = derivatives.evaluate(state), derivative_scales(case, state, want, by)
        except StateError as error:
            row.skip(f"its judge refused: {error}", name)
            continue
        for quantity in names:
            row.compare(found[quantity], expected[quantity], scale[quantity], f"{name}, {quantity}")
    yield row
    if want == "coupled":
        yield _row_with_locks(case, names, by)


def _matrices(case: Case, function: str) -> tuple[str, ...]:
    """Names of the matrices; of a held carrier u stands in place of V."""
    names = FUNCTIONS[function].gives if case.count else ("V_dot_V",)
    if case.stand.hold is None:
        return names
    return tuple(re.sub("_V$", "_u", re.sub("^V_dot", "u_dot", name)) for name in names)


def _speeds(case: Case, state: State) -> Array:
    """The largest |u| of the freedoms of one kind, for each freedom: sliding, turning, or one of a basis."""
    assert case.stand.hold is not None
    kinds = [freedom.kind for freedom in case.stand.hold.freedoms]
    return np.array([max(abs(u) for u, other in zip(state.u, kinds, strict=True) if other == kind) for kind in kinds])


def derivative_scales(case: Case, state: State, want: str, by: Sequence[str]) -> dict[str, Array]:
    """Scale of an acceleration over the size of what it is differentiated by: the largest |v|, |omega|, |phi'| ..."""
    own = scales(case.stand, state, case.at(state), want, case.bounds.cuts)
    sizes: dict[str, Any] = {
        "u": None if case.stand.hold is None else _speeds(case, state),
        "V": np.repeat([np.abs(state.V[:3]).max(), np.abs(state.V[3:]).max()], 3),
        "phi": np.ones(case.count),
        "phi_dot": np.full(case.count, np.abs(state.phi_dot).max(initial=1e-9)),
        "phi_ddot": np.full(case.count, np.abs(state.phi_ddot).max(initial=1e-9)),
        "tau": np.full(case.count, np.abs(state.tau).max(initial=1e-9)),
    }
    return {f"{value}_{name}": np.divide.outer(own[value], sizes[name]) for value in own for name in by}


def _row_with_locks(case: Case, names: Sequence[str], by: Sequence[str]) -> Check:
    """All matrices of coupled_jacobian with locks: the worst of them."""
    row = Check("coupled_jacobian", "derivatives, with locks", CONDITION * case.bounds.default, case.bounds.floor)
    for number, (name, state) in enumerate(case.states[:STATES_WITH_LOCKS]):
        locked = lock_patterns(case.count, number)
        given = case.backend.arguments(state) | {"locked": [int(x) for x in locked]}
        try:
            found = case.call("coupled_jacobian", given)
        except StateError as error:
            row.refuse(error, name)
            continue
        try:
            expected = Derivatives(case.second, "coupled", by, list(locked)).evaluate(state)
        except StateError as error:
            row.skip(f"its judge refused: {error}", name)
            continue
        scale = derivative_scales(case, state, "coupled", by)
        for quantity in names:
            row.compare(found[quantity], expected[quantity], scale[quantity], f"{name}, {quantity}")
    return row
