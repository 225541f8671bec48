"""A search for wrong terms never says that a whole equation is missing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

import mahovik
from mahovik.proof import reference
from mahovik.proof.diagnose.terms.search import TermSearch
from mahovik.proof.diagnose.terms.solvable import has_mass_matrix
from mahovik.proof.verify.states import Request


def test_an_equation_that_is_left_out_as_a_whole_has_no_name() -> None:
    """The error of any program is its K V* less the right-hand side: all terms of a short equation are no answer."""
    body = replace(mahovik.example("demo3"), flywheels=(), gravity=(0.0, 0.0, 0.0))

    def answers(request: Request) -> Mapping[str, Any]:
        V_dot = list(reference.evaluate(body, request.state, request.want).get("V_dot", ()))
        if V_dot:
            V_dot[0] = np.sin(3.0 * request.state.V[0])
        return {"V_dot": V_dot}

    result = TermSearch(body, wants=("forward",)).find(answers)
    assert not result.whole
    assert result.terms == ()


def test_a_row_without_inertia_has_no_acceleration() -> None:
    stand = mahovik.example("demo3")
    K = reference.pieces(stand, TermSearch(stand).requests[0].state).K
    mass = float(K[0, 0])
    assert has_mass_matrix(stand, [])
    assert has_mass_matrix(stand, [("X", "u_dot", -0.5 * mass), ("X", "v r", 100.0)])
    bare = replace(stand, flywheels=())
    K = reference.pieces(bare, TermSearch(bare).requests[0].state).K
    first = [("X", f"{letter}_dot", float(K[0, j])) for j, letter in enumerate("uvwpqr")]
    assert not has_mass_matrix(bare, first)
