"""Pose and twist of the carrier: what a law of `laws/` that acts between E0 and the carrier depends on."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.proof.reference.array import Array


@dataclass(frozen=True, eq=False)
class Pose:
    """O1 (3, m) in E0, C (3x3): x0 = C x1, and the twist V (6; m/s, rad/s) of E1 relative to E0."""

    O1: Array
    C: Array
    V: Array
