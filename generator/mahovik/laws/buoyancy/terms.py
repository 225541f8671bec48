"""Names of buoyancy and its moments, for the search for wrong terms."""

from __future__ import annotations

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.data import Buoyancy


def coefficients(body: Body, g: float) -> dict[str, float]:
    """Buoyancy of a body, N, and its moments about the origin, N m, by name, under gravity g (m/s2)."""
    found = body.law(Buoyancy)
    if found is None:
        return {}
    B = found.displaced_mass * g
    return {"B": B} | {f"B {axis}_B": B * x for axis, x in zip("xyz", found.center, strict=True)}
