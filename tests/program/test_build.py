"""The builder and the expressions refuse kinds, structs and lengths that do not fit."""

from collections.abc import Callable
from typing import Any

import pytest

from mahovik.core.program.build import Body, call
from mahovik.core.program.expression import (
    Binary,
    BitCast,
    Compare,
    Const,
    Convert,
    Expr,
    Variable,
    as_expr,
    compare,
    equal,
    integer,
    real,
    select,
    unequal,
    word,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from program.small import argument, function

R, W, I = Kind.REAL, Kind.WORD, Kind.INT
PAIR = Struct("pair", "Two.", (Field("a", R), Field("b", R, (2,))))
OTHER = Struct("other", "Two.", (Field("a", R), Field("b", R, (2,))))
N = NamedCount("N", 3)

a, b = (Variable(name, R).place for name in "ab")
w = Variable("w", W).place
n = Variable("n", I).place
x3, x6 = Variable("x3", R, (3,)).place, Variable("x6", R, (6,)).place
x_n = Variable("x_n", R, (N,)).place
matrix = Variable("matrix", R, (2, 3)).place
n3 = Variable("n3", I, (3,)).place
pair, other = Variable("pair", PAIR).place, Variable("other", OTHER).place


def callee(
    kind: Kind | Struct = R, shape: tuple[int | NamedCount, ...] = (), direction: str = "in", returns: Kind | None = R
) -> Function:
    """A function of one argument."""
    return function("callee", [argument("x", kind, shape, direction)], lambda body, x: body.ret(real(1)), returns)


@pytest.mark.parametrize(
    "mix",
    [
        lambda: a + w,
        lambda: w & n,
        lambda: n * a,
        lambda: a < n,
        lambda: compare("<", w, n),
        lambda: select(a < b, a, w),
        lambda: equal(n, w),
    ],
)
def test_kinds_do_not_mix(mix: Callable[[], object]) -> None:
    with pytest.raises(TypeError, match="kinds differ"):
        mix()


@pytest.mark.parametrize("test", [equal, unequal])
def test_reals_are_not_compared_for_equality(test: Callable[[Any, Any], object]) -> None:
    with pytest.raises(TypeError, match="not compared for equality"):
        test(a, b)
    with pytest.raises(TypeError, match="not compared for equality"):
        test(a, 0)


@pytest.mark.parametrize("kind", [I, W])
def test_a_real_is_never_converted_by_value(kind: Kind) -> None:
    with pytest.raises(TypeError, match="use the bits"):
        Convert(a, kind)


@pytest.mark.parametrize(("operand", "kind"), [(a, I), (a, R), (n, R), (w, W), (w, I)])
def test_bits_are_of_reals_and_words(operand: Expr, kind: Kind) -> None:
    with pytest.raises(TypeError, match="between real and word"):
        BitCast(operand, kind)


def test_an_expression_has_no_truth_value() -> None:
    with pytest.raises(TypeError, match="no truth value"):
        bool(a < b)
    with pytest.raises(TypeError, match="no truth value"):
        assert 0 < a < 1


def test_a_fraction_is_no_integer() -> None:
    with pytest.raises(TypeError, match="is no int"):
        as_expr(0.5, I)
    with pytest.raises(TypeError, match="is no word"):
        w & 0.5


def test_a_literal_takes_the_kind_of_its_partner() -> None:
    more, sooner, less, named = a + 1, 1 + w, n < 3, integer(N)
    assert isinstance(more, Binary)
    assert more.right.kind is R
    assert isinstance(sooner, Binary)
    assert sooner.left.kind is W
    assert isinstance(less, Compare)
    assert less.right.kind is I
    assert isinstance(named, Const)
    assert named.name == "N"


def test_places_are_what_their_variable_is() -> None:
    assert [len(x3), len(x_n), len(matrix), len(matrix[0])] == [3, 3, 2, 3]
    assert matrix[1][2].is_scalar
    assert pair.b[1].kind is R
    with pytest.raises(IndexError, match=r"x3\[3\] is outside 0\.\.2"):
        x3[3]
    with pytest.raises(IndexError, match="outside"):
        x3[-1]
    with pytest.raises(TypeError, match="is not an array"):
        a[0]
    with pytest.raises(TypeError, match="struct pair has no member c"):
        pair.c  # noqa: B018  the access itself must raise
    with pytest.raises(TypeError, match="is not a struct"):
        a.b  # noqa: B018  the access itself must raise


def test_only_scalars_are_set() -> None:
    with pytest.raises(TypeError, match="x3 is not a scalar"):
        Body().set(x3, 1)
    with pytest.raises(TypeError, match="pair is not a scalar"):
        Body().add(pair, a)


def test_arrays_of_other_lengths_are_not_copied() -> None:
    with pytest.raises(TypeError, match="x3 has 3 elements, x6 6"):
        Body().copy_array(x3, x6)


@pytest.mark.parametrize(
    ("function", "value", "message"),
    [
        (callee(R, (6,)), x3, "x3 has 3 elements, expected 6"),
        (callee(R, (N,)), x6, "x6 has 6 elements, expected 3"),
        (callee(R, (3,)), matrix, "does not fit"),
        (callee(R, (3,)), n3, "does not fit"),
        (callee(R, (3,)), a, "does not fit"),
        (callee(R, (3,)), real(1), "does not fit"),
        (callee(PAIR), other, "does not fit"),
        (callee(PAIR), x3, "does not fit"),
        (callee(R, (), "out"), real(1), "does not fit"),
        (callee(R, (), "out"), n, "does not fit"),
        (callee(R), n, "int given, real expected"),
        (callee(I), a, "real given, int expected"),
        (callee(W), n, "int given, word expected"),
    ],
)
def test_arguments_that_do_not_fit(function: Function, value: Expr, message: str) -> None:
    with pytest.raises(TypeError, match=message):
        call(function, value)
    with pytest.raises(TypeError, match=message):
        Body().call(function, value)


@pytest.mark.parametrize(
    ("function", "value"),
    [
        (callee(R, (3,)), x_n),
        (callee(R, (N,)), x3),
        (callee(R, (3,)), matrix[1]),
        (callee(R, (0,)), x6),
        (callee(R, (2,)), pair.b),
        (callee(PAIR), pair),
        (callee(R), 1),
        (callee(W), word(3)),
        (callee(R, (), "out"), a),
    ],
)
def test_arguments_that_fit(function: Function, value: Expr) -> None:
    assert call(function, value).kind is R


def test_calls_with_another_number_of_arguments() -> None:
    with pytest.raises(TypeError, match="callee takes 1 arguments, not 2"):
        call(callee(), a, b)


def test_what_returns_nothing_is_no_expression() -> None:
    with pytest.raises(TypeError, match="callee returns nothing"):
        call(callee(returns=None), a)


def test_blocks_are_closed_and_otherwise_follows_when() -> None:
    body = Body()
    with pytest.raises(AssertionError), body.loop("i", 3):
        body.statements  # noqa: B018  the access itself must raise
    body = Body()
    body.note("no when before")
    with pytest.raises(AssertionError), body.otherwise():
        pass
