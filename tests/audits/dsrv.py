"""DSRV: heave and pitch of a rescue vehicle by Healey (1992), from the Marine Systems Simulator."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from audits.audit import Audit, merged, rigid_products, terms, without_added_products
from mahovik.core.stand.state import State

MASS, INERTIA = 0.036391, 0.001925
ADDED = np.zeros((6, 6))
ADDED[np.ix_([2, 4], [2, 4])] = [[0.031545, 0.000130], [0.000146, 0.001573]]
Z_Q, Z_W, M_Q, M_W = -0.017455, -0.043938, -0.01131, 0.011175

SYMMETRIC = (ADDED + ADDED.T) / 2
"""The stand's added mass: that of an ideal fluid is symmetric, Z_qdot = M_wdot."""

DOCUMENT: Mapping[str, Any] = {
    "carrier": {
        "mass": MASS,
        "inertia": [INERTIA, INERTIA, INERTIA],
        "added_mass": SYMMETRIC.tolist(),
        "damping": {
            "terms": merged(
                [
                    {"wrench": "Z", "of": ["u", "w"], "value": Z_W},
                    {"wrench": "Z", "of": ["u", "q"], "value": Z_Q},
                    {"wrench": "M", "of": ["u", "w"], "value": M_W},
                    {"wrench": "M", "of": ["u", "q"], "value": M_Q},
                    *without_added_products(SYMMETRIC),
                ]
            )
        },
    },
}


def answer(state: State, _: str) -> Mapping[str, Any]:
    """Accelerations from Z and M of the file; the four other equations are those of a rigid body."""
    V = np.array(state.V)
    u, v, w, p, q, _ = V
    right = rigid_products(MASS, (0.0, 0.0, 0.0), INERTIA * np.eye(3), V)
    right[2] = -MASS * v * p + Z_Q * u * q + Z_W * u * w
    right[4] = M_Q * u * q + M_W * u * w
    return {"V_dot": np.linalg.solve(np.diag([MASS] * 3 + [INERTIA] * 3) + ADDED, right)}


AUDITS = (
    Audit(
        "dsrv",
        "DSRV, heave and pitch",
        "github.com/cybergalactic/MSS, VESSELS/models/DSRV.m, 5ae065a9",
        "Mass matrix and products of velocities in the primed units of the file, which it does not scale to SI; "
        "without the righting moment and the stern plane",
        DOCUMENT,
        ("forward",),
        answer,
        terms("Z: u q, q_dot; M: w_dot"),
        "The centripetal force m u q is not in Z, unless it is meant to be in Z_q; Z_qdot and M_wdot differ by 12%, "
        "and the stand has their mean.",
    ),
)
