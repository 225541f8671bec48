"""Fading damping in planning: its wrench, and the derivative of it, for M twists at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.fading.law import FadingDamping
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan


@dataclass(frozen=True)
class TwistLaw:
    """Fading damping of one body by its twist v (M, 6) relative to the fluid, all in the body's frame."""

    law: FadingDamping

    def wrench(self, v: Array) -> Array:
        """-exp(-rate U) linear v (M, 6; N, N m)."""
        return np.asarray(-self._fade(v)[:, None] * (v @ np.array(self.law.linear).T))

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6) of `wrench`. U has the slope 0 at U = 0."""
        U = np.linalg.norm(v[:, :3], axis=1)
        along = np.zeros_like(v)
        along[:, :3] = v[:, :3] / np.where(U > 0.0, U, 1.0)[:, None]
        linear = np.array(self.law.linear)
        slope = linear - self.law.rate * (v @ linear.T)[:, :, None] * along[:, None, :]
        return np.asarray(-self._fade(v)[:, None, None] * slope)

    def _fade(self, v: Array) -> Array:
        """exp(-rate U) (M)."""
        return np.asarray(np.exp(-self.law.rate * np.linalg.norm(v[:, :3], axis=1)))


def twist_law(body: Body) -> TwistLaw | None:
    """The fading damping of a body; None where there is none."""
    law = body.law(FadingDamping)
    return None if law is None else TwistLaw(law)


LAW = BodyPlan(twist_law)
