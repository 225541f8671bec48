"""Meaning of the statements and expressions of a program."""

import struct
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.program.build import Body, call
from mahovik.core.program.expression import (
    Convert,
    Not,
    Place,
    Status,
    and_,
    bits_of,
    equal,
    integer,
    magnitude,
    or_,
    real,
    real_of_bits,
    select,
    unequal,
    word,
)
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, FLOAT, Field, Kind, Precision, Struct
from program.small import argument, evaluate, function, program, run

R, W, I = Kind.REAL, Kind.WORD, Kind.INT
SINGLE = st.floats(width=32, allow_nan=False)
PRECISIONS = pytest.mark.parametrize("precision", (DOUBLE, FLOAT), ids=lambda p: p.name)


@given(SINGLE, SINGLE, SINGLE)
def test_each_operation_of_a_float_program_is_rounded(a: float, b: Any, c: float) -> None:
    """a*b + c in float is two roundings: a double in between would give one, another number."""
    found = evaluate((R, R, R), lambda x, y, z: x * y + z, a, b, c, precision=FLOAT)
    with np.errstate(all="ignore"):
        expected = np.float32(np.float32(np.float32(a) * np.float32(b)) + np.float32(c))
    assert isinstance(found, np.float32)
    assert found.tobytes() == expected.tobytes() or (np.isnan(found) and np.isnan(expected))


def test_rounding_of_double_and_float() -> None:
    third = (lambda x: x / 3,)
    assert evaluate((R,), *third, 1.0) == 1 / 3
    assert evaluate((R,), *third, 1.0, precision=FLOAT) == np.float32(1) / np.float32(3)
    # (1 + 2^-30) - 1: lost in float, kept in double
    tree = (lambda x: (real(1) + x) - real(1),)
    assert evaluate((R,), *tree, 2.0**-30) == 2.0**-30
    assert evaluate((R,), *tree, 2.0**-30, precision=FLOAT) == 0


def test_literals_are_rounded_to_the_element_type() -> None:
    assert evaluate((R,), lambda x: x + 0.1, 0.0, precision=FLOAT) == np.float32(0.1)
    assert evaluate((R,), lambda x: x + 0.1, 0.0) == 0.1
    # literals among themselves too: nothing is left to Python's own floats
    product = evaluate((R,), lambda x: real(0.1) * real(0.1) + x, 0.0, precision=FLOAT)
    assert product == np.float32(0.1) * np.float32(0.1)
    assert evaluate((), lambda: real(1) / 0, precision=FLOAT) == np.inf


def test_the_tree_is_the_order_of_operations() -> None:
    big, one = 1e16, 1.0
    assert evaluate((R, R), lambda a, b: (a + b) - a, big, one) == 0.0
    assert evaluate((R, R), lambda a, b: (a - a) + b, big, one) == 1.0
    assert evaluate((R, R), lambda a, b: a + (b - a), big, one) == 0.0


@PRECISIONS
@given(st.integers(0, 2**64 - 1), st.integers(0, 2**64 - 1))
def test_words_wrap_around(precision: Precision, a: int, b: Any) -> None:
    modulus = 1 << precision.width
    a, b = a % modulus, b % modulus

    def value(tree: Callable[..., Any]) -> int:
        found = evaluate((W, W), lambda u, v: real_of_bits(tree(u, v)), a, b, precision=precision)
        return int(precision.scalar(found).view(precision.word))

    assert value(lambda u, v: u + v) == (a + b) % modulus
    assert value(lambda u, v: u - v) == (a - b) % modulus
    assert value(lambda u, v: u * v) == a * b % modulus
    assert value(lambda u, v: -u) == -a % modulus
    assert value(lambda u, v: u & v) == a & b
    assert value(lambda u, v: u | v) == a | b
    assert value(lambda u, v: u ^ v) == a ^ b
    assert value(lambda u, v: u << 7) == (a << 7) % modulus
    assert value(lambda u, v: u >> 7) == a >> 7
    assert value(lambda u, v: word(0) - 1) == modulus - 1


