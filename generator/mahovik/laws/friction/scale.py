"""Scale of the friction of freedoms: how large its terms are before they cancel."""

from __future__ import annotations

import math

import numpy as np

from mahovik.core.stand.hold import wrenches
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.friction.data import Friction, frictions_of
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose


def scale(stand: Stand, state: State, at: Pose) -> Array:
    """Scale (6; N, N m): the speed of a freedom by its terms, and how steep friction is there."""
    total = np.zeros(6)
    if stand.hold is None:
        return total
    unit = wrenches(stand.hold).T
    for friction in frictions_of(stand):
        along = unit[friction.freedom]
        terms, speed = float(np.abs(along) @ np.abs(at.V)), float(along @ at.V)
        total += _drag(friction, terms, speed) * np.abs(along)
    return total


def _drag(friction: Friction, terms: float, speed: float) -> float:
    """Scale of one force: the smoothed sign changes by the part of the smoothing that the speed's terms are."""
    steepness = terms / math.hypot(speed, friction.smoothing)
    return friction.viscous * terms + friction.breakaway * (1.0 + steepness)
