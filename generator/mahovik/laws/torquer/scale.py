"""Scale of the torquers' wrench: how large its terms are before they cancel."""

from __future__ import annotations

import numpy as np

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.laws.torquer.data import Torquers
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose
from mahovik.proof.verify.scales.parts import length


def scale(stand: Stand, state: State, at: Pose) -> Array:
    """Scale (6; N, N m): every moment by the sizes of dipole and field, since both are turned."""
    law = stand.law(Torquers)
    if law is None:
        return np.zeros(6)
    size = sum(length(torquer.dipole) for torquer in law.torquers) * length(law.magnetic_field)
    return np.array([0.0, 0.0, 0.0, size, size, size])
