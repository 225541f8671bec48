"""Quantities of which the coefficients of the products are multiples: mass, moments, added mass, weight, by name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product as pairs

import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.proof.diagnose.terms.monomials import ACCELERATIONS, Monomial, Motion, harmonics
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array

SIMPLE = (1.0, -1.0, 2.0, -2.0, 0.5, -0.5)
"""Multiples of a quantity that occur in the equations."""

LIKELY = (0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5)
"""Factors of wrong terms that are tried where a coefficient is a sum."""

THERE = 1e-9
"""Part of the largest coefficient below which another is rounding."""

SAME = 1e-6
"""Relative difference of numbers that count as equal."""


@dataclass(frozen=True)
class Multiple:
    """Factor of a term in a program, and the right one, as multiples of a quantity; plain SI numbers without one.

    expected  None: unknown, for the equations hold more than the products; `factor` is then the error
    """

    factor: float
    expected: float | None
    coefficient: str


class Coefficients:
    """Right coefficients of the products in the right-hand side of K V_r* = ..., and what they are multiples of."""

    def __init__(
        self, products: Sequence[Monomial], right: Array | None, motion: Motion, at: Sequence[Pieces], stand: Stand
    ) -> None:
        """`right` (m, 6): of products without accelerations, or None: unknown."""
        self._products = products
        waves = list(harmonics([each.name for each in stand.flywheels], motion.phi))
        self._waves = {wave: i for i, (wave, _) in enumerate(waves)}
        base = np.column_stack([values for _, values in waves])
        bodies = np.array([p.K_bodies for p in at]).reshape(len(at), 36)
        self._K = np.linalg.lstsq(base, bodies, rcond=None)[0].reshape(-1, 6, 6)
        self._K[0] += at[0].Lambda
        self._right = right
        self._quantities = dict(_quantities(stand, self._K[0] - at[0].Lambda, at[0]))

    def multiple(self, component: int, k: int, error: float) -> Multiple:
        """The factor of product k in a component, where its coefficient has this error."""
        expected = self._expected_coefficient(component, k)
        if expected is None:
            return Multiple(error, None, "")
        return self.multiple_of(expected, error)

    def multiple_of(self, expected: float, error: float) -> Multiple:
        """A right coefficient that has an error in a program, as a multiple of a quantity of the stand if it is one."""
        return _name_multiple(expected, error, self._quantities)

    def occurs(self, component: int, k: int) -> bool:
        """Whether the right equations have product k in a component."""
        expected = self._expected_coefficient(component, k)
        beside = self._K if self._products[k].accelerates or self._right is None else self._right[:, component]
        return expected is not None and is_there(expected, beside)

    def _expected_coefficient(self, component: int, k: int) -> float | None:
        of = self._products[k]
        if of.accelerates:
            wave = self._waves[of.factors[1:]]
            return -float(self._K[wave, component, ACCELERATIONS.index(of.factors[0])])
        return None if self._right is None else float(self._right[k, component])


def is_there(coefficient: float, beside: Array) -> bool:
    """Whether a coefficient is more than rounding, beside others."""
    return bool(abs(coefficient) > THERE * np.abs(beside).max(initial=0.0))


def _name_multiple(expected: float, error: float, quantities: dict[str, float]) -> Multiple:
    """The multiple of one quantity, else of one of two that make up the coefficient; else plain numbers."""
    if abs(expected) <= SAME * abs(error):
        expected = 0.0
    if expected:
        for name, value in quantities.items():
            for multiple in SIMPLE:
                if _equal(expected, multiple * value):
                    return Multiple(_round(multiple + error / value), multiple, name)
    others = [0.0, *(m * other for m, other in pairs(SIMPLE, quantities.values()))] if expected else [0.0]
    for name, value in quantities.items():
        for multiple in SIMPLE if expected else (0.0,):
            factor = multiple + error / value
            likely = any(abs(factor - each * abs(multiple or 1.0)) <= SAME for each in LIKELY)
            if likely and any(_equal(expected, multiple * value + other) for other in others):
                return Multiple(_round(factor), multiple, name)
    return Multiple(expected + error, expected, "")


def _equal(a: float, b: float) -> bool:
    return abs(a - b) <= SAME * max(abs(a), abs(b))


def _round(factor: float) -> float:
    """Without the rounding of the fit."""
    return round(factor, 9) + 0.0


def _quantities(stand: Stand, K: Array, at: Pieces) -> Iterator[tuple[str, float]]:
    """Quantities of (8) by name, SI, without zeros: of the whole stand about O1, K (6x6) its mean over the phases."""
    m = float(K[0, 0])
    g = float(np.linalg.norm(stand.gravity))
    first = (float(K[5, 1]), float(K[3, 2]), float(K[4, 0]))  # m <rc>: rows of moments, columns of forces
    found = {"m": m}
    found |= {f"m {axis}_G": x for axis, x in zip("xyz", first, strict=True)}
    for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)):
        found[f"I_{'xyz'[i]}{'xyz'[j]}"] = float(K[3 + i, 3 + j]) * (1.0 if i == j else -1.0)
    for i in range(6):
        for j in range(i, 6):
            found[f"{WRENCH_LETTERS[i]}_{TWIST_LETTERS[j]}dot"] = -float(at.Lambda[i, j])
    found |= {"W": m * g} | {f"W {axis}_G": g * x for axis, x in zip("xyz", first, strict=True)}
    for of_law in laws.of_bodies("faults", "coefficients"):
        found |= of_law(stand.carrier, g)
    found |= {f"J11({wheel.name})": float(J) for wheel, J in zip(stand.flywheels, np.diag(at.Theta_ff), strict=True)}
    largest = max(abs(x) for x in found.values())
    yield from ((name, x) for name, x in found.items() if abs(x) > 1e-14 * largest)
