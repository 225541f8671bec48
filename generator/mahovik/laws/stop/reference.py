"""Push of the stops, literally: a one-sided spring whose damping grows with the depth."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Sequence, Stand, State
from mahovik.laws.stop.law import Stop, stops_of
from mahovik.proof.reference.algebra import Array, Pose, attitude, carrier_rotation, force_at, larger, unit, vector
from mahovik.proof.reference.coordinates import coordinate, sine_and_cosine
from mahovik.proof.reference.pieces import CarrierReference


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of every stop on the carrier about O1 in E1, by its name in (7)."""
    if stand.hold is None:
        return {}
    stops = enumerate(stops_of(stand))
    return {f"stop {number}": wrench(stop, stand.hold, stand.angles, at) for number, stop in stops}


def wrench(stop: Stop, hold: Hold, sequence: Sequence, at: Pose) -> Array:
    """Wrench (6; N, N m) of one stop: zero before it, and where it would have to pull."""
    along, side = unit_wrench(hold, hold.freedoms[stop.freedom]), 1.0 if stop.above else -1.0
    depth = larger(side * (coordinate(hold, hold.freedoms[stop.freedom], sequence, at) - stop.at), 0.0)
    into = side * (along @ at.V)  # speed into the stop
    return np.asarray(-side * depth * larger(stop.stiffness + stop.damping * into, 0.0) * along)


def unit_wrench(hold: Hold, freedom: Freedom) -> Array:
    """(d; pivot x d) of what slides along d, (0; a) of what turns about a (6)."""
    d = unit(freedom)
    return force_at(d, vector(hold.pivot)) if freedom.kind == "slide" else np.concatenate([np.zeros(3), d])


def margin(stand: Stand, state: State) -> float:
    """Angle (rad) to the half turn, where the angle of a stop begins again; 0 where it has no angle at all."""
    hold, least = stand.hold, math.pi
    for stop in stops_of(stand) if hold else ():
        assert hold is not None
        freedom = hold.freedoms[stop.freedom]
        if freedom.kind == "turn":
            R = attitude(stand.angles, *hold.angles).T @ carrier_rotation(stand, state)
            sine, cosine = sine_and_cosine(R, unit(freedom))
            least = min(least, math.hypot(sine, cosine), math.pi - abs(math.atan2(sine, cosine)))
    return least


LAW = CarrierReference(wrenches, margin)
