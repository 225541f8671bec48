"""`damping` of a body in the stand file: linear, quadratic, and hydrodynamic derivatives of its own twist."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from mahovik.core.stand.declare import AS_MATRIX, BRAKES, TIMES, Declared, Draw, Size, Tables
from mahovik.core.stand.fields import LINEAR, QUADRATIC, ZERO6, letter, matrix, one_word, validator
from mahovik.core.stand.law import BodyLaw, TermTable, Velocity, texts, velocity
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Body, Carrier, Mat6, Stand
from mahovik.core.stand.tables import Default, Table
from mahovik.core.stand.units import QuantityError, show

WITHOUT_PRODUCTS = "without added-mass products"
WITH_PRODUCTS = "with added-mass products"
"""Word for published derivatives that contain the products of added mass."""


def _factors(raw: object) -> tuple[Velocity, Velocity]:
    if not isinstance(raw, list) or len(raw) != 2:
        shown = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected two factors such as ["r", "|v|"], found {shown}')
    factors = []
    for item in raw:
        if (factor := velocity(item)) is None:
            raise QuantityError(f"expected one of {' '.join(TWIST_LETTERS)}, with or without bars, found {show(item)}")
        factors.append(factor)
    return factors[0], factors[1]


@dataclass(frozen=True)
class DampingTerm(Declared):
    """Hydrodynamic derivative as published: a component of the wrench += value times the product of two factors.

    wrench  component of the wrench: force along, moment about the three axes
    of      two of the components `u v w p q r` of `V_r`, with or without bars (`"|v|"`), such as `["u", "r"]`
    """

    wrench: Annotated[int, letter(WRENCH_LETTERS)]
    of: Annotated[tuple[Velocity, Velocity], validator(_factors, write=texts)]
    value: Annotated[float, TIMES]

    keys: ClassVar[type[Table]] = TermTable


class DampingTable(Table):
    """Whether the derivatives contain the products of added mass.

    derivatives  of the carrier: whether the published `terms` contain the products of added mass
    """

    derivatives: Annotated[bool, one_word({WITH_PRODUCTS: True, WITHOUT_PRODUCTS: False})] = False


@dataclass(frozen=True)
class Damping(BodyLaw):
    """Damping of one body, in its own frame, of its twist relative to the fluid V_r.

    A matrix is None where it is absent or all zero. `contains_products`: the published `terms` contain the products of
    added mass, -Phi(V_r) Lambda V_r with Lambda of the same body, so the wrench has Phi(V_r) Lambda V_r as well: it
    takes out those that (8) has by itself.

    linear     wrench `-(linear V_r)`
    quadratic  wrench `-(quadratic (V_r |V_r|))`, product element by element
    terms      hydrodynamic derivatives as published, each `{ wrench = "Y", of = ["u", "r"], value = -3.1 }`
    """

    linear: Annotated[Mat6 | None, matrix(LINEAR), Default(None), BRAKES, AS_MATRIX]
    quadratic: Annotated[Mat6 | None, matrix(QUADRATIC), Default(None), BRAKES, AS_MATRIX]
    terms: Annotated[tuple[DampingTerm, ...], Tables(DampingTerm), Default((), written=False)]
    contains_products: bool = False

    key: ClassVar[str] = "damping"
    keys: ClassVar[type[Table]] = DampingTable
    optional: ClassVar[bool] = False
    newer: ClassVar[tuple[str, ...]] = ("contains_products",)

    @property
    def is_round(self) -> bool:
        """Whether each 3x3 of `linear` commutes with turns about the first axis, and nothing else acts across it."""
        if self.terms or self.contains_products:
            return False
        D, Q = np.array(self.linear or ZERO6), np.array(self.quadratic or ZERO6)
        along, across = [0, 3], [1, 2, 4, 5]
        turned = np.kron(np.eye(2), np.array([[0.0, -1.0], [1.0, 0.0]]))  # by a quarter
        inner = D[np.ix_(across, across)]
        mixed = (*(M[np.ix_(*pair)] for M in (D, Q) for pair in ((along, across), (across, along))),)
        return not any(map(np.any, (*mixed, Q[np.ix_(across, across)], inner @ turned - turned @ inner)))

    @property
    def nonlinear(self) -> bool:
        """Whether it is not linear in the twist."""
        return self.quadratic is not None or bool(self.terms) or self.contains_products

    @property
    def has_kinks(self) -> bool:
        """Whether it depends on magnitudes of the twist."""
        return self.quadratic is not None or any(factor.absolute for term in self.terms for factor in term.of)

    @property
    def acts(self) -> bool:
        """Whether anything damps."""
        return self.linear is not None or self.nonlinear

    @property
    def matrices(self) -> dict[str, Mat6]:
        """The matrices that there are, in which the equations are linear."""
        result = {"linear": self.linear, "quadratic": self.quadratic}
        return {name: rows for name, rows in result.items() if rows is not None}

    @classmethod
    def of_table(cls, table: Any, **more: object) -> Self:
        """The damping, without derivatives that are zero."""
        damping = super().of_table(table, contains_products=table.derivatives, **more)
        return replace(damping, terms=tuple(term for term in damping.terms if term.value))

    def as_keys(self) -> dict[str, object]:
        """Matrices and terms, those that there are."""
        return super().as_keys() | ({"derivatives": WITH_PRODUCTS} if self.contains_products else {})

    @classmethod
    def structure(cls, stand: Stand) -> dict[str, object]:
        """Body indices of each kind of damping, and what each hydrodynamic derivative is made of.

        Without derivatives that contain the products of added mass their key is missing, as other stands have it.
        """
        damped = [(i, damping) for i, _, damping in cls.of(stand)]
        result: dict[str, object] = {
            "linear_damping": tuple(i for i, damping in damped if damping.linear is not None),
            "quadratic_damping": tuple(i for i, damping in damped if damping.quadratic is not None),
            "damping_terms": tuple(
                (i, tuple((term.wrench, term.of) for term in damping.terms)) for i, damping in damped if damping.terms
            ),
        }
        products = tuple(i for i, damping in damped if damping.contains_products)
        return result | ({"products_in_derivatives": products} if products else {})

    def problem(self, body: Body) -> tuple[str, str] | None:
        """Where the derivatives cannot contain products of added mass: the body has none about its origin."""
        if not self.contains_products:
            return None
        if not isinstance(body, Carrier):
            return "damping", f'derivatives = "{WITH_PRODUCTS}" is for the carrier only, expected no such key'
        if body.added_mass is None:
            words = "but the carrier has no added mass, expected `added_mass`"
            return "damping", f'derivatives = "{WITH_PRODUCTS}", {words}'
        return None

    @classmethod
    def random_with(cls, draw: Draw, of: Size) -> Self | None:
        """Damping by matrices and terms for a body of the mean mass."""
        rng, mean = draw.rng, of.mean
        linear, quadratic = draw.definite6(0.8 * mean), draw.definite6(0.6 * mean)
        terms = tuple(
            DampingTerm(
                int(rng.integers(6)),
                (
                    Velocity(int(rng.integers(6)), bool(rng.random() < 0.3)),
                    Velocity(int(rng.integers(6)), bool(rng.random() < 0.5)),
                ),
                float(rng.normal() * 0.2 * mean),
            )
            for _ in range(int(rng.integers(4)))
        )
        with_linear, with_quadratic = rng.random(2) < 0.7
        return cls(
            linear if with_linear or not (with_quadratic or terms) else None,
            quadratic if with_quadratic else None,
            terms,
        )

    @classmethod
    def warnings(cls, stand: Stand) -> list[str]:
        """Damping that drives, with a negative coefficient on a diagonal; products of added mass that count twice."""
        return [*super().warnings(stand), *_products(stand)]


SAME = 0.03
"""Relative difference below which a derivative counts as the product of added mass of the same name."""

NEAR = 0.25
"""Likewise where `SEVERAL` derivatives are so near to theirs: measured ones have a viscous part as well."""

SEVERAL = 2


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
    same = [row for row in near if row[3] <= SAME]
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
    coefficients: dict[tuple[int, int, int], float] = {}
    for term in damping.terms:
        if not any(factor.absolute for factor in term.of):
            first, second = sorted(factor.component for factor in term.of)
            key = (term.wrench, first, second)
            coefficients[key] = coefficients.get(key, 0.0) + term.value
    return coefficients


def products_of_added_mass(added: NDArray[np.float64]) -> NDArray[np.float64]:
    """Coefficients (6, 6, 6), SI, of V_j V_k, j <= k, in the wrench of the fluid beside the accelerations.

    Force p x omega and moment p x v + h x omega, where (p, h) = Lambda V.
    """
    products = np.zeros((6, 6, 6))
    unit = np.eye(6)
    for j in range(6):
        for k in range(6):
            p, h = added[:3, j], added[3:, j]
            v, omega = unit[k, :3], unit[k, 3:]
            wrench = np.concatenate([np.cross(p, omega), np.cross(p, v) + np.cross(h, omega)])
            products[:, min(j, k), max(j, k)] += wrench
    return products


LAW = Damping
