"""All sections of the derivation, in the order in which one reads them."""

from __future__ import annotations

from mahovik.core.derive.document import carrier, factors, flywheel, generalized
from mahovik.core.derive.document.parts import Section


def sections(sequence: str, *, added_mass: bool, weight: bool, buoyancy: bool) -> tuple[Section, ...]:
    """The derivation for stands of an attitude sequence, with added mass, weight and buoyancy or without."""
    return (
        factors.factors(),
        flywheel.literal_terms(),
        flywheel.harmonics(),
        flywheel.row_at_a_phase(),
        carrier.equation(added_mass, weight, buoyancy),
        carrier.solution(added_mass),
        generalized.generalized(sequence),
    )
