"""The derivation as a document: sections of text and equations, with no idea of how they are printed.

A part of an equation is a SymPy object, or text in the notation of docs/model.md: `K_s = L_s Theta_s L_s^T`,
`<a>` for the cross-product matrix, `{E, 0; <O>, E}` for blocks, `dot(phi)` for rates, `sum_s` for sums. Inside
running text such notation stands between backticks.
"""

from mahovik.core.derive.document.parts import Block, Formula, Part, Section, Table, Text
from mahovik.core.derive.document.sections import sections

__all__ = ["Block", "Formula", "Part", "Section", "Table", "Text", "sections"]
