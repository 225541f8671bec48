"""Laws of `laws/` that act on a body in its own frame, in planning: by gravity, or by the body's twist in the fluid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import Body
from mahovik.use.plan.array import Array


class TwistLaw(Protocol):
    """A wrench that depends on the twist v (M, 6) of a body relative to the fluid, both in the body's frame."""

    def wrench(self, v: Array) -> Array:
        """P (M, 6; N, N m)."""

    def rate(self, v: Array) -> Array:
        """dP/dv (M, 6, 6); |v| has the slope 0 at v = 0."""


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
    found = tuple(law for of in laws.of_bodies("plan", "twist_law") if (law := of(body)) is not None)
    return TwistLaws(found) if found else None


def net_weight(body: Body) -> tuple[float, Array]:
    """What gravity acts on: the sums over the laws of their mass (kg) and first moment (3, kg m), in its frame."""
    parts = [of(body) for of in laws.of_bodies("plan", "gravity_moments")]
    return sum(mass for mass, _ in parts), np.asarray(sum(moment for _, moment in parts))
