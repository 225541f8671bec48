"""Raw data of the damping of one body, as the stand file gives them, in SI."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.stand.model import TWIST_LETTERS, LawData, Mat6


@dataclass(frozen=True)
class Factor:
    """One factor of a hydrodynamic derivative: component 0..5 of V_r, or its magnitude."""

    component: int
    absolute: bool

    @property
    def letter(self) -> str:
        """Letter of SNAME, "u", or "|u|"."""
        found = TWIST_LETTERS[self.component]
        return f"|{found}|" if self.absolute else found


@dataclass(frozen=True)
class DampingTerm:
    """Hydrodynamic derivative as published: wrench component `wrench` (0..5) += value * product of the two factors."""

    wrench: int
    of: tuple[Factor, Factor]
    value: float


@dataclass(frozen=True)
class Damping(LawData):
    """Damping of one body, in its own frame, of its twist relative to the fluid V_r.

    Wrench `-(linear V_r) - (quadratic (V_r |V_r|))` (product element by element) plus the sum of `terms`.
    `None` where a matrix is absent or all zero. `contains_products`: the published `terms` contain the products of
    added mass, -Phi(V_r) Lambda V_r with Lambda of the same body, so the wrench has Phi(V_r) Lambda V_r as well: it
    takes out those that (8) has by itself.
    """

    linear: Mat6 | None
    quadratic: Mat6 | None
    terms: tuple[DampingTerm, ...]
    contains_products: bool = False

    @property
    def nonlinear(self) -> bool:
        """Whether it is not linear in the twist."""
        return self.quadratic is not None or bool(self.terms) or self.contains_products

    @property
    def takes_out_products(self) -> bool:
        """Whether `terms` have those of added mass."""
        return self.contains_products

    @property
    def has_kinks(self) -> bool:
        """Whether it depends on magnitudes of the twist."""
        return self.quadratic is not None or any(factor.absolute for term in self.terms for factor in term.of)
