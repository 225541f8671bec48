"""Formulas that the document writes in its own form equal those of the derivation."""

from __future__ import annotations

import pytest
import sympy as sp

from derive.exact import circle, remainders, trigonometric
from mahovik.core.derive import carrier, flywheel
from mahovik.core.derive.document import Formula, Section, sections
from mahovik.core.derive.document.carrier import velocity_matrix
from mahovik.core.derive.document.flywheel import in_mounting_axes
from mahovik.core.derive.screw import Phi, blocks
from mahovik.core.derive.symbols import matrix
from mahovik.laws.weight.derive import weight

c, s = sp.symbols("c s")
DOUBLE = {sp.Symbol("c2"): c * c - s * s, sp.Symbol("s2"): 2 * s * c}


def test_terms_in_mounting_axes_are_the_literal_ones() -> None:
    """K, K*, I, J for O = 0, R = E; K* without its factor phi', in the double phase."""
    w = flywheel.generic()
    own = flywheel.Generic(w.m, w.b, w.J, sp.zeros(3, 1), sp.eye(3), w.phi, w.phi_dot)
    literal, shown = flywheel.literal(own, carrier.V), in_mounting_axes()
    K_dot = shown.K_dot.xreplace(DOUBLE) * w.phi_dot
    for printed, form in ((literal.K, shown.K), (literal.K_dot, K_dot), (literal.I, shown.I), (literal.J, shown.J)):
        assert remainders(trigonometric(printed, w.phi) - form, circle(c, s)) == []


@pytest.mark.parametrize("added_mass", [False, True])
def test_velocity_matrix_is_9(added_mass: bool) -> None:
    """M = Phi K + K*, with B for the lower left block of K."""
    K = carrier.mass_matrix(added_mass)
    M = velocity_matrix(added_mass)
    if added_mass:
        B = matrix("B")
        K = blocks(K[:3, :3], B.T, B, K[3:, 3:])
    assert remainders(M - Phi(carrier.V) * K - carrier.mass_matrix_rate()) == []


@pytest.mark.parametrize("sequence", ["ship", "aircraft", "euler"])
def test_every_equation_of_8_to_11_is_there(sequence: str) -> None:
    """Equations are found by number, and no section is empty."""
    found: tuple[Section, ...] = sections(sequence, added_mass=True, weight=weight(True), displaces=True)
    numbers = {n for s in found for b in s.blocks if isinstance(b, Formula) for n in b.number.split(", ")}
    assert {"2", "4", "5", "6", "7", "8", "9", "10", "11"} <= numbers
    assert all(section.blocks for section in found)


def test_weight_is_written_only_where_there_is_any() -> None:
    """In free space (7) has no weight."""

    def formulas(given: sp.Matrix | None) -> int:
        found = sections("ship", added_mass=False, weight=given, displaces=False)
        return sum(isinstance(b, Formula) for section in found for b in section.blocks)

    assert formulas(weight(False)) == formulas(None) + 1
