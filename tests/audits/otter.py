"""Otter, a surface vehicle with two hulls and a payload: Fossen's model in Python."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from audits.audit import Audit, cross, momentum_products, terms
from mahovik.core.stand.state import State
from mahovik.proof.verify.judges.rigid import attitude

HULL, PAYLOAD = 55.0, 25.0  # kg
HULL_CENTER, PAYLOAD_CENTER = np.array([0.2, 0.0, -0.2]), np.array([0.05, 0.0, -0.35])  # m
OWN = HULL * np.diag([(0.4 * 1.08) ** 2, (0.25 * 2.0) ** 2, (0.25 * 2.0) ** 2])  # of the hull about its mass centre

MASS = HULL + PAYLOAD
CENTER = (HULL * HULL_CENTER + PAYLOAD * PAYLOAD_CENTER) / MASS

# moved from the common mass centre to the origin here, and once more in the mass matrix
INERTIA = OWN - HULL * cross(CENTER) @ cross(CENTER) - PAYLOAD * cross(PAYLOAD_CENTER) @ cross(PAYLOAD_CENTER)
ADDED = np.diag([0.1 * HULL, 1.5 * HULL, HULL, 0.2 * INERTIA[0, 0], 0.8 * INERTIA[1, 1], 1.7 * INERTIA[2, 2]])

SPRINGS = np.array([60.0, 70.0, 800.0, 30.0, 90.0, 40.0])  # N/m, N m/rad

DOCUMENT: Mapping[str, Any] = {
    "suspension": {"stiffness": SPRINGS.tolist()},
    "carrier": {
        "mass": HULL,
        "center_of_mass": HULL_CENTER.tolist(),
        "inertia": OWN.tolist(),
        "inertia_about": "center_of_mass",
        "added_mass": ADDED.tolist(),
    },
    "instrument": [
        {
            "name": "payload",
            "position": PAYLOAD_CENTER.tolist(),
            "mass": PAYLOAD,
        }
    ],
}


def answer(state: State, _: str) -> Mapping[str, Any]:
    """Mass matrix and products about the origin, moved there from the mass centre with H."""
    V = np.array(state.V)
    H = np.eye(6)
    H[:3, 3:] = cross(CENTER).T
    rigid = H.T @ np.block([[MASS * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), INERTIA]]) @ H
    C = np.block([[MASS * cross(V[3:]), np.zeros((3, 3))], [np.zeros((3, 3)), -cross(INERTIA @ V[3:])]])
    C_of_carrier = attitude(AUDITS[0].stand, state)
    moved = np.concatenate([C_of_carrier.as_matrix().T @ np.array(state.position), C_of_carrier.as_rotvec()])
    right = -H.T @ C @ H @ V - momentum_products(ADDED, V) - SPRINGS * moved
    return {"V_dot": np.linalg.solve(rigid + ADDED, right)}


AUDITS = (
    Audit(
        "otter",
        "Otter, surface vehicle",
        "github.com/cybergalactic/PythonVehicleSimulator, src/python_vehicle_simulator/vehicles/otter.py, 61a8f411",
        "Rigid body with payload, added mass; springs in place of hydrostatics; without damping, cross-flow drag and "
        "propellers",
        DOCUMENT,
        ("forward",),
        answer,
        terms("K: p_dot, r_dot, q r, p q; M: q_dot, p p, r r, p r; N: p_dot, r_dot, q r, p q"),
        "The inertia is moved from the mass centre to the origin twice: where it is computed, and in the mass matrix.",
    ),
)
