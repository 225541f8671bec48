"""Control derivatives that were measured a little wrong."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.control.data import ControlDerivatives
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> ControlDerivatives | None:
    """Each value times 1 + e."""
    if not isinstance(law, ControlDerivatives):
        return None
    return replace(law, terms=tuple(replace(term, value=draw.times(term.value)) for term in law.terms))
