"""A suspension with small errors of measurement."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.suspension.data import Suspension
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Suspension | None:
    """Stiffness and damping S K S, S = diag(sqrt(1 + e)): definite stays definite; position as a vector."""
    if not isinstance(law, Suspension):
        return None
    stiffness, damping = draw.matrix(law.stiffness), draw.matrix(law.damping)
    assert stiffness is not None
    assert damping is not None
    return replace(law, stiffness=stiffness, damping=damping, position=draw.vector(law.position))
