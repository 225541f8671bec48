"""Damping in planning: its wrench, and the derivative of it, for M twists at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body, Mat6
from mahovik.laws.damping.law import Damping
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan


@dataclass(frozen=True)
class TwistLaw:
    """Damping of one body by its twist v (M, 6) relative to the fluid, all in the body's frame.

    `added_mass`: Lambda whose products the derivatives contain; None where they contain none.
    """

    damping: Damping
    added_mass: Mat6 | None = None

    def wrench(self, v: Array) -> Array:
        """-(linear v) - (quadratic (v |v|)) + terms (M, 6; N, N m), and Phi(v) Lambda v if the terms contain it."""
        P, damping = np.zeros_like(v), self.damping
        if damping.linear is not None:
            P -= v @ np.array(damping.linear).T
        if damping.quadratic is not None:
            P -= (v * np.abs(v)) @ np.array(damping.quadratic).T
        for term in damping.terms:
            first, second = (np.abs(v[:, a.component]) if a.absolute else v[:, a.component] for a in term.of)
            P[:, term.wrench] += term.value * first * second
        if self.added_mass is not None:
            P += _cross(v, v @ np.array(self.added_mass).T)
        return P

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6) of `wrench`. |v| has the slope 0 at v = 0."""
        D, damping = np.zeros((*v.shape, 6)), self.damping
        if damping.linear is not None:
            D -= np.array(damping.linear)
        if damping.quadratic is not None:
            D -= np.array(damping.quadratic) * (2.0 * np.abs(v))[:, None, :]
        for term in damping.terms:
            values = [np.abs(v[:, a.component]) if a.absolute else v[:, a.component] for a in term.of]
            slopes = [np.sign(v[:, a.component]) if a.absolute else np.ones(len(v)) for a in term.of]
            for own, other in ((0, 1), (1, 0)):
                D[:, term.wrench, term.of[own].component] += term.value * slopes[own] * values[other]
        if self.added_mass is not None:
            Lambda = np.array(self.added_mass)
            for k, unit in enumerate(np.eye(6)):
                D[:, :, k] += _cross(unit, v @ Lambda.T) + _cross(v, Lambda[:, k])
        return D


def _cross(v: Array, Z: Array) -> Array:
    """Phi(v) Z (M, 6) of twists v and momenta Z, either (6) or (M, 6)."""
    linear, angular, p, h = v[..., :3], v[..., 3:], Z[..., :3], Z[..., 3:]
    return np.concatenate([np.cross(angular, p), np.cross(linear, p) + np.cross(angular, h)], axis=-1)


def twist_law(body: Body) -> TwistLaw | None:
    """The damping of a body; None where nothing damps."""
    damping = body.law(Damping)
    if damping is None:
        return None
    return TwistLaw(damping, getattr(body, "added_mass", None) if damping.contains_products else None)


LAW = BodyPlan(twist_law)
