"""Loops of one turn and of none go; results keep their bits."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.program.build import Body
from mahovik.core.program.expression import Place, integer, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.short_loops import without_short_loops
from mahovik.core.program.types import Kind, NamedCount
from mahovik.core.program.validate import validate
from mahovik.core.program.walk import statements
from program.small import argument, function, program

ROWS = 3


def solver(rows: int) -> Function:
    """Everything that a short loop may hold: nested bounds, locals of one name, choices, literals that are replaced."""

    def write(body: Body, x: Place, out: Place) -> None:
        for each in out:
            body.set(each, x[0])
        with body.loop("i", rows) as i:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("k", i) as k:
                body.add(total, out[k] * x[k])
            with body.loop("k", rows, start=i + 1) as k:
                body.add(total, out[k] - x[k])
            body.set(out[i], real(0))
            body.set(out[i], real(1))
            body.add(out[i], select(i < 1, x[i], x[0]) + total)
        with body.loop("t", rows) as t:
            last = body.let("last", integer(rows - 1) - t)
            total = body.let("total", 3 * out[last])
            with body.when(total > 1):
                body.set(out[last], total * x[last])
        body.note("exchange neighbours")
        with body.loop("pass", rows - 1), body.loop("i", rows - 1) as i:
            kept = body.let("kept", out[i])
            body.set(out[i], out[i + 1])
            body.set(out[i + 1], kept)

    return function("f", [argument("x", Kind.REAL, (ROWS,)), argument("out", Kind.REAL, (ROWS,), "out")], write)


def outputs(f: Function, x: list[float]) -> list[float]:
    """`out` of the function."""
    return [float(value) for value in Interpreter(program(f)).run("f", {"x": x})[1]["out"]]


NUMBERS = st.lists(st.floats(-1e3, 1e3), min_size=ROWS, max_size=ROWS)


@given(st.integers(1, ROWS), NUMBERS)
def test_results_keep_their_bits(rows: int, x: list[float]) -> None:
    given_function = solver(rows)
    validate(program(without_short_loops(given_function)))
    assert list(map(repr, outputs(without_short_loops(given_function), x))) == list(
        map(repr, outputs(given_function, x))
    )


def test_a_loop_of_no_turn_is_no_program() -> None:
    """Also where only the index of the loop around it shows that, over flywheels of which there is one."""
    count = NamedCount("N", 1)

    def write(body: Body, x: Place, out: Place) -> None:
        with body.loop("i", count) as i, body.loop("k", i) as k:
            body.set(out[i], x[k])

    arguments = [argument("x", Kind.REAL, (ROWS,)), argument("out", Kind.REAL, (ROWS,), "out")]
    f = function("f", arguments, write)
    with pytest.raises(ValueError, match="f: the loop over k has no turn"):
        validate(program(f))
    assert not list(statements(without_short_loops(f).body))