@PRECISIONS
@given(SINGLE)
def test_bits_there_and_back(precision: Precision, x: float) -> None:
    same = evaluate((R,), lambda a: real_of_bits(bits_of(a)), x, precision=precision)
    assert precision.scalar(same).tobytes() == precision.scalar(x).tobytes()
    sign = 1 << (precision.width - 1)
    flipped = evaluate((R,), lambda a: real_of_bits(bits_of(a) ^ sign), x, precision=precision)
    assert precision.scalar(flipped).tobytes() == (-precision.scalar(x)).tobytes()


def test_bits_are_those_of_ieee_754() -> None:
    for precision, code, bits in ((DOUBLE, "<d", "<Q"), (FLOAT, "<f", "<I")):
        (expected,) = struct.unpack(bits, struct.pack(code, -1.5))
        assert evaluate((R,), lambda a: Convert(bits_of(a) >> 3, R), -1.5, precision=precision) == (expected >> 3)


@pytest.mark.parametrize(("a", "b"), [(7, 2), (-7, 2), (7, -2), (-7, -2), (6, -3), (0, -5)])
def test_int_division_is_towards_zero(a: int, b: Any) -> None:
    assert evaluate((I,), lambda n: Convert(n / integer(b), R), a) == int(a / b)


def test_conversions() -> None:
    assert evaluate((I,), lambda n: Convert(n, R), -3) == -3.0
    assert evaluate((I,), lambda n: Convert(Convert(n, W), R), -1) == 2.0**64
    assert evaluate((I,), lambda n: Convert(Convert(n, W), R), -1, precision=FLOAT) == np.float32(2.0**32)
    assert evaluate((W,), lambda u: Convert(Convert(u & 3, I) - 5, R), 7) == -2.0
    # to nearest, ties to even, once
    assert evaluate((W,), lambda u: Convert(u, R), 2**53 + 1) == 2.0**53
    assert evaluate((W,), lambda u: Convert(u, R), 2**24 + 1, precision=FLOAT) == 2.0**24
    assert evaluate((W,), lambda u: Convert(u, R), 2**24 + 3, precision=FLOAT) == 2.0**24 + 4


@pytest.mark.parametrize("x", [-0.0, 0.0, 1.5, -1.5, float("-inf"), float("nan")])
def test_select_and_conditions(x: float) -> None:
    absolute = evaluate((R,), magnitude, x)
    assert str(absolute) == str(-x if x < 0 else x)  # -0 < 0 is false: -0 stays
    assert evaluate((R,), lambda a: select(a < 0, 1, 2), x) == (1 if x < 0 else 2)
    assert evaluate((R,), lambda a: select(and_(a >= -2, a <= 1), 1, 2), x) == (1 if -2 <= x <= 1 else 2)
    assert evaluate((R,), lambda a: select(or_(a < 0, a > 0), 1, 2), x) == (1 if x < 0 or x > 0 else 2)
    # NaN: !(a >= b) is not a < b
    assert evaluate((R,), lambda a: select(Not(a >= 0), 1, 2), x) == (2 if x >= 0 else 1)


def test_equality_of_integers() -> None:
    assert evaluate((I, I), lambda a, b: select(equal(a, b), 1, 2), 3, 3) == 1
    assert evaluate((W, W), lambda a, b: select(unequal(a, b), 1, 2), 3, 3) == 2


def test_division_by_zero_and_overflow_are_ieee_and_silent() -> None:
    assert evaluate((R, R), lambda a, b: a / b, -1.0, 0.0) == -np.inf
    assert np.isnan(evaluate((R, R), lambda a, b: a / b, 0.0, 0.0))
    assert evaluate((R, R), lambda a, b: a * b, 3e38, 10.0, precision=FLOAT) == np.inf
    assert evaluate((R, R), lambda a, b: a * b, 1e-45, 0.25, precision=FLOAT) == 0


