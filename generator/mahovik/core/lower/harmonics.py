"""A sum of products by the harmonics of the phase: what multiplies cos phi, what sin phi, and what neither.

A formula as it is derived multiplies a column of the table by a harmonic first, and the result by what is common to all
flywheels. The other way round the products wait for no sine, and each harmonic multiplies once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mahovik.core.lower.symbolic import Binding, translate
from mahovik.core.program.expression import Expr

Term = tuple[bool, tuple[str, ...]]
"""A product of a sum: whether it is taken away, and its factors."""


def terms(formula: Any) -> list[Term]:
    """The products of a sum, in their order. Raises ValueError for a formula that is no sum of products of names."""
    match formula:
        case str():
            return [(False, (formula,))]
        case ("-", one):
            return [(not minus, factors) for minus, factors in terms(one)]
        case ("+", left, right):
            return terms(left) + terms(right)
        case ("-", left, right):
            return terms(left) + terms(("-", right))
        case ("*", left, right):
            return [(a != b, x + y) for a, x in terms(left) for b, y in terms(right)]
    raise ValueError(f"{formula} is no sum of products of names")


def by_harmonic(formula: Any, inner: Mapping[str, Any], harmonics: Sequence[str]) -> dict[str, list[Term]]:
    """Products of `formula` by the harmonic that they are multiplied with; "" has those without one.

    `inner`: formulas of the names in it that depend on the phase, such as J_p[0], each linear in the harmonics.
    """
    found: dict[str, list[Term]] = {harmonic: [] for harmonic in ("", *harmonics)}
    for outer_minus, factors in terms(formula):
        (slope,) = (f for f in factors if f in inner)
        common = tuple(f for f in factors if f != slope)
        for minus, parts in terms(inner[slope]):
            harmonic = next((f for f in parts if f in harmonics), "")
            found[harmonic].append((minus != outer_minus, (*(f for f in parts if f != harmonic), *common)))
    return found


def add_up(products: Sequence[Term], binding: Binding) -> tuple[bool, Expr]:
    """Whether the sum is to be taken away, and the sum: of products of both signs the added ones come first."""
    negative = all(minus for minus, _ in products)
    total: Expr | None = None
    for minus, factors in sorted(products, key=lambda term: term[0]):
        value = translate(factors[0], binding)
        for factor in factors[1:]:
            value = value * translate(factor, binding)
        total = value if total is None else total - value if minus and not negative else total + value
    assert total is not None
    return negative, total
