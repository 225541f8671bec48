"""The laws of `laws/` in planning: derivatives of their wrench by the carrier's pose and twist, exact."""

from __future__ import annotations

import numpy as np

from mahovik import laws
from mahovik.core.stand.model import Stand
from mahovik.use.plan.residual.kinematics import Twists
from mahovik.use.plan.residual.slopes import Slopes


def ties(stand: Stand, at: Twists) -> Slopes:
    """Slopes of the wrench of all laws at M states. StateError: a law is undefined there."""
    found = Slopes(np.zeros((len(at.V), 6, 6)), np.zeros((len(at.V), 6, 6)))
    for law in laws.parts("plan"):
        by_pose, by_twist = law.slopes(stand, at)
        found.by_pose[:] += by_pose
        found.by_twist[:] += by_twist
    return found
