"""Gyrostat: a rigid body with balanced wheels, from a textbook."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from audits.audit import Audit, terms
from mahovik.core.stand.state import State

MASS, WHEEL = 20.0, 0.9  # kg
JS, JT = 0.005, 0.003  # kg m2
BODY = np.array([[1.1, 0.05, -0.02], [0.05, 1.4, 0.03], [-0.02, 0.03, 1.7]])
PLACES = 0.2 * np.eye(3)  # m, each wheel on its own axis; the body balances their masses
CENTER = -WHEEL * PLACES.sum(axis=1) / MASS

DOCUMENT: Mapping[str, Any] = {
    "carrier": {
        "mass": MASS,
        "center_of_mass": CENTER.tolist(),
        "inertia": BODY.tolist(),
        "inertia_about": "center_of_mass",
    },
    "flywheel": [
        {
            "name": f"w{i + 1}",
            "position": PLACES[i].tolist(),
            "axis": np.eye(3)[i].tolist(),
            "zero": np.roll(np.eye(3)[i], 1).tolist(),
            "mass": WHEEL,
            "inertia": [JS, JT, JT],
        }
        for i in range(3)
    ],
}


def _steiner(mass: float, arm: Any) -> Any:
    return mass * (float(arm @ arm) * np.eye(3) - np.outer(arm, arm))


TOTAL = BODY + _steiner(MASS, CENTER)
for _i in range(3):
    TOTAL = TOTAL + JT * np.eye(3) + (JS - JT) * np.outer(np.eye(3)[_i], np.eye(3)[_i]) + _steiner(WHEEL, PLACES[_i])


def textbook(state: State, want: str) -> Mapping[str, Any]:
    """J omega' + h' + omega x (J omega + h) = 0, h' = Js phi'', tau = Js (phi'' + omega')."""
    v, w = np.array(state.V[:3]), np.array(state.V[3:])
    h = JS * np.array(state.phi_dot)
    gyroscopic = -np.cross(w, TOTAL @ w + h)
    if want == "torque":
        return {"tau": JS * (np.array(state.phi_ddot) + np.array(state.V_dot[3:]))}
    if want == "forward":
        omega_dot = np.linalg.solve(TOTAL, gyroscopic - JS * np.array(state.phi_ddot))
        return {"V_dot": [*-np.cross(w, v), *omega_dot]}
    tau = np.array(state.tau)
    omega_dot = np.linalg.solve(TOTAL - JS * np.eye(3), gyroscopic - tau)
    return {"V_dot": [*-np.cross(w, v), *omega_dot], "phi_ddot": tau / JS - omega_dot}


SCOPE = "Body with three wheels across one another, the mass centre as origin; translation as that of a free body"

AUDITS = (
    Audit(
        "gyrostat",
        "Gyrostat of the textbooks",
        "P. C. Hughes, Spacecraft Attitude Dynamics, Wiley 1986, motion equations of the gyrostat",
        SCOPE,
        DOCUMENT,
        ("forward", "torque", "coupled"),
        textbook,
        terms(""),
        "Right.",
    ),
)
