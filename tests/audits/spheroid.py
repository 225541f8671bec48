"""REMUS 100 as a spheroid: Fossen's model in MATLAB and in Python, with and without a current."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from audits.audit import Answer, Array, Audit, cross, momentum_products, rigid_mass, rigid_products, terms, to_body
from mahovik.core.stand.state import State

CENTER = (0.0, 0.0, 0.02)  # of gravity, m
GRAVITY = 9.81
ROLL = 0.3  # added moment of inertia in roll over that of the body

ZEROED = ((4, 2), (2, 4), (4, 0), (0, 4), (5, 0), (0, 5), (5, 1), (1, 5))
"""Elements of the matrix of added Coriolis terms that are set to zero, from 0."""


def spheroid(a: float, b: float, density: float) -> tuple[float, Array]:
    """Mass, and moments of inertia (3) about the mass centre, of a prolate spheroid filled with water."""
    m = 4 / 3 * math.pi * density * a * b**2
    return m, np.array([2 * b**2, a**2 + b**2, a**2 + b**2]) * m / 5


def lamb(a: float, b: float, density: float) -> Array:
    """Added mass (diagonal, 6) by Lamb's factors."""
    m, (Ix, Iy, _) = spheroid(a, b, density)
    e = math.sqrt(1 - (b / a) ** 2)
    log = math.log((1 + e) / (1 - e))
    alpha = 2 * (1 - e**2) / e**3 * (log / 2 - e)
    beta = 1 / e**2 - (1 - e**2) / (2 * e**3) * log
    turn = e**4 * (beta - alpha) / ((2 - e**2) * (2 * e**2 - (2 - e**2) * (beta - alpha)))
    along, across = alpha / (2 - alpha), beta / (2 - beta)
    return np.array([m * along, m * across, m * across, ROLL * Ix, turn * Iy, turn * Iy])


class Vehicle:
    """The vehicle of a file: semi-axes, and the densities that it takes for its mass and for the water."""

    def __init__(self, a: float, b: float, density: float, water: float) -> None:
        self.mass, self.moments = spheroid(a, b, density)
        self.added = np.diag(lamb(a, b, water))
        arm = np.array(CENTER)
        steiner = self.mass * (float(arm @ arm) * np.eye(3) - np.outer(arm, arm))
        self.inertia = np.diag(self.moments) + steiner

    def document(self, stream: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> dict[str, Any]:
        """The stand."""
        return {
            "gravity": [0.0, 0.0, GRAVITY],
            "stream": list(stream),
            "carrier": {
                "mass": self.mass,
                "center_of_mass": list(CENTER),
                "inertia": self.moments.tolist(),
                "inertia_about": "center_of_mass",
                "added_mass": self.added.tolist(),
                "buoyancy": {"displaced_mass": self.mass},
            },
        }

    def added_products(self, V: Array) -> Array:
        """-C_A(V) V (6) with the elements that the files set to zero."""
        p, h = self.added[:3] @ V, self.added[3:] @ V
        C = np.zeros((6, 6))
        C[:3, 3:] = C[3:, :3] = -cross(p)
        C[3:, 3:] = -cross(h)
        for i, j in ZEROED:
            C[i, j] = 0.0
        return np.asarray(-C @ V)

    def restoring(self, down: Array) -> Array:
        """Weight at the centre of gravity and buoyancy at the origin (6); `down`: unit vector in E1."""
        W = self.mass * GRAVITY
        z = CENTER[2]
        return np.array([0.0, 0.0, 0.0, -z * W * down[1], z * W * down[0], 0.0])

    def model(self, stream: tuple[float, float, float] = (0.0, 0.0, 0.0), by_momentum: bool = False) -> Answer:
        """The model; `by_momentum`: rigid-body products from the matrix C of the momentum, as in Python."""
        rigid = rigid_mass(self.mass, CENTER, self.inertia)
        speed, course = math.hypot(*stream[:2]), math.atan2(stream[1], stream[0])

        def answer(state: State, _: str) -> Mapping[str, Any]:
            V = np.array(state.V)
            x, y = to_body(IN_MATLAB.stand, state, [1.0, 0.0, 0.0]), to_body(IN_MATLAB.stand, state, [0.0, 1.0, 0.0])
            down = to_body(IN_MATLAB.stand, state, [0.0, 0.0, 1.0])
            yaw = math.atan2(y[0], x[0])
            # the current is turned by the yaw angle alone, and so is its derivative
            c = np.array([speed * math.cos(course - yaw), speed * math.sin(course - yaw), 0.0])
            relative = V - np.concatenate([c, np.zeros(3)])
            rate = np.array([V[5] * c[1], -V[5] * c[0], 0.0, 0.0, 0.0, 0.0])
            body = (
                -momentum_products(rigid, relative)
                if by_momentum
                else rigid_products(self.mass, CENTER, self.inertia, relative)
            )
            right = body + self.added_products(relative) + self.restoring(down)
            return {"V_dot": rate + np.linalg.solve(rigid + self.added, right)}

        return answer


MATLAB = Vehicle(1.0096 * 1.6 / 2, 1.0096 * 0.19 / 2, 1025.0, 1026.0)
PYTHON = Vehicle(1.6 / 2, 0.19 / 2, 1026.0, 1026.0)
CURRENT = (0.4, 0.3, 0.0)

SCOPE = "Rigid body, added mass, weight and buoyancy; without damping, lift, cross-flow drag, fins and propeller"
LEFT_OUT = terms("X: w q, v r; Y: u r; Z: u q; M: u w; N: u v")
FINDING = (
    "Products of added mass are set to zero on purpose, as the file says, also in the forces; with them goes the Munk "
    "moment."
)

IN_MATLAB = Audit(
    "remus100",
    "REMUS 100 in MATLAB",
    "github.com/cybergalactic/MSS, VESSELS/models/remus100.m, 248e0e67, with LIBRARY/modeling/spheroid.m, imlay61.m",
    SCOPE,
    MATLAB.document(),
    ("forward",),
    MATLAB.model(),
    LEFT_OUT,
    FINDING,
)
IN_PYTHON = Audit(
    "remus100_python",
    "REMUS 100 in Python",
    "github.com/cybergalactic/PythonVehicleSimulator, src/python_vehicle_simulator/vehicles/remus100.py, 7e1db8ed",
    SCOPE,
    PYTHON.document(),
    ("forward",),
    PYTHON.model(by_momentum=True),
    LEFT_OUT,
    FINDING,
)
IN_CURRENT = Audit(
    "remus100_current",
    "REMUS 100 in Python, in a current",
    IN_PYTHON.source,
    f"{SCOPE}; a horizontal current",
    PYTHON.document(CURRENT),
    ("forward",),
    PYTHON.model(CURRENT, by_momentum=True),
    None,
    "The current is turned into the body by the yaw angle alone: right only without roll and pitch.",
)
AUDITS = (IN_MATLAB, IN_PYTHON, IN_CURRENT)
