"""Quantities of which the coefficients of the products are multiples: mass, moments, added mass, weight, by name."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from itertools import product as pairs

import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Stand
from mahovik.proof.diagnose.terms.directions import FREE, Directions
from mahovik.proof.diagnose.terms.monomials import DOWN, Monomial, Motion, harmonics
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array
from mahovik.proof.reference.screw import Phi

SIMPLE = (1.0, -1.0, 2.0, -2.0, 0.5, -0.5)
"""Multiples of a quantity that occur in the equations."""

LIKELY = (0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5)
"""Factors of wrong terms that are tried where a coefficient is a sum."""

THERE = 1e-9
"""Part of the largest coefficient below which another is rounding."""

MOST_NAMES = 3
"""Names that are printed of quantities with the same value."""

_RATES = FREE.rates

Place = tuple[int, tuple[str, ...]]
"""A component of the wrench on the carrier, and the factors of a product."""

SAME = 1e-6
"""Relative difference of numbers that count as equal."""


@dataclass(frozen=True)
class Multiple:
    """Factor of a term in a program, and the right one, as multiples of a quantity; plain SI numbers without one.

    expected  None: unknown, for the equations hold more than the products; `factor` is then the error
    value     of a coefficient that is a number of the stand file, SI; 0: it is another quantity
    """

    factor: float
    expected: float | None
    coefficient: str
    value: float = 0.0


class Coefficients:
    """Right coefficients of the products in the right-hand side of K V_r* = ..., and what they are multiples of."""

    def __init__(
        self,
        products: Sequence[Monomial],
        right: Array | None,
        motion: Motion,
        at: Sequence[Pieces],
        stand: Stand,
        along: Directions = FREE,
    ) -> None:
        """`right` (m, c): of products without accelerations, NaN or None: unknown. `along`: rows of the equations."""
        self._products, self._along = products, along
        waves = list(harmonics([each.name for each in stand.flywheels], motion.phi))
        self._waves = {wave: i for i, (wave, _) in enumerate(waves)}
        base = np.column_stack([values for _, values in waves])
        bodies = np.array([p.K_bodies for p in at]).reshape(len(at), 36)
        K = np.linalg.lstsq(base, bodies, rcond=None)[0].reshape(-1, 6, 6)
        K[0] += at[0].Lambda
        self._K = along.mass(K)
        self._right = right
        self._quantities = list(_quantities(stand, K[0] - at[0].Lambda, at[0], along))

    def multiple(self, component: int, k: int, error: float) -> Multiple:
        """The factor of product k in a component, where its coefficient has this error."""
        expected = self._expected_coefficient(component, k)
        if expected is None:
            return Multiple(error, None, "")
        if not self.occurs(component, k):
            expected = 0.0
        return self.multiple_of(expected, error, component, self._products[k].factors)

    def multiple_of(self, expected: float, error: float, row: int, factors: tuple[str, ...]) -> Multiple:
        """A right coefficient that has an error in a program, as a multiple of a quantity of the stand if it is one.

        Only quantities that occur in a place name what stands there: others may have the same value, as those of
        another axis do.
        """
        component = self._along.places[row]
        place = -1 if component is None else component, factors
        if any(each.startswith(("cos ", "sin ")) for each in factors):
            own: list[Quantity] = self._quantities
        elif not expected:
            own = [each for each in self._quantities if any(other[0] == component for other in each.places)]
        else:
            own = [each for each in self._quantities if place in each.places]
            for parts in (own, [each for each in own if not each.added]):  # published derivatives may hold the products
                if _equal(expected, sum(each.places[place] * each.value for each in parts)):
                    return _name_part(expected, error, parts, place)
        return _name_multiple(expected, error, own, self._quantities)

    def occurs(self, component: int, k: int) -> bool:
        """Whether the right equations have product k in a component."""
        expected = self._expected_coefficient(component, k)
        if expected is None:
            return False
        if self._products[k].accelerates or self._right is None:
            return is_there(expected, self._K)
        return is_there(expected, np.nan_to_num(self._right[:, component]))

    def _expected_coefficient(self, component: int, k: int) -> float | None:
        of = self._products[k]
        if of.accelerates:
            wave = self._waves[of.factors[1:]]
            return -float(self._K[wave, component, self._along.rates.index(of.factors[0])])
        expected = math.nan if self._right is None else float(self._right[k, component])
        return None if math.isnan(expected) else expected


def is_there(coefficient: float, beside: Array) -> bool:
    """Whether a coefficient is more than rounding, beside others."""
    return bool(abs(coefficient) > THERE * np.abs(beside).max(initial=0.0))


def _name_multiple(expected: float, error: float, own: Sequence[Quantity], others: Sequence[Quantity]) -> Multiple:
    """The multiple of one quantity, else of one of two that make up the coefficient; else plain numbers.

    `own`: quantities that occur in this place of the equations; `others` name only what should not be there. Of
    quantities with the same value all are named.
    """
    if not expected:
        return _name_intruder(error, own) or _name_intruder(error, others) or Multiple(error, 0.0, "")
    for multiple in SIMPLE:
        if equal := [each for each in own if _equal(expected, multiple * each.value)]:
            return Multiple(_round(multiple + error / equal[0].value), multiple, _names(equal))
    rest = [m * each.value for m, each in pairs(SIMPLE, own)]
    for each in own:
        for multiple in SIMPLE:
            factor = multiple + error / each.value
            likely = any(abs(factor - x * abs(multiple)) <= SAME for x in LIKELY)
            if likely and any(_equal(expected, multiple * each.value + other) for other in rest):
                return Multiple(_round(factor), multiple, each.name)
    return Multiple(expected + error, expected, "")


def _name_part(expected: float, error: float, parts: Sequence[Quantity], place: Place) -> Multiple:
    """The part of a coefficient, the sum of these, of which a likely factor is wrong; plain numbers without one."""
    for each in parts:
        multiple = each.places[place]
        factor = multiple + error / each.value
        if len(parts) == 1 or any(abs(factor - x * abs(multiple)) <= SAME for x in LIKELY):
            return Multiple(_round(factor), multiple, each.name, each.value if each.in_file else 0.0)
    for a, b in combinations(parts, 2):
        of_a, of_b = a.places[place], b.places[place]
        whole = of_a * a.value + of_b * b.value
        if of_a * of_b == -1.0 and whole and any(abs(1.0 + error / whole - x) <= SAME for x in LIKELY):
            first, second = (a, b) if of_a > 0 else (b, a)
            return Multiple(_round(1.0 + error / whole), 1.0, f"({first.name} - {second.name})")
    return Multiple(expected + error, expected, "")


def _name_intruder(error: float, quantities: Sequence[Quantity]) -> Multiple | None:
    """A term that should not be there as a likely multiple of a quantity."""
    for likely in LIKELY:
        if likely and (equal := [x for x in quantities if abs(error / x.value - likely) <= SAME]):
            return Multiple(_round(error / equal[0].value), 0.0, _names(equal))
    return None


def _names(equal: Sequence[Quantity]) -> str:
    return " or ".join(each.name for each in equal[:MOST_NAMES])


def _equal(a: float, b: float) -> bool:
    return abs(a - b) <= SAME * max(abs(a), abs(b))


def _round(factor: float) -> float:
    """Without the rounding of the fit."""
    return round(factor, 9) + 0.0


@dataclass(frozen=True)
class Quantity:
    """A quantity of the stand, SI, and its multiples in the coefficients of products.

    `added`: it is an added mass; `in_file`: its name is a path of the stand file.
    """

    name: str
    value: float
    places: Mapping[Place, float]
    added: bool = False
    in_file: bool = False


def _quantities(stand: Stand, about_O1: Array, at: Pieces, along: Directions) -> Iterator[Quantity]:
    """Quantities of (8) by name, SI, without zeros: of the whole stand about O1, or about the pivot of a hold.

    `about_O1` (6x6): the mean of K over the phases, without added mass.
    """
    g = float(np.linalg.norm(stand.gravity))
    K, Lambda = along.at_pivot(about_O1), along.at_pivot(at.Lambda)
    moments = (g * x for x in (K[0, 0], K[5, 1], K[3, 2], K[4, 0]))
    found = [*_inertial(K, Lambda), *_of_weight("W", "G", 1.0, *moments)]
    named: dict[str, float] = {}
    for of_law in laws.of_bodies("terms", "coefficients") if along.at_origin else ():  # those of laws are about O1
        named |= of_law(stand.carrier, g)
    weightlike = [name for name in named if name.startswith("B")]
    if weightlike:
        sizes = (named.get(name, 0.0) for name in ("B", "B x_B", "B y_B", "B z_B"))
        found += _of_weight("B", "B", -1.0, *sizes)
    found += [Quantity(name, x, _of_derivative(name)) for name, x in named.items() if name not in weightlike]
    for of_stand in laws.parts("terms") if along.at_origin else ():
        for (i, letter), (path, value) in of_stand.coefficients(stand).items():
            found.append(Quantity(path, value, {(i, (letter,)): -1.0}, in_file=True))
    for wheel, J in zip(stand.flywheels, np.diag(at.Theta_ff), strict=True):
        found.append(Quantity(f"J11({wheel.name})", float(J), dict.fromkeys(_of_wheel(wheel.name), 1.0)))
    largest = max(abs(each.value) for each in found)
    yield from (each for each in found if abs(each.value) > 1e-14 * largest)


def _inertial(K: Array, Lambda: Array) -> Iterator[Quantity]:
    """Mass, first moments, moments of inertia, added masses, each where Phi K V and K V* have it."""

    def inertia(name: str, value: float, *elements: tuple[int, int, float]) -> Quantity:
        unit = np.zeros((6, 6))
        for i, j, sign in elements:
            unit[i, j] = unit[j, i] = sign
        return Quantity(name, value, dict(_places_of(unit)), name.endswith("dot"))

    yield inertia("m", float(K[0, 0]), (0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0))
    yield inertia("m x_G", float(K[5, 1]), (1, 5, 1.0), (2, 4, -1.0))  # m <rc>: rows of moments, columns of forces
    yield inertia("m y_G", float(K[3, 2]), (2, 3, 1.0), (0, 5, -1.0))
    yield inertia("m z_G", float(K[4, 0]), (0, 4, 1.0), (1, 3, -1.0))
    for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)):
        sign = 1.0 if i == j else -1.0
        yield inertia(f"I_{'xyz'[i]}{'xyz'[j]}", sign * float(K[3 + i, 3 + j]), (3 + i, 3 + j, sign))
    for i in range(6):
        for j in range(i, 6):
            name, twin = (f"{WRENCH_LETTERS[a]}_{TWIST_LETTERS[b]}dot" for a, b in ((i, j), (j, i)))
            value, place = -float(Lambda[i, j]), (j, (_RATES[i],))
            of = inertia(name, value, (i, j, -1.0))
            if i == j:
                yield of
            else:  # each component has the derivative of its own letter before an acceleration
                yield replace(of, places={k: x for k, x in of.places.items() if k != place})
                yield Quantity(twin, value, {place: of.places[place]}, added=True)


def _places_of(unit: Array) -> Iterator[tuple[Place, float]]:
    """Products in -Phi(V) B V and in -B V*, of B (6x6), and their factors."""
    for component, row in enumerate(unit):
        yield from (((component, (_RATES[j],)), -float(row[j])) for j in np.flatnonzero(row))
    axes = np.eye(6)
    for a in range(6):
        for b in range(a, 6):
            wrench = Phi(axes[a]) @ unit @ axes[b] + (a != b) * (Phi(axes[b]) @ unit @ axes[a])
            product = TWIST_LETTERS[a], TWIST_LETTERS[b]
            yield from (((int(i), product), -float(wrench[i])) for i in np.flatnonzero(wrench))


def _of_weight(force: str, point: str, sign: float, size: float, x: float, y: float, z: float) -> Iterator[Quantity]:
    """A force along or against gravity, and its first moments: r x g."""
    yield Quantity(force, float(size), {(i, (DOWN[i],)): sign for i in range(3)})
    for i, value in enumerate((x, y, z)):
        a, b = (i + 1) % 3, (i + 2) % 3
        places: dict[Place, float] = {(3 + a, (DOWN[b],)): -sign, (3 + b, (DOWN[a],)): sign}
        yield Quantity(f"{force} {'xyz'[i]}_{point}", float(value), places)


def _of_derivative(name: str) -> Mapping[Place, float]:
    """The place of a hydrodynamic derivative, such as N_|r|r."""
    letter, _, product = name.partition("_")
    factors = re.findall(r"\|.\||.", product)
    component = WRENCH_LETTERS.index(letter)
    return {(component, tuple(factors)): 1.0, (component, tuple(reversed(factors))): 1.0}


def _of_wheel(name: str) -> Iterator[Place]:
    """Products with the speed or acceleration of a flywheel, in any component."""
    speeds = [(f"{name}.acceleration",), *((a, f"{name}.speed") for a in TWIST_LETTERS)]
    yield from ((component, each) for component in range(6) for each in speeds)
