"""Scale of the suspension's wrench: how large its terms are before they cancel."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.suspension.data import Suspension
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose
from mahovik.proof.verify.scales.parts import length


def scale(stand: Stand, state: State, at: Pose) -> Array:
    """Scale (6; N, N m)."""
    law = stand.law(Suspension)
    if law is None:
        return np.zeros(6)
    away = length(at.O1) + length(law.position)
    turned = 1.0 + np.pi  # a rotation vector comes from elements of a rotation, of size 1
    stiffness, damping = np.abs(np.array(law.stiffness)), np.abs(np.array(law.damping))
    return np.asarray(stiffness @ np.repeat([away, turned], 3) + damping @ np.abs(at.V))
