"""NPS AUV II: Healey and Lienard (1993) in the newer and the older file of the Marine Systems Simulator."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from audits.audit import Answer, Array, Audit, merged, terms, to_body, without_added_products
from mahovik.core.stand.model import State

LENGTH = 5.3  # m
CENTER = 0.061  # z of the centre of gravity, m
IX, IY, IZ = 2038.0, 13587.0, 13587.0  # kg m2, about the origin
IXY = IYZ = IXZ = -13.58  # as they are printed: products, not elements of the tensor
WEIGHT = 53400.0  # N, of the water as well

DERIVATIVES: Mapping[str, Mapping[str, float]] = {
    "X": {
        "p p": 7.0e-3, "q q": -1.5e-2, "r r": 4.0e-3, "p r": 7.5e-4, "w q": -2.0e-1, "v p": -3.0e-3, "v r": 2.0e-2,
        "v v": 5.3e-2, "w w": 1.7e-1,
    },
    "Y": {
        "p q": 4.0e-3, "q r": -6.5e-3, "u p": 3.0e-3, "u r": 3.0e-2, "v q": 2.4e-2, "w p": 2.3e-1, "w r": -1.9e-2,
        "u v": -1.0e-1, "v w": 6.8e-2,
    },
    "Z": {
        "p p": 1.3e-4, "p r": 6.7e-3, "r r": -7.4e-3, "u q": -1.4e-1, "v p": -4.8e-2, "v r": 4.5e-2, "u w": -3.0e-1,
        "v v": -6.8e-2,
    },
    "K": {
        "p q": -6.9e-5, "q r": 1.7e-2, "u p": -1.1e-2, "u r": -8.4e-4, "v q": -5.1e-3, "w p": -1.3e-4, "w r": 1.4e-2,
        "u v": 3.1e-3, "v w": -1.9e-1,
    },
    "M": {
        "p p": 5.3e-5, "p r": 5.0e-3, "r r": 2.9e-3, "u q": -6.8e-2, "v p": 1.2e-3, "v r": 1.7e-2, "u w": 1.0e-1,
        "v v": -2.6e-2,
    },
    "N": {
        "p q": -2.1e-2, "q r": 2.7e-3, "u p": -8.4e-4, "u r": -1.6e-2, "v q": -1.0e-2, "w p": -1.7e-2, "w r": 7.4e-3,
        "u v": -7.4e-3, "v w": -2.7e-2,
    },
}  # fmt: skip
"""Hydrodynamic derivatives of products of two velocities, without dimension."""

ADDED = -np.array(
    [
        [-7.6e-3, 0, 0, 0, 0, 0],
        [0, -5.5e-2, 0, 1.2e-4, 0, 1.2e-3],
        [0, 0, -2.4e-1, 0, -6.8e-3, 0],
        [0, 1.2e-4, 0, -1.0e-3, 0, -3.4e-5],
        [0, 0, -6.8e-3, 0, -1.7e-2, 0],
        [0, 1.2e-3, 0, -3.4e-5, 0, -3.4e-3],
    ]
)
"""Added mass, without dimension."""


@dataclass(frozen=True)
class Strips:
    """Cross-flow drag as a file sums it: eleven strips of L/10, the outer two centred at the ends of the hull.

    density, size   kg/m3; m, of the square section; across, down: coefficients of v + x r and of w - x q
    heave           sign of the force Z; arm: sign of x q in the moment M
    """

    density: float
    size: float
    across: float
    down: float
    heave: float
    arm: float

    @property
    def document(self) -> dict[str, Any]:
        """The same strips in a stand file: one point between two stations."""
        step = LENGTH / 10
        x = [-LENGTH / 2 + (k - 0.5) * step for k in range(12)]
        table = {key: [value] * len(x) for key, value in (("height", self.size), ("breadth", self.size))}
        drag = {"drag_y": self.across, "drag_z": self.down}
        return {"density": self.density, "x": x, **table, **drag, "points": 1, "together": True}

    def wrench(self, V: Array) -> Array:
        """The wrench (6) by the formulas of the file."""
        _, v, w, _, q, r = V
        x = np.linspace(-LENGTH / 2, LENGTH / 2, 11)
        speed = np.maximum(np.hypot(v + x * r, w - x * q), 1e-300)
        drag = self.size * (self.across * (v + x * r) ** 2 + self.down * (w - x * q) ** 2) / speed
        force = self.density / 2 * LENGTH / 10
        Y, Z = (-force * drag @ flow for flow in (v + x * r, w - x * q))
        M, N = (-force * (x * drag) @ flow for flow in (w + self.arm * x * q, v + x * r))
        return np.array([0.0, Y, self.heave * Z, 0.0, M, N])


NEW_STRIPS = Strips(1025.0, 0.53, 0.5, 0.6, heave=1.0, arm=1.0)
OLD_STRIPS = Strips(1000.0, 0.5, 0.6, 0.6, heave=-1.0, arm=1.0)


def dimension(component: str, product: str, density: float) -> float:
    """rho/2 L^n of a derivative."""
    turning = sum(letter in "pqr" for letter in product.split())
    return density / 2 * LENGTH ** (2 + turning + (component in "KMN"))


def added_mass(density: float) -> Array:
    """Added mass (6x6), SI."""
    size = np.array([1.0, 1.0, 1.0, LENGTH, LENGTH, LENGTH])
    return np.asarray(density / 2 * LENGTH**3 * np.outer(size, size) * ADDED)


def document(mass: float, density: float, strips: Strips) -> dict[str, Any]:
    """The stand: published derivatives hold the products of added mass."""
    published = [
        {"wrench": component, "of": product.split(), "value": value * dimension(component, product, density)}
        for component, of in DERIVATIVES.items()
        for product, value in of.items()
    ]
    added = added_mass(density)
    return {
        "gravity": [0.0, 0.0, WEIGHT / mass],
        "carrier": {
            "mass": mass,
            "center_of_mass": [0.0, 0.0, CENTER],
            "inertia": [[IX, -IXY, -IXZ], [-IXY, IY, -IYZ], [-IXZ, -IYZ, IZ]],
            "inertia_about": "origin",
            "added_mass": added.tolist(),
            "buoyancy": {"displaced_mass": mass},
            "damping": {"terms": merged([*published, *without_added_products(added)])},
            "cross_flow": strips.document,
        },
    }


def hydrodynamic(V: Array, density: float) -> Array:
    """Published derivatives times products of velocities (6)."""
    letters = dict(zip("uvwpqr", V, strict=True))
    return np.array(
        [
            sum(
                value * dimension(component, product, density) * letters[product[0]] * letters[product[2]]
                for product, value in of.items()
            )
            for component, of in DERIVATIVES.items()
        ]
    )


def products(m: float, V: Array, heave: float, pitch: float) -> Array:
    """Products of the rigid body (6); `heave`, `pitch`: signs of the force Z and of (Iz - Ix)."""
    u, v, w, p, q, r = V
    return np.array(
        [
            m * v * r - m * w * q - m * CENTER * p * r,
            -m * (u * r - w * p + CENTER * q * r),
            heave * m * (v * p - u * q - CENTER * (p**2 + q**2)),
            (IY - IZ) * q * r - IXY * p * r - (r**2 - q**2) * IYZ + IXZ * p * q + m * CENTER * (u * r - w * p),
            pitch * (IZ - IX) * p * r + IXY * q * r - IYZ * p * q - (p**2 - r**2) * IXZ - m * CENTER * (w * q - v * r),
            (IX - IY) * p * q + (p**2 - q**2) * IXY + IYZ * p * r - IXZ * q * r,
        ]
    )


def model(mass: float, strips: Strips, heave: float, pitch: float) -> Answer:
    """The model in water of the density of the strips."""
    S = mass * np.array([[0.0, -CENTER, 0.0], [CENTER, 0.0, 0.0], [0.0, 0.0, 0.0]])
    J = np.array([[IX, -IXY, -IXZ], [-IXY, IY, -IYZ], [-IXZ, -IYZ, IZ]])
    M = np.block([[mass * np.eye(3), -S], [S, J]]) + added_mass(strips.density)

    def answer(state: State, _: str) -> Mapping[str, Any]:
        V = np.array(state.V)
        down = to_body(NEW.stand, state, [0.0, 0.0, 1.0])  # -sin theta, cos theta sin phi, cos theta cos phi
        weight = np.array([0.0, 0.0, 0.0, -CENTER * WEIGHT * down[1], CENTER * WEIGHT * down[0], 0.0])
        right = products(mass, V, heave, pitch) + hydrodynamic(V, strips.density) + strips.wrench(V) + weight
        return {"V_dot": np.linalg.solve(M, right)}

    return answer


MSS = "github.com/cybergalactic/MSS"
SCOPE = (
    "Rigid body, added mass, products of velocities, cross-flow drag by the eleven strips of L/10 of the file (1.1 L "
    "in all; without the 1e-6 m/s that the newer file adds to a speed before it divides), weight and buoyancy; "
    "without planes and propeller"
)

NEW = Audit(
    "npsauv",
    "NPS AUV II",
    f"{MSS}, VESSELS/models/npsauv.m, a0730174",
    SCOPE,
    document(WEIGHT / 9.81, 1025.0, NEW_STRIPS),
    ("forward",),
    model(WEIGHT / 9.81, NEW_STRIPS, heave=1.0, pitch=-1.0),
    terms("Z: u q, v p, p p, q q; M: p r, cross flow w"),
    "Force Z of the rigid body and the moment (Iz - Ix) p r have the other sign; both were right in the older file. "
    "The moment M of the cross-flow drag is summed over w + x q, the force Z over w - x q: the part of M that comes "
    "from w has the other sign.",
)
OLD = Audit(
    "npsauv_old",
    "NPS AUV II, older file, its mass matrix inverted here",
    f"{MSS}, VESSELS/npsauv.m, 2a04df5d",
    f"{SCOPE}; g such that the printed mass has the printed weight",
    document(5454.54, 1000.0, OLD_STRIPS),
    ("forward",),
    model(5454.54, OLD_STRIPS, heave=-1.0, pitch=1.0),
    terms("Z: cross flow (w - x q); M: cross flow w"),
    "The rigid body is right. The force Z of the cross-flow drag has the other sign, so that it drives. Its moment M "
    "is summed over w + x q, the force over w - x q: the part of M that comes from w has the other sign. The newer "
    "file has mended the force.",
)
AUDITS = (NEW, OLD)
