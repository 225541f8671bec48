"""Names of hydrodynamic derivatives, for the search for wrong terms."""

from __future__ import annotations

from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Body
from mahovik.laws.damping.data import Damping


def coefficients(body: Body, _: float) -> dict[str, float]:
    """Hydrodynamic derivatives of a body by their names, `X_u`, `N_|r|r`, SI: factors of products in its wrench."""
    damping = body.law(Damping)
    if damping is None:
        return {}
    found: dict[str, float] = {}
    for matrix, spelling in ((damping.linear, "{}"), (damping.quadratic, "|{0}|{0}")):
        for row, letter in zip(matrix or (), WRENCH_LETTERS, strict=False):
            found |= {f"{letter}_{spelling.format(v)}": -x for x, v in zip(row, TWIST_LETTERS, strict=True)}
    for term in damping.terms:
        found[f"{WRENCH_LETTERS[term.wrench]}_{''.join(factor.letter for factor in term.of)}"] = term.value
    return found
