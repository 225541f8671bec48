"""Laws of `laws/` that act on a body in its own frame, in planning: by gravity, or by the body's twist in the fluid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mahovik.contract.laws import BODY_LAWS, parts
from mahovik.core.stand.model import Body
from mahovik.use.plan.array import Array
from mahovik.use.plan.residual.slopes import BodyPlan, TwistLaw
from mahovik.use.plan.residual.spatial import first_moment


@dataclass(frozen=True)
class TwistLaws:
    """All such laws of one body."""

    laws: tuple[TwistLaw, ...]

    def wrench(self, v: Array) -> Array:
        """P (M, 6; N, N m)."""
        return np.asarray(sum(law.wrench(v) for law in self.laws))

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6)."""
        return np.asarray(sum(law.rate(v) for law in self.laws))


def twist_laws(body: Body) -> TwistLaws | None:
    """The laws that depend on the body's own twist; None where there is none."""
    found = tuple(law for plan in parts("plan", BodyPlan, BODY_LAWS) if (law := plan.twist_law(body)) is not None)
    return TwistLaws(found) if found else None


def net_weight(body: Body) -> tuple[float, Array]:
    """What gravity acts on: mass (kg) and first moment (3, kg m) in its frame, less those of the displaced fluid."""
    moment = sum((mass * np.array(center) for mass, center in body.displaced), np.zeros(3))
    return body.mass - sum(mass for mass, _ in body.displaced), first_moment(body) - moment
