"""Words for damping in checks and tables."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.law import DRIVES, negative_diagonal
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.laws.damping.data import Damping

NAME = "damping"
CARRIES_WEIGHT = False

SAME = 0.03
"""Relative difference below which a derivative counts as the product of added mass of the same name."""

NEAR = 0.25
"""Likewise where `SEVERAL` derivatives are so near to theirs: measured ones have a viscous part as well."""

SEVERAL = 2


def bearers(stand: Stand) -> list[str]:
    """The damped bodies."""
    return [body.name for body in stand.bodies if body.law(Damping) is not None]


def short(stand: Stand) -> str:
    """The law in a word; empty where no body has it."""
    return NAME if bearers(stand) else ""


def warnings(stand: Stand) -> list[str]:
    """Damping that drives: with a negative coefficient on a diagonal; and products of added mass that count twice."""
    found = []
    for body in stand.bodies:
        if (law := body.law(Damping)) is not None:
            found += negative_diagonal(f"{body.name}: damping.linear", law.linear, DRIVES)
            found += negative_diagonal(f"{body.name}: damping.quadratic", law.quadratic, DRIVES)
    return [*found, *_products(stand)]


def _products(stand: Stand) -> list[str]:
    """Derivatives of the carrier that are products of its added mass, which count twice unless the file says so.

    And derivatives that the file says to contain these products where none stands at the place of one.
    """
    damping, added = stand.carrier.law(Damping), stand.carrier.added_mass
    if damping is None or added is None:
        return []
    products, published = products_of_added_mass(np.array(added)), _coefficients(damping)
    if damping.contains_products:
        return [] if any(products[key] for key in published) else [MISSING]
    near = [
        (f"{WRENCH_LETTERS[i]} {TWIST_LETTERS[j]} {TWIST_LETTERS[k]}", value, product, abs(value / product - 1.0))
        for (i, j, k), value in published.items()
        if (product := float(products[i, j, k])) and abs(value - product) <= NEAR * abs(product)
    ]
    same = [found for found in near if found[3] <= SAME]
    if not same and len(near) < SEVERAL:
        return []
    name, value, product, _ = (same or near)[0]
    more = f" (and {len(same or near) - 1} more)" if len(same or near) > 1 else ""
    return [
        f"carrier: damping.terms {name} = {value:.5g}{more} is {'' if same else 'near '}the product of added mass "
        f'{product:.5g}, which is in the equations by itself: if the derivatives contain it, write derivatives = "with '
        'added-mass products"'
    ]


MISSING = (
    'carrier: damping has derivatives = "with added-mass products", but no derivative stands where added mass has a '
    "product: none of them counts now, not even once"
)


def _coefficients(damping: Damping) -> dict[tuple[int, int, int], float]:
    """Derivatives of two velocities without bars, added up: component, lower and higher factor."""
    found: dict[tuple[int, int, int], float] = {}
    for term in damping.terms:
        if not any(factor.absolute for factor in term.of):
            first, second = sorted(factor.component for factor in term.of)
            key = (term.wrench, first, second)
            found[key] = found.get(key, 0.0) + term.value
    return found


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
