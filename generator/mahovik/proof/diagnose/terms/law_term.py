"""A coefficient of a law of a body, as something that a program may have wrong by itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mahovik.core.stand.model import TWIST_LETTERS, Body, Stand
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.rotation import Pose


@dataclass(frozen=True, eq=False)
class LawTerm:
    """A part of the wrench of a law that is proportional to one coefficient.

    detail       0: the coarsest parts of the law; parts of one detail add up to it, and are looked for together
    term         what the coefficient stands before, in words
    coefficient  path of the coefficient in the stand file, from the body on
    value        the right one, SI
    wrench       (n, 6; N, N m) where the coefficient is one, in the body's frame, at n states
    """

    detail: int
    term: str
    coefficient: str
    value: float
    wrench: Array


@dataclass(frozen=True)
class BodyFaults:
    """Terms of a law of bodies: of one body, as it is at n states, with its twists V_r (n, 6) relative to the fluid."""

    kind: str
    terms: Callable[[Sequence[Body], Array], list[LawTerm]]


@dataclass(frozen=True)
class CarrierFaults:
    """Terms of a law between E0 and the carrier: of a stand, at n poses."""

    kind: str
    terms: Callable[[Stand, Sequence[Pose]], list[LawTerm]]


def matrix_terms(factor: str, coefficient: str, values: Sequence[Sequence[float]], products: Array) -> list[LawTerm]:
    """The elements of a 6x6 matrix of damping -values V, V (n, 6) the products, written as `factor` and a letter."""
    found = []
    for j, letter in enumerate(TWIST_LETTERS):
        for i in range(6):
            wrench = np.zeros((len(products), 6))
            wrench[:, i] = -products[:, j]
            path = f"{coefficient}[{i}][{j}]"
            found.append(LawTerm(0, f"{factor} {letter}", path, float(values[i][j]), wrench))
    return found
