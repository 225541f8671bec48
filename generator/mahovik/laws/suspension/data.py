"""Raw data of the suspension, as the stand file gives it, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Mat6, Vec3


@dataclass(frozen=True)
class Suspension(LawData):
    """Suspension of the carrier to E0: wrench `-(stiffness x + damping V)` at O1 in E1 axes.

    `x = (C^T (O1 - position), rotation vector of C_eq^T C)`; `angles` give C_eq in the stand's sequence.
    """

    stiffness: Mat6
    damping: Mat6
    position: Vec3
    angles: Vec3

    @property
    def rows(self) -> tuple[int, ...]:
        """Components of its wrench whose row of stiffness or damping is not zero."""
        return tuple(i for i in range(6) if any(self.stiffness[i]) or any(self.damping[i]))
