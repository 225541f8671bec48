"""Push of the stops, literally: a one-sided spring whose damping grows with the depth."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.model import Freedom, Hold, Sequence, Stand
from mahovik.core.stand.state import State
from mahovik.laws.stop.data import Stop, stops_of
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pose import Pose
from mahovik.proof.reference.rotation import attitude, carrier_rotation
from mahovik.proof.reference.screw import force_at


def wrenches(stand: Stand, state: State, at: Pose) -> dict[str, Array]:
    """Wrench (6; N, N m) of every stop on the carrier about O1 in E1, by its name in (7)."""
    if stand.hold is None:
        return {}
    given = enumerate(stops_of(stand))
    return {f"stop {number}": wrench(stop, stand.hold, stand.angles, at) for number, stop in given}


def wrench(stop: Stop, hold: Hold, sequence: Sequence, at: Pose) -> Array:
    """Wrench (6; N, N m) of one stop: zero before it, and where it would have to pull."""
    along, side = unit_wrench(hold, hold.freedoms[stop.freedom]), 1.0 if stop.above else -1.0
    depth = max(0.0, side * (coordinate(hold, hold.freedoms[stop.freedom], sequence, at) - stop.at))
    into = side * float(along @ at.V)  # speed into the stop
    return np.asarray(-side * depth * max(0.0, stop.stiffness + stop.damping * into) * along)


def unit_wrench(hold: Hold, freedom: Freedom) -> Array:
    """(d; pivot x d) of what slides along d, (0; a) of what turns about a (6)."""
    d = _unit(freedom)
    return force_at(d, np.array(hold.pivot)) if freedom.kind == "slide" else np.concatenate([np.zeros(3), d])


def coordinate(hold: Hold, freedom: Freedom, sequence: Sequence, at: Pose) -> float:
    """Way of the pivot from the home pose (m), or angle of turning about the axis from it (rad, within half a turn)."""
    C0, d = attitude(sequence, *hold.angles), _unit(freedom)
    if freedom.kind == "slide":
        pivot = np.array(hold.pivot)
        gone = at.O1 + at.C @ pivot - (np.array(hold.position) + C0 @ pivot)
        return float((C0 @ d) @ gone)
    sine, cosine = _sine_and_cosine(C0.T @ at.C, d)
    return math.atan2(sine, cosine)


def _sine_and_cosine(R: Array, a: Array) -> tuple[float, float]:
    """Sine and cosine of the angle about a, times one factor: by the skew part of R, and by its part across a."""
    about = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]) / 2
    across = np.eye(3) - np.outer(a, a)
    return float(a @ about), float(np.trace(across @ R)) / 2


def _unit(freedom: Freedom) -> Array:
    d = np.array(freedom.direction) / np.max(np.abs(freedom.direction))
    return np.asarray(d / np.linalg.norm(d))


def margin(stand: Stand, state: State) -> float:
    """Angle (rad) to the half turn, where the angle of a stop begins again; 0 where it has no angle at all."""
    hold, least = stand.hold, math.pi
    for stop in stops_of(stand) if hold else ():
        assert hold is not None
        freedom = hold.freedoms[stop.freedom]
        if freedom.kind == "turn":
            R = attitude(stand.angles, *hold.angles).T @ carrier_rotation(stand, state)
            sine, cosine = _sine_and_cosine(R, _unit(freedom))
            least = min(least, math.hypot(sine, cosine), math.pi - abs(math.atan2(sine, cosine)))
    return least


def branches(stand: Stand, state: State, at: Pose) -> Array:
    """Whether each stop is reached, and whether it would push: its force has a kink where one of these changes."""
    found = []
    for stop in stops_of(stand):
        assert stand.hold is not None
        freedom, side = stand.hold.freedoms[stop.freedom], 1.0 if stop.above else -1.0
        depth = side * (coordinate(stand.hold, freedom, stand.angles, at) - stop.at)
        push = stop.stiffness + stop.damping * side * float(unit_wrench(stand.hold, freedom) @ at.V)
        found += [np.sign(depth), np.sign(push)]
    return np.array(found)
