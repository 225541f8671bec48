"""Wrench of the legs, literally."""

from __future__ import annotations

from mahovik.core.stand.model import Stand, State
from mahovik.errors import StateError
from mahovik.laws.leg.law import Leg, legs_of
from mahovik.proof.reference.algebra import Array, Pose, cross, force_at, hypot, vector
from mahovik.proof.reference.pieces import CarrierReference

SHORTEST = 1e-9  # m; a shorter leg has no direction


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of every leg on the carrier about O1 in E1, by its name in (7). Raises StateError."""
    return {f"leg {number}": wrench(leg, at) for number, leg in enumerate(legs_of(stand))}


def wrench(leg: Leg, at: Pose) -> Array:
    """Wrench (6; N, N m) of a spring-damper leg. StateError where its ends meet: it has no direction there."""
    point = vector(leg.carrier)
    d = at.O1 + at.C @ point - vector(leg.ground)  # from the ground, in E0
    length = hypot(*d)
    if length < SHORTEST:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: length {length:.3g} m is zero")
    direction = at.C.T @ d / length  # in E1, from the ground
    length_rate = direction @ (at.V[:3] + cross(at.V[3:]) @ point)
    tension = leg.stiffness * (length - leg.length) + leg.damping * length_rate
    return force_at(-tension * direction, point)


LAW = CarrierReference(wrenches)
