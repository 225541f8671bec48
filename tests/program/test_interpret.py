"""Meaning of the statements and expressions of a program."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.core.program.build import Body
from mahovik.core.program.expression import (
    Place,
    real,
)
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import FLOAT, Field, Kind, Struct
from program.small import argument, evaluate, function, program, run

R, W, I = Kind.REAL, Kind.WORD, Kind.INT
SINGLE = st.floats(width=32, allow_nan=False)


@given(SINGLE, SINGLE, SINGLE)
def test_each_operation_of_a_float_program_is_rounded(a: float, b: Any, c: float) -> None:
    """a*b + c in float is two roundings: a double in between would give one, another number."""
    found = evaluate((R, R, R), lambda x, y, z: x * y + z, a, b, c, precision=FLOAT)
    with np.errstate(all="ignore"):
        expected = np.float32(np.float32(np.float32(a) * np.float32(b)) + np.float32(c))
    assert isinstance(found, np.float32)
    assert found.tobytes() == expected.tobytes() or (np.isnan(found) and np.isnan(expected))


PAIR = Struct("pair", "Two.", (Field("a", R), Field("b", R, (2,))))
OUTER = Struct("outer", "A struct in a struct.", (Field("pair", PAIR), Field("pairs", PAIR, (2,))))


def test_a_struct_copy_shares_nothing() -> None:
    def write(body: Body, x: Place, out: Place) -> None:
        y = body.local("y", (), OUTER)
        body.copy(y, x)
        body.set(y.pair.b[0], 100)
        body.set(y.pairs[1].a, 200)
        body.copy(out.pair, y.pairs[1])
        body.set(y.pairs[1].b[0], 300)
        body.copy(out.pairs[0], x.pair)

    arguments = [argument("x", OUTER), argument("out", OUTER, (), "out")]
    given = {
        "pair": {"a": 1.0, "b": [2.0, 3.0]},
        "pairs": [{"a": 4.0, "b": [5.0, 6.0]}, {"a": 7.0, "b": [8.0, 9.0]}],
    }
    interpreter = Interpreter(program(function("f", arguments, write), structs=(PAIR, OUTER)))
    x = interpreter.argument(arguments[0], given)
    out = interpreter.argument(arguments[1])
    interpreter.call("f", x, out)
    assert x.pair.b == [2, 3]  # the original keeps its own
    assert x.pairs[1].a == 7
    assert out.pair.a == 200
    assert out.pair.b == [8, 9]  # copied before 300 was written
    assert vars(out.pairs[0]) == {"a": 1, "b": [2, 3]}
    x.pair.b[0] = np.float64(50)
    assert out.pairs[0].b == [2, 3]


def test_arguments_of_another_length_are_refused() -> None:
    f = function("f", [argument("x", R, (3,))], lambda body, x: body.ret(x[0]), R)
    with pytest.raises(ValueError, match="2 elements given, 3 expected"):
        run(f, {"x": [1.0, 2.0]})
    anything = function("f", [argument("x", R, (0,))], lambda body, x: body.ret(real(1)), R)
    assert run(anything, {"x": [1.0, 2.0]})[0] == 1  # a length of 0 is any
