"""Raw data of the fading damping of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import LawData, Mat6


@dataclass(frozen=True)
class FadingDamping(LawData):
    """Linear damping of slow motion, wrench -exp(-rate U) linear V_r, all in the body's own frame.

    V_r     twist of the body relative to the fluid; U (m/s) is the length of its linear part
    linear  6x6, SI
    rate    s/m, above 0: at U = 1/rate the damping is down to 37 %
    """

    linear: Mat6
    rate: float

    @property
    def nonlinear(self) -> bool:
        """True: it fades."""
        return True

    @property
    def has_kinks(self) -> bool:
        """True: U has one where the body comes to rest."""
        return True