def test_when_otherwise_and_early_return() -> None:
    def write(body: Body, a: Place, out: Place) -> None:
        with body.when(a < 0):
            body.set(out[0], 1)
            with body.when(a < -10):
                body.ret(Status("RANGE"))
        with body.otherwise():
            body.set(out[0], 2)
        body.add(out[0], 10)
        body.ret(Status("OK"))

    f = function("f", [argument("a"), argument("out", R, (1,), "out")], write, Kind.STATUS)
    assert run(f, {"a": -1.0}) == (0, {"out": [11]})
    assert run(f, {"a": 1.0}) == (0, {"out": [12]})
    assert run(f, {"a": -20.0}) == (STATUS_VALUES["RANGE"], {"out": [1]})
    assert run(f, {"a": float("nan")}) == (0, {"out": [12]})


@pytest.mark.parametrize(("start", "stop"), [(0, 4), (1, 3), (2, 2), (3, 1)])
def test_loops(start: int, stop: int) -> None:
    def write(body: Body, x: Place, n: Place, out: Place) -> None:
        with body.loop("i", n, start=start) as i:
            body.set(out[i], x[i] * 2)

    arguments = [argument("x", R, (4,)), argument("n", I), argument("out", R, (4,), "out")]
    expected = [float(2 * i) if start <= i < stop else 0.0 for i in range(4)]
    assert run(function("f", arguments, write), {"x": [0, 1, 2, 3], "n": stop}) == (None, {"out": expected})


def test_add_reads_the_target_first() -> None:
    def write(body: Body, x: Place) -> None:
        body.add(x[0], x[0])
        body.add(x[0], -x[1])

    f = function("f", [argument("x", R, (2,), "inout")], write)
    assert run(f, {"x": [3.0, 1.0]}) == (None, {"x": [5.0, 1.0]})


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


def test_calls_write_scalars_and_elements_of_structs() -> None:
    def split(body: Body, x: Place, whole: Place, rest: Place) -> None:
        body.set(whole, x * 2)
        body.set(rest[0], x + 1)

    def use(body: Body, x: Place, out: Place) -> None:
        a = body.local("a")
        body.call(inner, x, a, out.b)
        body.set(out.a, a + out.b[0])

    inner = function("inner", [argument("x"), argument("whole", R, (), "out"), argument("rest", R, (2,), "out")], split)
    outer = function("outer", [argument("x"), argument("out", PAIR, (), "out")], use)
    found = Interpreter(program(inner, outer, structs=(PAIR,))).run("outer", {"x": 5.0})
    assert found == (None, {"out": {"a": 16.0, "b": [6.0, 0.0]}})


def test_a_call_with_a_value_is_an_expression() -> None:
    square = function("square", [argument("x")], lambda body, x: body.ret(x * x), R, public=False)
    f = function("f", [argument("x")], lambda body, x: body.ret(call(square, x + 1) - call(square, x)), R)
    assert Interpreter(program(square, f)).call("f", np.float64(3)) == 7


def test_a_function_can_be_replaced_for_all_that_call_it() -> None:
    square = function("square", [argument("x")], lambda body, x: body.ret(x * x), R, public=False)
    f = function("f", [argument("x")], lambda body, x: body.ret(call(square, x) + 1), R)
    cubes = Interpreter(program(square, f), {"square": lambda x: x * x * x})
    assert cubes.call("f", np.float64(2)) == 9
    assert Interpreter(program(square, f)).call("f", np.float64(2)) == 5


def test_arguments_of_another_length_are_refused() -> None:
    f = function("f", [argument("x", R, (3,))], lambda body, x: body.ret(x[0]), R)
    with pytest.raises(ValueError, match="2 elements given, 3 expected"):
        run(f, {"x": [1.0, 2.0]})
    anything = function("f", [argument("x", R, (0,))], lambda body, x: body.ret(real(1)), R)
    assert run(anything, {"x": [1.0, 2.0]})[0] == 1  # a length of 0 is any
