"""Twists of a carrier in balls: as a state gives them, or V = S u where the carrier is held."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb_mat

from mahovik.core.stand.model import Freedom, Stand
from mahovik.errors import StateError, count_numbers
from mahovik.proof.rigorous.ball import block, column, cross, length, zeros
from mahovik.proof.rigorous.screw import screw_of_parts


def twists(stand: Stand) -> arb_mat | None:
    """S (6 x m), twists of O1 in E1; None of a free carrier, and of a clamped one, which has no twist."""
    if stand.hold is None or not stand.hold.freedoms:
        return None
    pivot = column(stand.hold.pivot)
    return block([[_twist(freedom, pivot) for freedom in stand.hold.freedoms]])


def _twist(freedom: Freedom, pivot: arb_mat) -> arb_mat:
    """A column of S (6): a turn moves O1, at -pivot from the axis, by e x (-pivot)."""
    if freedom.kind == "twist":
        return column(freedom.twist)
    given = column(freedom.direction)
    e = given * (1 / length(given))
    return screw_of_parts(e, zeros(3)) if freedom.kind == "slide" else screw_of_parts(cross(e) * -pivot, e)


def twist(stand: Stand, given: Sequence[float], rates: Sequence[float]) -> arb_mat:
    """V or V* (6) of a state: as given, or S times the rates of the freedoms where the carrier is held.

    StateError: rates of another number than the freedoms.
    """
    if stand.hold is None:
        return column(given)
    if len(rates) != len(stand.hold.freedoms):
        raise StateError(f"u, u_dot: expected {count_numbers(len(stand.hold.freedoms))}, found {len(rates)}")
    S = twists(stand)
    return zeros(6) if S is None else S * column(rates)
