"""Elements of stiffness and damping of the suspension, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.core.stand.model import TWIST_LETTERS, Stand
from mahovik.laws.suspension.law import Suspension
from mahovik.laws.suspension.reference import displacement
from mahovik.proof.diagnose.terms.law_term import CarrierFaults, LawTerm
from mahovik.proof.reference.rotation import Pose

DISPLACEMENTS = ("x", "y", "z", "phi_x", "phi_y", "phi_z")
"""Components of the displacement from equilibrium, in E1."""


def law_terms(stand: Stand, poses: Sequence[Pose]) -> list[LawTerm]:
    """Each element with the displacement or the speed of E1 relative to E0 that it stands before."""
    law = stand.law(Suspension)
    if law is None:
        return []
    x = np.array([displacement(law, stand.angles, pose) for pose in poses])
    V = np.array([pose.V for pose in poses])
    found = []
    for key, names, factors in (("stiffness", DISPLACEMENTS, x), ("damping", TWIST_LETTERS, V)):
        for i, row in enumerate(getattr(law, key)):
            for j, value in enumerate(row):
                wrench = np.zeros((len(poses), 6))
                wrench[:, i] = factors[:, j]
                found.append(LawTerm(0, names[j], f"suspension.{key}[{i}][{j}]", -value, wrench))
    return found


LAW = CarrierFaults("suspension", law_terms)
