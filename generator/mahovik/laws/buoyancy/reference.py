"""Archimedes force on a body, literally."""

from __future__ import annotations

from mahovik.core.stand.model import Body
from mahovik.laws.buoyancy.law import Buoyancy
from mahovik.proof.reference.algebra import Array, force_at, vector
from mahovik.proof.reference.pieces import BodyReference


def wrenches(body: Body, buoyancy: Buoyancy, gravity: Array, V_r: Array) -> dict[str, Array]:
    """-displaced_mass g at the centre of buoyancy (6; N, N m); `gravity` (3, m/s2) in the body's frame."""
    return {"buoyancy": force_at(-buoyancy.displaced_mass * gravity, vector(buoyancy.center))}


LAW = BodyReference(wrenches, Buoyancy)
