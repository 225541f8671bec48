"""Damping that was measured a little wrong."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.damping.data import Damping
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Damping | None:
    """Matrices S A S, S = diag(sqrt(1 + e)): definite stays definite; terms times 1 + e."""
    if not isinstance(law, Damping):
        return None
    terms = tuple(replace(term, value=draw.times(term.value)) for term in law.terms)
    return replace(law, linear=draw.matrix(law.linear), quadratic=draw.matrix(law.quadratic), terms=terms)
