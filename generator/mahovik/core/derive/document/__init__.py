"""The derivation as a document: sections of text and equations, independent of how they are printed.

A part of an equation is a SymPy object, or text in the notation of docs/model.md: `K_s = L_s Theta_s L_s^T`,
`<a>` for the cross-product matrix, `{E, 0; <O>, E}` for blocks, `dot(phi)` for rates, `sum_s` for sums. Inside
running text such notation stands between backticks.
"""

import sympy as sp

from mahovik.core.derive.document import carrier, factors, flywheel, generalized
from mahovik.core.derive.document.parts import Block, Formula, Part, Section, Table, Text

__all__ = ["Block", "Formula", "Part", "Section", "Table", "Text", "sections"]


def sections(sequence: str, *, added_mass: bool, weight: sp.Matrix | None, displaces: bool) -> tuple[Section, ...]:
    """All sections as one reads them: of an attitude sequence, with added mass, weight and buoyancy or without.

    `weight`: that of all bodies, as the law derives it; None without gravity.
    """
    return (
        factors.factors(),
        flywheel.literal_terms(),
        flywheel.harmonics(),
        flywheel.row_at_a_phase(),
        carrier.equation(added_mass, weight, displaces),
        carrier.solution(added_mass),
        generalized.generalized(sequence),
    )
