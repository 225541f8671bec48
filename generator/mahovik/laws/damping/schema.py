"""`damping` of a body in the stand file."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any

from pydantic import Field, model_validator

from mahovik.core.stand.fields import LinearDamping6, QuadraticDamping6, Table, refuse, text, validator
from mahovik.core.stand.law import BodyLawSchema
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, Body, Carrier, Stand
from mahovik.core.stand.toml import line_of, value_of
from mahovik.core.stand.units import Dimension, QuantityError, number, show
from mahovik.laws.damping.data import Damping, DampingTerm, Factor


def _letter(letters: tuple[str, ...]) -> Callable[[Any], int]:
    def read(raw: Any) -> int:
        if text(raw) not in letters:
            raise QuantityError(f"expected one of {' '.join(letters)}, found {show(raw)}")
        return letters.index(raw)

    return read


def _factors(raw: Any) -> tuple[Factor, Factor]:
    if not isinstance(raw, list) or len(raw) != 2:
        found = f"{len(raw)}" if isinstance(raw, list) else show(raw)
        raise QuantityError(f'expected two factors such as ["r", "|v|"], found {found}')
    read = _letter(TWIST_LETTERS)
    factors = []
    for item in raw:
        bars = len(text(item)) == 3 and item[0] == item[2] == "|"
        try:
            factors.append(Factor(read(item[1] if bars else item), bars))
        except QuantityError:
            letters = " ".join(TWIST_LETTERS)
            raise QuantityError(f"expected one of {letters}, with or without bars, found {show(item)}") from None
    return factors[0], factors[1]


class TermTable(Table):
    """One of `damping.terms`: a hydrodynamic derivative."""

    wrench: Annotated[int, validator(_letter(WRENCH_LETTERS))]
    of: Annotated[tuple[Factor, Factor], validator(_factors)]
    value: Any

    @model_validator(mode="after")
    def _value_in_si(self) -> TermTable:
        """The unit of a derivative follows from the wrench component and the two factors."""
        angular = sum(factor.component >= 3 for factor in self.of)
        moment = "N m" if self.wrench >= 3 else "N"
        per = {0: "s^2/m^2", 1: "s^2/m/rad", 2: "s^2/rad^2"}[angular]
        try:
            value = number(self.value, Dimension("a hydrodynamic derivative", f"{moment} {per}"))
        except QuantityError as error:
            raise refuse(str(error), "value") from None
        object.__setattr__(self, "value", value)
        return self


WITHOUT_PRODUCTS = "without added-mass products"
WITH_PRODUCTS = "with added-mass products"
"""Word for published derivatives that contain the products of added mass."""


def _derivatives(raw: Any) -> bool:
    """Whether the derivatives contain the products of added mass."""
    if text(raw) not in (WITHOUT_PRODUCTS, WITH_PRODUCTS):
        raise QuantityError(f'expected "{WITH_PRODUCTS}" or "{WITHOUT_PRODUCTS}", found {show(raw)}')
    return bool(raw == WITH_PRODUCTS)


class DampingTable(Table):
    """`damping` of a body."""

    linear: LinearDamping6 = None
    quadratic: QuadraticDamping6 = None
    terms: list[TermTable] = Field(default_factory=list)
    derivatives: Annotated[bool, validator(_derivatives)] = False


def read(given: DampingTable) -> Damping | None:
    """The data; None where nothing damps."""
    terms = tuple(DampingTerm(term.wrench, term.of, term.value) for term in given.terms if term.value)
    if given.linear is None and given.quadratic is None and not terms and not given.derivatives:
        return None
    return Damping(given.linear, given.quadratic, terms, given.derivatives)


def lines(damping: Damping) -> list[str]:
    """Matrices and terms, those that there are."""
    found = [
        line_of(key, getattr(damping, key)) for key in ("linear", "quadratic") if getattr(damping, key) is not None
    ]
    if damping.terms:
        terms = (
            f'{{ wrench = "{WRENCH_LETTERS[term.wrench]}", of = {value_of([factor.letter for factor in term.of])}, '
            f"value = {term.value!r} }}"
            for term in damping.terms
        )
        found.append(f"terms = [{', '.join(terms)}]")
    if damping.contains_products:
        found.append(line_of("derivatives", WITH_PRODUCTS))
    return found


def structure(stand: Stand) -> dict[str, Any]:
    """Body indices of each kind of damping, and what each hydrodynamic derivative is made of.

    Without derivatives that contain the products of added mass their key is missing, as other stands have it.
    """
    damped = [(i, damping) for i, body in enumerate(stand.bodies) if (damping := body.law(Damping)) is not None]
    found = {
        "linear_damping": tuple(i for i, damping in damped if damping.linear is not None),
        "quadratic_damping": tuple(i for i, damping in damped if damping.quadratic is not None),
        "damping_terms": tuple(
            (i, tuple((term.wrench, term.of) for term in damping.terms)) for i, damping in damped if damping.terms
        ),
    }
    products = tuple(i for i, damping in damped if damping.contains_products)
    return found | ({"products_in_derivatives": products} if products else {})


def problem(body: Body, damping: Damping) -> tuple[str, str] | None:
    """Key and words where the derivatives cannot contain products of added mass: the body has none about its origin."""
    if not damping.contains_products:
        return None
    if not isinstance(body, Carrier):
        return "damping", f'derivatives = "{WITH_PRODUCTS}" is for the carrier only, expected no such key'
    if body.added_mass is None:
        return "damping", f'derivatives = "{WITH_PRODUCTS}", but the carrier has no added mass, expected `added_mass`'
    return None


SCHEMA = BodyLawSchema(Damping, "damping", DampingTable, read, lines, structure, problem=problem)
