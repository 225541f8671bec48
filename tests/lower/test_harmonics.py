"""Sums by harmonics are the sums that they were made of."""

from __future__ import annotations

import numpy as np
import pytest
from mahovik.core.lower.harmonics import add_up, by_harmonic, terms

from mahovik.core.formula.tree import names_of
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, Kind

SLOPE = ("-", ("+", ("*", "a", "c"), "d"), ("*", "b", "s"))
"""a c + d - b s"""


def test_products_keep_their_signs_and_their_order() -> None:
    assert terms(("-", "x", ("-", ("*", "y", "z"), "w"))) == [(False, ("x",)), (True, ("y", "z")), (False, ("w",))]


def test_a_product_of_sums_has_all_products() -> None:
    found = terms(("*", ("-", "a", "b"), ("+", "c", "d")))
    assert found == [(False, ("a", "c")), (False, ("a", "d")), (True, ("b", "c")), (True, ("b", "d"))]


def test_what_is_no_name_is_refused() -> None:
    with pytest.raises(ValueError, match="is no sum of products of names"):
        terms(("*", 2.0, "x"))


def test_each_harmonic_gets_what_it_multiplies() -> None:
    found = by_harmonic(("-", ("*", "f", "u"), ("*", "v", "f")), {"f": SLOPE}, ("c", "s"))
    assert found == {
        "": [(False, ("d", "u")), (True, ("d", "v"))],
        "c": [(False, ("a", "u")), (True, ("a", "v"))],
        "s": [(True, ("b", "u")), (False, ("b", "v"))],
    }


def test_the_sum_by_harmonics_is_the_sum() -> None:
    """Small integers: every order of the operations gives the same number."""
    formula = ("-", ("*", "f", "u"), ("*", "v", "f"))
    names = sorted({*names_of(formula), *names_of(SLOPE)} - {"f"})
    arguments = [Argument(name, Kind.REAL) for name in names]
    binding = {a.name: a.place for a in arguments}
    body = Body()
    total = None
    for harmonic, products in by_harmonic(formula, {"f": SLOPE}, ("c", "s")).items():
        negative, value = add_up(products, binding)
        part = value * binding[harmonic] if harmonic else value
        part = -part if negative else part
        total = part if total is None else total + part
    assert total is not None
    body.ret(total)
    function = Function("total", "The sum.", tuple(arguments), body.statements, returns=Kind.REAL)
    interpreter = Interpreter(Program("sums", DOUBLE, (), (), (function,)))
    rng = np.random.default_rng(1)
    for _ in range(20):
        x = {name: float(rng.integers(-9, 10)) for name in names}
        slope = x["a"] * x["c"] + x["d"] - x["b"] * x["s"]
        assert interpreter.call("total", *(x[name] for name in names)) == slope * x["u"] - x["v"] * slope


def test_a_sum_of_what_is_taken_away_says_so() -> None:
    a, b = (Argument(name, Kind.REAL) for name in "ab")
    binding = {"a": a.place, "b": b.place}
    assert add_up([(True, ("a",)), (True, ("b",))], binding)[0]
    assert not add_up([(True, ("a",)), (False, ("b",))], binding)[0]
