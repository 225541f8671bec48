"""The order of operations is ours: positive terms first, then by the names, whatever SymPy does."""

from __future__ import annotations

import pytest
import sympy as sp

from mahovik.core.formula.ordering import to_formulas
from mahovik.core.formula.tree import Formula

a, b, c, s = sp.symbols("a b c s")
x2, x10 = sp.symbols("x[2] x[10]")


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (b + a, ("+", "a", "b")),
        (-a + b, ("-", "b", "a")),
        (-a - b, ("-", ("-", "a"), "b")),
        (x10 + x2, ("+", "x[2]", "x[10]")),
        (b * a, ("*", "a", "b")),
        (c * x2, ("*", "x[2]", "c")),
        (-b * a, ("*", ("-", "a"), "b")),
        (b * a / 2, ("*", ("*", 0.5, "a"), "b")),
        (a**3, ("*", ("*", "a", "a"), "a")),
        (s * (a - b), ("*", ("-", "a", "b"), "s")),
        (sp.Integer(0), 0.0),
    ],
    ids=str,
)
def test_the_order(expression: sp.Expr, expected: Formula) -> None:
    assert to_formulas(expression) == expected


@pytest.mark.parametrize("expression", [a / b, sp.sqrt(a), sp.sin(a)], ids=str)
def test_what_no_program_can_do_is_refused(expression: sp.Expr) -> None:
    with pytest.raises(TypeError, match="no form in a program"):
        to_formulas(expression)
