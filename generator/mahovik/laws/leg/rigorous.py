"""Wrench of the legs, in balls."""

from __future__ import annotations

from flint import arb_mat

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.laws.leg.data import Leg, legs_of
from mahovik.proof.rigorous.ball import column, cross, dot, length, number, part
from mahovik.proof.rigorous.screw import ANGULAR, LINEAR, force_at


def wrenches(stand: Stand, state: State, O1: arb_mat, C: arb_mat, V: arb_mat) -> list[arb_mat]:
    """Wrench (6; N, N m) of every leg on the carrier about O1 in E1. Raises StateError."""
    return [_wrench(leg, O1, C, V) for leg in legs_of(stand)]


def _wrench(leg: Leg, O1: arb_mat, C: arb_mat, V: arb_mat) -> arb_mat:
    point = column(leg.carrier)
    span = O1 + C * point - column(leg.ground)
    distance = length(span)
    if not distance > 0:
        raise StateError(f"leg between ground {leg.ground} and carrier {leg.carrier}: no length")
    along = C.transpose() * span * (1 / distance)
    rate = dot(along, part(V, LINEAR) + cross(part(V, ANGULAR)) * point)
    tension = number(leg.stiffness) * (distance - number(leg.length)) + number(leg.damping) * rate
    return force_at(-(along * tension), point)
