"""Scale of the push of stops: how large its terms are before they cancel."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.state import State
from mahovik.laws.stop.data import Stop, stops_of
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose, attitude
from mahovik.proof.verify.scales.parts import length

NEAR = 1e-6
"""Part of the coordinate's terms: a stop that is nearer than this may push by rounding."""


def scale(stand: Stand, state: State, at: Pose) -> Array:
    """Scale (6; N, N m) of the stops that push, or are about to."""
    hold, total = stand.hold, np.zeros(6)
    if hold is None:
        return total
    C0, unit = attitude(stand.angles, *hold.angles), wrenches(hold).T
    for stop in stops_of(stand):
        along = unit[stop.freedom]
        coordinate, terms = _coordinate(hold, stop, along, C0, at)
        terms += abs(stop.at)
        depth = (coordinate - stop.at) * (1.0 if stop.above else -1.0)
        if depth > -NEAR * terms:
            speed = float(np.abs(along) @ np.abs(at.V))
            most = (abs(depth) + terms) * (stop.stiffness + stop.damping * speed)
            total += most * np.abs(along)
    return total


def _coordinate(hold: Hold, stop: Stop, along: Array, C0: Array, at: Pose) -> tuple[float, float]:
    """Coordinate of the freedom, and the size of its terms; an angle by how far off the axis the carrier is turned."""
    if hold.freedoms[stop.freedom].kind == "slide":
        pivot = np.array(hold.pivot)
        gone = at.O1 + at.C @ pivot - np.array(hold.position) - C0 @ pivot
        return float((C0 @ along[:3]) @ gone), length(at.O1) + length(hold.position) + 2.0 * length(pivot)
    R, a = C0.T @ at.C, along[3:]
    sine = float(a @ [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    cosine = float(np.trace(R) - a @ R @ a)
    return math.atan2(sine, cosine), 4.0 / max(math.hypot(sine, cosine), 1e-9)
