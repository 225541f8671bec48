"""Fins that were measured a little wrong."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData
from mahovik.laws.fin.data import Fin, Fins
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Fins | None:
    """Slope of the lift, drag and induced drag times 1 + e."""
    if not isinstance(law, Fins):
        return None
    return Fins(tuple(_with_errors(draw, fin) for fin in law.fins))


def _with_errors(draw: Errors, fin: Fin) -> Fin:
    slope, drag, induced = (draw.times(x) for x in (fin.lift_slope, fin.drag, fin.induced))
    return replace(fin, lift_slope=slope, drag=drag, induced=induced)
