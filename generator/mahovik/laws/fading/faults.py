"""Coefficients of fading damping, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fading.law import FadingDamping
from mahovik.proof.diagnose.terms.law_term import BodyFaults, LawTerm, matrix_terms
from mahovik.proof.reference.array import Array


def law_terms(bodies: Sequence[Body], V_r: Array) -> list[LawTerm]:
    """Elements of `linear`, of one body at n states with the twists V_r (n, 6) relative to the fluid."""
    law = bodies[0].law(FadingDamping)
    if law is None:
        return []
    fade = np.exp(-law.rate * np.linalg.norm(V_r[:, :3], axis=1))
    return matrix_terms("exp(-rate U)", "fading_damping.linear", law.linear, fade[:, None] * V_r)


LAW = BodyFaults("fading damping", law_terms)
