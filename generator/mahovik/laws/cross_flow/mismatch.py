"""Cross-flow drag that was measured a little wrong."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.cross_flow.data import CrossFlow
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> CrossFlow | None:
    """Drag coefficients times 1 + e at each station."""
    if not isinstance(law, CrossFlow):
        return None
    drag_y, drag_z = (tuple(draw.times(x) for x in table) for table in (law.drag_y, law.drag_z))
    return replace(law, drag_y=drag_y, drag_z=drag_z)
