"""Propellers that were measured a little wrong."""

from __future__ import annotations

from dataclasses import replace

from mahovik.core.stand.model import LawData, Vec3
from mahovik.laws.propeller.data import Propellers
from mahovik.use.control.measurement import Errors


def with_mismatch(draw: Errors, law: LawData) -> Propellers | None:
    """All coefficients times 1 + e."""
    if not isinstance(law, Propellers):
        return None

    def with_errors(k: Vec3) -> Vec3:
        return (draw.times(k[0]), draw.times(k[1]), draw.times(k[2]))

    return Propellers(
        tuple(replace(p, thrust=with_errors(p.thrust), torque=with_errors(p.torque)) for p in law.propellers)
    )
