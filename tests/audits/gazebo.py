"""Added mass and drag in Gazebo: Fossen's equations in the plug-ins of uuv_simulator and of gz-sim."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from audits.audit import Array, Audit, cross, rigid_mass, rigid_products, terms, to_body
from mahovik.core.stand.model import State

MASS, GRAVITY = 41.7, 9.81
INERTIA = np.array([[1.23, 0.021, -0.047], [0.021, 4.17, 0.033], [-0.047, 0.033, 4.43]])
CENTER = (0.0, 0.0, 0.0)  # forces are put at the mass centre, so the link has its frame there
BUOYANCY, BUOYANT = 39.0, np.array([0.01, 0.0, 0.06])  # kg, m
STREAM = np.array([0.3, -0.2, 0.1])

FULL = np.array(
    [
        [4.3, 0.1, 0.0, 0.2, 0.1, 0.0],
        [0.1, 28.9, 0.2, -0.3, 0.0, 1.1],
        [0.0, 0.2, 34.7, 0.0, -1.5, 0.1],
        [0.2, -0.3, 0.0, 0.31, 0.0, 0.05],
        [0.1, 0.0, -1.5, 0.0, 3.83, 0.0],
        [0.0, 1.1, 0.1, 0.05, 0.0, 3.47],
    ]
)
LINEAR = np.array([-7.3, -9.1, -11.2, -0.63, -1.41, -1.27])
QUADRATIC = np.array([-31.0, -93.0, -112.0, -0.53, -4.1, -3.2])


def document(added: Array, weight: bool) -> dict[str, Any]:
    """The stand; `weight`: with weight and buoyancy."""
    return {
        "gravity": [0.0, 0.0, -GRAVITY if weight else 0.0],
        "stream": STREAM.tolist(),
        "carrier": {
            "mass": MASS,
            "inertia": INERTIA.tolist(),
            "added_mass": added.tolist(),
            "damping": {"linear": np.diag(-LINEAR).tolist(), "quadratic": np.diag(-QUADRATIC).tolist()},
        }
        | ({"buoyancy": {"displaced_mass": BUOYANCY, "center": BUOYANT.tolist()}} if weight else {}),
    }


def _motion(state: State) -> tuple[Array, Array, Array]:
    """V, V relative to the current, and what the current adds to its derivative."""
    V = np.array(state.V)
    c = to_body(FOSSEN.stand, state, STREAM.tolist())
    return V, V - np.concatenate([c, np.zeros(3)]), np.concatenate([np.cross(V[3:], c), np.zeros(3)])


def _drag(V: Array) -> Array:
    return np.asarray((LINEAR + QUADRATIC * np.abs(V)) * V)


def uuv_simulator(state: State, _: str) -> Mapping[str, Any]:
    """Forces of HMFossen on the body that Gazebo moves by Newton and Euler."""
    V, relative, rate = _motion(state)
    ab = FULL @ relative
    Sa = -cross(ab[:3])
    Ca = np.block([[np.zeros((3, 3)), Sa], [Sa, -cross(ab[3:])]])
    down = to_body(FOSSEN.stand, state, [0.0, 0.0, -GRAVITY])
    lift = -BUOYANCY * down
    water = _drag(relative) - Ca @ relative - FULL @ rate + np.concatenate([lift, np.cross(BUOYANT, lift)])
    right = rigid_products(MASS, CENTER, INERTIA, V) + np.concatenate([MASS * down, np.zeros(3)]) + water
    return {"V_dot": np.linalg.solve(rigid_mass(MASS, CENTER, INERTIA) + FULL, right)}


def gz_sim(state: State, _: str) -> Mapping[str, Any]:
    """Forces of Hydrodynamics, with derivatives of added mass that are negative, as SNAME has them."""
    V, relative, rate = _motion(state)
    X, Y, Z, K, M, N = -np.diag(FULL)
    u, v, w, p, q, r = relative
    C = np.zeros((6, 6))
    C[0, 4:] = -Z * w, -Y * v
    C[1, 3], C[1, 5] = Z * w, -X * u
    C[2, 3:5] = -Y * v, X * u
    C[3, 1:3], C[3, 4:] = (-Z * w, Y * v), (-N * r, M * q)
    C[4, 0], C[4, 2], C[4, 3], C[4, 5] = Z * w, -X * u, N * r, -K * p
    C[5, :2], C[5, 3:5] = (Z * w, X * u), (-M * q, K * p)
    added = -np.diag([X, Y, Z, K, M, N])
    # the wrench is minus the sum of -Ma V', -C V and drag
    right = rigid_products(MASS, CENTER, INERTIA, V) + _drag(relative) + C @ relative - added @ rate
    return {"V_dot": np.linalg.solve(rigid_mass(MASS, CENTER, INERTIA) + added, right)}


SCOPE = "Added mass, its products, drag and current, on a body with its mass centre at the origin of the link"

FOSSEN = Audit(
    "uuv_simulator",
    "uuv_simulator, HMFossen",
    "github.com/uuvsimulator/uuv_simulator, uuv_gazebo_plugins/uuv_gazebo_plugins/src/HydrodynamicModel.cc, 0db06494",
    f"{SCOPE}, buoyancy; without the filter that delays the acceleration by a step",
    document(FULL, weight=True),
    ("forward",),
    uuv_simulator,
    terms(""),
    "Right, current and its derivative included.",
)
HYDRODYNAMICS = Audit(
    "gz_sim",
    "gz-sim, Hydrodynamics",
    "github.com/gazebosim/gz-sim, src/systems/hydrodynamics/Hydrodynamics.cc, 775ba7df",
    f"{SCOPE}; added mass as the derivatives of SNAME, which are negative; the acceleration without the lag of a step",
    document(np.diag(np.diag(FULL)), weight=False),
    ("forward",),
    gz_sim,
    terms("X: w q; Y: u r, w p; Z: u q, v p; K: v w, q r; M: u w, p r; N: u w, u v, p q"),
    "The matrix is applied with the sign that belonged to positive added mass; in X the sign of one element is wrong "
    "as well, which makes v r right, and N has w where it should have v.",
)
AUDITS = (FOSSEN, HYDRODYNAMICS)
