"""Weight of a body, literally."""

from __future__ import annotations

from mahovik.core.stand.model import Body
from mahovik.proof.reference.algebra import Array, force_at, vector
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, _: None, gravity: Array, V_r: Array) -> dict[str, Array]:
    """Weight (6; N, N m): m g at the centre of mass; `gravity` (3, m/s2) in the body's frame."""
    return {"weight": force_at(body.mass * gravity, vector(body.center_of_mass))}


LAW = BodyReference(wrenches)
