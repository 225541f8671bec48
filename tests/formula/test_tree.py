"""Formulas as data: indexed as SymPy's matrices, renamed, and through JSON without a loss."""

from __future__ import annotations

import json
from types import SimpleNamespace

import pytest
import sympy as sp

from mahovik.core.formula.tree import Matrix, as_json, from_json, names_of, rename_symbols

SUM = ("+", ("*", 2.0, "mu[0]"), ("-", "c"))
VALUES = (
    "phi_dot",
    0.1,
    -0.0,
    SUM,
    Matrix(1, 2, (SUM, "J[10]")),
    (Matrix(1, 1, ("a",)), SUM),
    {"0": SUM, "2c": "b"},
    SimpleNamespace(b=Matrix(1, 1, ("a",)), m=0.0),
)


@pytest.mark.parametrize("value", VALUES, ids=str)
def test_json_keeps_everything(value: object) -> None:
    back = from_json(json.loads(json.dumps(as_json(value))))
    assert back == value
    assert repr(back) == repr(value)  # -0.0 as well


@pytest.mark.parametrize(
    "value",
    [
        None,
        1,
        "a b",
        "__import__('os')",
        "mu[x]",
        ["/", "a", "b"],
        ["+", "a"],
        [],
        {"matrix": [2, 2], "elements": ["a"]},
        {"record": []},
        {"what": 1},
    ],
    ids=str,
)
def test_other_json_is_refused(value: object) -> None:
    with pytest.raises((ValueError, TypeError)):
        from_json(value)


@pytest.mark.parametrize(
    "index", [(1, slice(None)), (slice(None, 2), slice(None)), (slice(None), slice(1, 3))], ids=str
)
def test_a_block_is_taken_as_in_sympy(index: tuple[int | slice, slice]) -> None:
    names = [f"a[{i}]" for i in range(12)]
    expected = sp.Matrix(4, 3, [sp.Symbol(name) for name in names])[index]
    found = Matrix(4, 3, tuple(names))[index]
    assert (found.rows, found.columns) == expected.shape
    assert list(found) == [x.name for x in expected]


def test_names_are_replaced_everywhere() -> None:
    assert rename_symbols(SUM, {"mu[0]": "mu[1]", "c": "s"}) == ("+", ("*", 2.0, "mu[1]"), ("-", "s"))
    assert names_of(SUM) == {"mu[0]", "c"}
