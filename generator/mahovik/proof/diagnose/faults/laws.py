"""Faults in the laws of `laws/`, (7): each folder lists its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mahovik.contract.laws import LAWS, of_bodies, part
from mahovik.proof.diagnose.fault import Case, Edit, Fault, LawFault
from mahovik.proof.reference.pieces import Pieces
from mahovik.proof.reference.pose import Pose


def law_fault(law: str, row: LawFault) -> Fault:
    """The fault that has the wrench of the row instead of that of the law."""

    def edit(at: Pieces, case: Case) -> Pieces:
        pose = Pose(np.array(case.state.position), at.C, at.V)
        right = part(law, "reference").wrenches(case.stand, case.state, pose)
        wrong = row.wrench(case.stand, case.state, pose)
        return replace(at, F=at.F + wrong - sum(right.values(), np.zeros(6)))

    return Fault(row.name, "(7)", "all", [Edit("pieces", edit)], row.words.removesuffix("."), row.look)


ON_BODIES: tuple[Fault, ...] = tuple(row for rows in of_bodies("faults", "FAULTS") for row in rows)
"""Faults in the laws of bodies."""

ON_CARRIER = tuple(
    law_fault(law, row) for law in LAWS if (faults := part(law, "faults")) is not None for row in faults.FAULTS
)
"""Faults in the laws between E0 and the carrier."""
