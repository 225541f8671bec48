"""Words for damping in checks and tables."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.laws.damping.data import Damping

NAME = "damping"
CARRIES_WEIGHT = False

SAME = 0.03
"""Relative difference below which a derivative counts as the product of added mass of the same name."""


def bearers(stand: Stand) -> list[str]:
    """The damped bodies."""
    return [body.name for body in stand.bodies if body.law(Damping) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""


def warnings(stand: Stand) -> list[str]:
    """Derivatives of the carrier that are products of its added mass, which count twice unless the file says so."""
    damping, added = stand.carrier.law(Damping), stand.carrier.added_mass
    if damping is None or added is None or damping.contains_products:
        return []
    published: dict[tuple[int, int, int], float] = {}
    for term in damping.terms:
        if not any(factor.absolute for factor in term.of):
            first, second = sorted(factor.component for factor in term.of)
            key = (term.wrench, first, second)
            published[key] = published.get(key, 0.0) + term.value
    products = products_of_added_mass(np.array(added))
    same = [
        (f"{WRENCH_LETTERS[i]} {TWIST_LETTERS[j]} {TWIST_LETTERS[k]}", value, product)
        for (i, j, k), value in published.items()
        if (product := float(products[i, j, k])) and abs(value - product) <= SAME * abs(product)
    ]
    if not same:
        return []
    name, value, product = same[0]
    more = f" (and {len(same) - 1} more)" if len(same) > 1 else ""
    return [
        f"carrier: damping.terms {name} = {value:.5g}{more} is the product of added mass {product:.5g}, which is in "
        'the equations by itself: if the derivatives contain it, write derivatives = "with added-mass products"'
    ]


def products_of_added_mass(added: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficients (6, 6, 6), SI, of V_j V_k, j <= k, in the wrench of the fluid beside the accelerations.

    Force p x omega and moment p x v + h x omega, where (p, h) = Lambda V.
    """
    found = np.zeros((6, 6, 6))
    unit = np.eye(6)
    for j in range(6):
        for k in range(6):
            p, h = added[:3, j], added[3:, j]
            v, omega = unit[k, :3], unit[k, 3:]
            wrench = np.concatenate([np.cross(p, omega), np.cross(p, v) + np.cross(h, omega)])
            found[:, min(j, k), max(j, k)] += wrench
    return found
