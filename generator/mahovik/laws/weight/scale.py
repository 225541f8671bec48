"""Scale of a body's weight."""

from __future__ import annotations

from mahovik.core.stand.model import Body
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.scales.parts import force_scale


def scale(body: Body, gravity: float, twist: Array) -> Array:
    """m g in any direction, at the centre of mass (6; N, N m)."""
    return force_scale(body.mass * gravity, body.center_of_mass)
