"""Scale of the legs' wrench: how large its terms are before they cancel."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.leg.data import Leg, legs_of
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose
from mahovik.proof.verify.scales.parts import force_scale, length


def scale(stand: Stand, state: State, at: Pose) -> Array:
    """Scale (6; N, N m) of all legs."""
    return np.asarray(sum((_leg(leg, at) for leg in legs_of(stand)), np.zeros(6)))


def _leg(leg: Leg, at: Pose) -> Array:
    """Tension by its terms; the span is a difference of positions, so its direction has the error of their size."""
    ground, point = np.array(leg.ground), np.array(leg.carrier)
    reach = length(at.O1) + length(ground) + length(point)
    span = max(length(at.O1 + at.C @ point - ground), 1e-9)
    v, omega = (length(part) for part in np.split(at.V, 2))
    cancelled = reach / span  # > 1: digits that the span has lost
    rate = (v + omega * length(point)) * cancelled
    tension = leg.stiffness * (reach + leg.length) + leg.damping * rate
    stretched = leg.stiffness * abs(span - leg.length) + leg.damping * rate
    return force_scale(tension + stretched * cancelled, leg.carrier)
