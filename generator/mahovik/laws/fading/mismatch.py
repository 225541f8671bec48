"""Fading damping that was measured a little wrong."""

from __future__ import annotations

from mahovik.core.stand.model import LawData
from mahovik.laws.fading.data import FadingDamping
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> FadingDamping | None:
    """Matrix S A S, S = diag(sqrt(1 + e)): definite stays definite; rate times 1 + e."""
    if not isinstance(law, FadingDamping):
        return None
    return FadingDamping(draw.matrix(law.linear) or law.linear, draw.times(law.rate))
