"""Cross-flow drag in planning: its wrench, and the derivative of it, for M twists at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.cross_flow.law import CrossFlow
from mahovik.laws.cross_flow.program import Strip, strips_of
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan


@dataclass(frozen=True)
class TwistLaw:
    """Cross-flow drag of one body by its twist v (M, 6) relative to the fluid, all in the body's frame."""

    strips: tuple[Strip, ...]
    together: bool

    def wrench(self, v: Array) -> Array:
        """Sum over the strips (M, 6; N, N m)."""
        P = np.zeros_like(v)
        for strip in self.strips:
            S = _map(strip)
            P += self._force(strip, v @ S.T)[0] @ S
        return P

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6) of `wrench`."""
        D = np.zeros((*v.shape, 6))
        for strip in self.strips:
            S = _map(strip)
            D += S.T @ self._force(strip, v @ S.T)[1] @ S
        return D

    def _force(self, strip: Strip, across: Array) -> tuple[Array, Array]:
        """Force (M, 2) along y and z on a strip by its velocity (M, 2), and its derivative (M, 2, 2)."""
        drag = np.array([strip.y, strip.z])
        if not self.together:
            slope = -2.0 * drag * np.abs(across)
            return -drag * np.abs(across) * across, slope[:, :, None] * np.eye(2)
        speed = np.linalg.norm(across, axis=1, keepdims=True)
        safe = np.where(speed > 0.0, speed, 1.0)
        along = across / safe
        total = (across * along) @ drag
        of_total = 2.0 * drag * along - np.sum(along**2 * drag, axis=1, keepdims=True) * along
        slope = -(across[:, :, None] * of_total[:, None, :] + total[:, None, None] * np.eye(2))
        return -total[:, None] * across, slope


def _map(strip: Strip) -> Array:
    """(2, 6) Velocity of a strip along y and z from the twist."""
    return np.array([[0.0, 1.0, 0.0, 0.0, 0.0, strip.x], [0.0, 0.0, 1.0, 0.0, -strip.x, 0.0]])


def twist_law(body: Body) -> TwistLaw | None:
    """The cross-flow drag of a body; None where there is none."""
    law = body.law(CrossFlow)
    return None if law is None else TwistLaw(strips_of(law), law.together)


LAW = BodyPlan(twist_law)
