"""Control derivatives in planning: their wrench, and the derivative of it, for M twists at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import Body
from mahovik.laws.control.law import ControlDerivatives, Factor, Velocity
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan


@dataclass(frozen=True)
class TwistLaw:
    """Control derivatives of one body by its twist v (M, 6) relative to the fluid, all in the body's frame."""

    law: ControlDerivatives
    body: Body

    def wrench(self, v: Array) -> Array:
        """Sum of the products (M, 6; N, N m)."""
        P = np.zeros_like(v)
        for term in self.law.terms:
            P[:, term.wrench] += term.value * np.prod([self._factor(each, v)[0] for each in term.of], axis=0)
        return P

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6) of `wrench`. |v| has the slope 0 at v = 0, and so has the race at u = 0."""
        D = np.zeros((*v.shape, 6))
        for term in self.law.terms:
            found = [self._factor(each, v) for each in term.of]
            for k, (_, slope, component) in enumerate(found):
                others = [value for j, (value, _, _) in enumerate(found) if j != k]
                D[:, term.wrench, component] += term.value * slope * np.prod(others, axis=0)
        return D

    def _factor(self, each: Factor, v: Array) -> tuple[Array, Array, int]:
        """Value (M), its slope (M) and the component of the twist by which the slope is."""
        if isinstance(each, Velocity):
            x = v[:, each.component]
            value, slope, component = x, np.ones(len(v)), each.component
        elif each.what == "race":
            value, slope = self._race(self.body.inputs[each.source], v[:, 0])
            component = 0
        else:
            value, slope, component = np.full(len(v), self.body.inputs[each.source]), np.zeros(len(v)), 0
        return (np.abs(value), np.sign(value) * slope, component) if each.absolute else (value, slope, component)

    def _race(self, n: float, u: Array) -> tuple[Array, Array]:
        """The race (M) and its slope by u (M)."""
        behind = np.sqrt(u**2 + self.law.race * n**2)
        value = np.sign(n) * (behind - np.abs(u))
        return value, -np.sign(u) * value / np.where(behind > 0.0, behind, 1.0)


def twist_law(body: Body) -> TwistLaw | None:
    """The control derivatives of a body; None where there is none."""
    law = body.law(ControlDerivatives)
    return None if law is None else TwistLaw(law, body)


LAW = BodyPlan(twist_law)
