"""Coefficients of the laws of carrier and instruments as columns beside the products, component by component."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mahovik.contract import laws
from mahovik.core.stand.model import Stand
from mahovik.proof.diagnose.terms.coefficients import Multiple
from mahovik.proof.diagnose.terms.fit import Columns
from mahovik.proof.diagnose.terms.law_term import LawTerm
from mahovik.proof.diagnose.terms.monomials import Monomial
from mahovik.proof.reference import Pieces
from mahovik.proof.reference.array import Array

ALIKE = 1e-10
"""Sine of the angle between columns below which they are one."""

KINDS = (*laws.of_bodies("terms", "KIND"), *(part.KIND for part in laws.parts("terms")))
"""Kinds of wrench whose coefficients are columns of their own."""


@dataclass(frozen=True, eq=False)
class LawColumn:
    """A column of one component of the wrench on the carrier, and the coefficient that it belongs to.

    product      its name and values, of which the right ones are `right` times
    coefficient  path in the stand file; of several that no state tells apart: joined by "or"
    """

    product: Monomial
    coefficient: str
    right: float

    def multiple(self, error: float) -> Multiple:
        """The factor of the coefficient, where that of the column has this error."""
        if not self.right:
            return Multiple(error, 0.0, "")
        return Multiple(round(1.0 + error / self.right, 9) + 0.0, 1.0, self.coefficient, self.right)


class LawColumns:
    """Columns of all laws at n states, from coarse to fine."""

    def __init__(self, stand: Stand, at: Sequence[Pieces], rows: Array) -> None:
        """`rows` (6 x c): components are rows^T of a wrench on the carrier, in E1 about O1."""
        self._stand, self._at, self._rows = stand, at, rows

    @property
    def there(self) -> bool:
        """Whether the stand has any."""
        return any(any(kind in self._at[0].terms[k.body.name] for kind in KINDS) for k in self._at[0].fixed)

    def of(self, component: int) -> Iterator[list[LawColumn]]:
        """Columns of a component: the coarse parts of each law; then finer ones, where some law has them."""
        if not self.there:
            return
        terms = self._terms
        last = [max(term.detail for _, _, term in of_law) for of_law in terms]
        for detail in range(max(last) + 1):
            chosen = [
                (name, L, term)
                for of_law, most in zip(terms, last, strict=True)
                for name, L, term in of_law
                if term.detail == min(detail, most)
            ]
            row = self._rows[:, component]
            yield _merge([_column(name, row @ L, term) for name, L, term in chosen])

    @cached_property
    def _terms(self) -> list[list[tuple[str, Array, LawTerm]]]:
        """The parts of each law of each body, with the name of the body and its L (6x6)."""
        between = (part.law_terms(self._stand, self._at) for part in laws.parts("terms"))
        found = [[("carrier", np.eye(6), term) for term in terms] for terms in between if terms]
        for s, k in enumerate(self._at[0].fixed):
            bodies = [p.fixed[s].body for p in self._at]
            V_r = np.array([p.fixed[s].twist(p.V_r) for p in self._at])
            for law_terms in laws.of_bodies("terms", "law_terms"):
                if terms := law_terms(bodies, V_r):
                    found.append([(k.body.name, k.L, term) for term in terms])
        return found


def _column(body: str, row: Array, term: LawTerm) -> LawColumn:
    """A part of a law in the component that `row` (6) takes of the wrench on the body."""
    fixed = "" if body == "carrier" else f"{body}: "
    of_body = term.coefficient.startswith(("cross_flow", "fading_damping"))
    path = f"{body}.{term.coefficient}" if of_body else term.coefficient
    values = np.asarray(term.wrench @ row, dtype=np.float64)
    return LawColumn(Monomial((f"{fixed}{term.term}",), values, accelerates=False), path, term.value)


def _merge(columns: Sequence[LawColumn]) -> list[LawColumn]:
    """Without columns that are zero; columns that are proportional at all states are one, with all their names."""
    sizes = np.array([np.linalg.norm(each.product.values) for each in columns])
    largest = sizes.max(initial=0.0)
    found: list[LawColumn] = []
    for each, size in zip(columns, sizes.tolist(), strict=True):
        if size <= ALIKE * largest:
            continue
        for i, other in enumerate(found):
            a, b = other.product.values, each.product.values
            ratio = float(a @ b) / float(a @ a)
            if np.linalg.norm(b - ratio * a) <= ALIKE * size:
                found[i] = _join(other, each, ratio)
                break
        else:
            found.append(each)
    return found


def _join(one: LawColumn, other: LawColumn, ratio: float) -> LawColumn:
    """Two columns in one: of those that the right equations have, where only one of them is there."""
    if not other.right:
        return one
    if not one.right:
        return LawColumn(
            Monomial(other.product.factors, one.product.values, accelerates=False),
            other.coefficient,
            ratio * other.right,
        )
    names = (f"{one.product.term} or {other.product.term}",)
    coefficient = f"{one.coefficient} or {other.coefficient}"
    return LawColumn(
        Monomial(names, one.product.values, accelerates=False), coefficient, one.right + ratio * other.right
    )


def widen(columns: Columns, of_laws: Sequence[LawColumn]) -> tuple[Columns, list[LawColumn]]:
    """Columns with those of laws that are independent of them, behind them."""
    if not of_laws:
        return columns, []
    wide, kept = columns.widen(np.column_stack([each.product.values for each in of_laws]))
    return wide, [of_laws[i] for i in kept]
