"""NPS AUV II: Healey and Lienard (1993) in the newer and the older file of the Marine Systems Simulator."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from audits.audit import Answer, Array, Audit, merged, terms, to_body, without_added_products
from mahovik.core.stand.state import State

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

PRINTED_INVERSE = np.array(
    [
        [1.662e-4, 1.846e-10, 1.303e-7, 3.726e-9, -1.132e-6, 7.320e-10],
        [1.846e-10, 1.052e-4, 3.843e-10, 9.638e-6, -3.340e-9, 2.368e-6],
        [1.303e-7, 3.843e-10, 4.315e-5, 7.757e-9, -2.357e-6, 1.524e-9],
        [3.726e-9, 9.638e-6, 7.757e-9, 2.431e-4, -6.742e-8, -7.740e-7],
        [-1.132e-6, -3.340e-9, -2.357e-6, -6.742e-8, 2.049e-5, -1.324e-8],
        [7.320e-10, 2.368e-6, 1.524e-9, -7.740e-7, -1.324e-8, 4.838e-5],
    ]
)
"""Inverse of the mass matrix as the older file prints it."""


def dimension(component: str, product: str, density: float) -> float:
    """rho/2 L^n of a derivative."""
    turning = sum(each in "pqr" for each in product.split())
    return density / 2 * LENGTH ** (2 + turning + (component in "KMN"))


def added_mass(density: float) -> Array:
    """Added mass (6x6), SI."""
    size = np.array([1.0, 1.0, 1.0, LENGTH, LENGTH, LENGTH])
    return np.asarray(density / 2 * LENGTH**3 * np.outer(size, size) * ADDED)


def document(mass: float, density: float) -> dict[str, Any]:
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


def model(mass: float, density: float, heave: float, pitch: float, inverse: Array | None) -> Answer:
    """The model; `inverse`: of the mass matrix, or None: by the machine."""
    S = mass * np.array([[0.0, -CENTER, 0.0], [CENTER, 0.0, 0.0], [0.0, 0.0, 0.0]])
    J = np.array([[IX, -IXY, -IXZ], [-IXY, IY, -IYZ], [-IXZ, -IYZ, IZ]])
    M = np.block([[mass * np.eye(3), -S], [S, J]]) + added_mass(density)

    def answer(state: State, _: str) -> Mapping[str, Any]:
        V = np.array(state.V)
        down = to_body(NEW.stand, state, [0.0, 0.0, 1.0])  # -sin theta, cos theta sin phi, cos theta cos phi
        weight = np.array([0.0, 0.0, 0.0, -CENTER * WEIGHT * down[1], CENTER * WEIGHT * down[0], 0.0])
        right = products(mass, V, heave, pitch) + hydrodynamic(V, density) + weight
        return {"V_dot": np.linalg.solve(M, right) if inverse is None else inverse @ right}

    return answer


MSS = "github.com/cybergalactic/MSS"
SCOPE = (
    "Rigid body, added mass, products of velocities, weight and buoyancy; without cross-flow drag, planes and propeller"
)

NEW = Audit(
    "npsauv",
    "NPS AUV II",
    f"{MSS}, VESSELS/models/npsauv.m, a0730174",
    SCOPE,
    document(WEIGHT / 9.81, 1025.0),
    ("forward",),
    model(WEIGHT / 9.81, 1025.0, heave=1.0, pitch=-1.0, inverse=None),
    terms("Z: u q, v p, p p, q q; M: p r"),
    "Force Z of the rigid body and the moment (Iz - Ix) p r have the other sign; both were right in the older file.",
)
OLD = Audit(
    "npsauv_old",
    "NPS AUV II, older file, its mass matrix inverted here",
    f"{MSS}, VESSELS/npsauv.m, 2a04df5d",
    f"{SCOPE}; g such that the printed mass has the printed weight",
    document(5454.54, 1000.0),
    ("forward",),
    model(5454.54, 1000.0, heave=-1.0, pitch=1.0, inverse=None),
    terms(""),
    "Right.",
)
PRINTED = Audit(
    "npsauv_printed",
    "NPS AUV II, older file, inverse of the mass matrix as printed",
    OLD.source,
    OLD.scope,
    OLD.document,
    ("forward",),
    model(5454.54, 1000.0, heave=-1.0, pitch=1.0, inverse=PRINTED_INVERSE),
    None,
    "The inverse is printed with four digits, and so are the accelerations.",
)
AUDITS = (NEW, OLD, PRINTED)
