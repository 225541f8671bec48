"""Elements of stiffness and damping of the suspension, one by one, for the search for wrong terms."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mahovik.core.stand.model import TWIST_LETTERS, Stand
from mahovik.laws.suspension.data import Suspension
from mahovik.laws.suspension.reference import displacement
from mahovik.proof.diagnose.terms.law_term import LawTerm
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.rotation import Pose

KIND = "suspension"

DISPLACEMENTS = ("x", "y", "z", "phi_x", "phi_y", "phi_z")
"""Components of the displacement from equilibrium, in E1."""


def law_terms(stand: Stand, at: Sequence[Pieces]) -> list[LawTerm]:
    """Each element with the displacement or the speed of E1 relative to E0 that it stands before."""
    law = stand.law(Suspension)
    if law is None:
        return []
    x = np.array([displacement(law, stand.angles, Pose(_place(p), p.C, p.V)) for p in at])
    V = np.array([p.V for p in at])
    found = []
    for key, names, factors in (("stiffness", DISPLACEMENTS, x), ("damping", TWIST_LETTERS, V)):
        for i, row in enumerate(getattr(law, key)):
            for j, value in enumerate(row):
                wrench = np.zeros((len(at), 6))
                wrench[:, i] = factors[:, j]
                found.append(LawTerm(0, names[j], f"suspension.{key}[{i}][{j}]", -value, wrench))
    return found


def _place(at: Pieces) -> Array:
    """O1 in E0 (3, m), which L1 = T(O1) [C] holds as <O1> C."""
    S = at.L1[3:, :3] @ at.C.T
    return np.array([S[2, 1], S[0, 2], S[1, 0]])


def coefficients(stand: Stand) -> dict[tuple[int, str], tuple[str, float]]:
    """Path and value of the damping that stands before a speed, by component of the wrench and letter of the speed."""
    law = stand.law(Suspension)
    if law is None:
        return {}
    damping = np.array(law.damping)
    return {
        (i, TWIST_LETTERS[j]): (f"suspension.damping[{i}][{j}]", float(damping[i, j]))
        for i, j in zip(*np.nonzero(damping), strict=True)
    }
