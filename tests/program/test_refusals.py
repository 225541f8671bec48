"""What no program may be is refused: by the builder and its expressions, and by the validation of a whole program."""

from collections.abc import Callable

import pytest

from emit.stands import generated
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import (
    BitCast,
    Convert,
    Expr,
    Place,
    Variable,
    as_expr,
    equal,
    integer,
    real,
    select,
)
from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Copy, Declare, Let, Loop, Set, Statement, When
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.program.validate import validate
from mahovik.core.program.walk import expressions, statements
from program.small import argument, function, program

R, W, I = Kind.REAL, Kind.WORD, Kind.INT
PAIR = Struct("pair", "Two.", (Field("a", R), Field("b", R, (2,))))
OTHER = Struct("other", "Two.", (Field("a", R), Field("b", R, (2,))))
N = NamedCount("N", 3)

a, b = (Variable(name, R).place for name in "ab")
w, n = Variable("w", W).place, Variable("n", I).place
x3, x6 = Variable("x3", R, (3,)).place, Variable("x6", R, (6,)).place
pair, other = Variable("pair", PAIR).place, Variable("other", OTHER).place


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: a + w, "kinds differ"),
        (lambda: select(a < b, a, w), "kinds differ"),
        (lambda: equal(a, b), "not compared for equality"),
        (lambda: Convert(a, I), "a real is converted by its bits only"),
        (lambda: BitCast(n, R), "between real and word"),
        (lambda: bool(a < b), "no truth value"),
        (lambda: as_expr(0.5, I), "is no int"),
        (lambda: a[0], "is not an array"),
        (lambda: pair.c, "struct pair has no member c"),
        (lambda: Body().set(x3, 1), "x3 is not a scalar"),
        (lambda: Body().set(x3, x6), "lengths differ: 3 and 6 elements"),
        (lambda: x3[a], "kinds differ: real found, int expected"),
        (lambda: x3[N], "x3\\[3\\] is outside 0..2"),
        (lambda: a % b, "% of real: expected one of"),
        (lambda: -pair, "pair is a struct, expected a number"),
        (lambda: as_expr(2**31, I), "2147483648 is no number that int holds"),
        (lambda: callee()(a, b), "callee takes 1 arguments, not 2"),
        (lambda: callee(returns=None)(a) + a, "callee returns nothing"),
    ],
)
def test_expressions_that_do_not_fit(build: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        build()


def callee(
    kind: Kind | Struct = R, shape: tuple[int | NamedCount, ...] = (), direction: str = "in", returns: Kind | None = R
) -> Function:
    """A function of one argument."""
    return function("callee", [argument("x", kind, shape, direction)], lambda body, x: body.ret(real(1)), returns)


@pytest.mark.parametrize(
    ("function", "value", "message"),
    [
        (callee(R, (6,)), x3, "x3 has 3 elements, expected 6"),
        (callee(R, (N,)), x6, "x6 has 6 elements, expected 3"),
        (callee(PAIR), other, "does not fit"),
        (callee(R, (), "out"), real(1), "does not fit"),
        (callee(R, (3,), "out"), x3, "x3 is an input, a temporary or an index"),
        (callee(R), n, "argument x: kinds differ: int found, real expected"),
    ],
)
def test_arguments_that_do_not_fit(function: Function, value: Expr, message: str) -> None:
    with pytest.raises(TypeError, match=message):
        function(value)


X = Argument("x", R)
OUT = Argument("out", R, (2,), "out")
A, OTHER_A = Variable("a", R), Variable("a", R)
K = Variable("k", I)
LET_A = Let(A, real(1))
USE_A = Set(OUT.place[0], A.place)


def program_of(*body: Statement) -> Program:
    """A program of one function of x, out with that body."""
    return program(Function("f", "f.", (X, OUT), tuple(body), public=True))


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ([USE_A, LET_A], "f: a is used outside its block"),
        ([USE_A], "f: a is used outside its block"),
        ([When(X.place < 0, (LET_A, USE_A)), USE_A], "f: a is used outside its block"),
        ([When(X.place < 0, (LET_A, USE_A), (USE_A,))], "f: a is used outside its block"),
        ([Loop(K, integer(0), integer(2), (LET_A, USE_A)), USE_A], "f: a is used outside its block"),
        ([Loop(K, K.place, integer(2), ())], "f: k is used outside its block"),
        ([LET_A, USE_A, Let(OTHER_A, real(2)), Set(OUT.place[1], OTHER_A.place)], "f: a hides another a"),
        ([Declare(Variable("x", R))], "f: x hides another x"),
        ([LET_A, USE_A, Loop(Variable("a", I), integer(0), integer(2), ())], "f: a hides another a"),
        ([LET_A], "f: a is never used"),
        ([Loop(K, integer(0), integer(2), (LET_A,))], "f: a is never used"),
        ([Copy(A.place, X.place)], "f: a is used outside its block"),
    ],
)
def test_refusals(body: list[Statement], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        validate(program_of(*body))


def test_two_things_of_one_name() -> None:
    f, g = (function("f", [argument("x")], lambda body, x: body.note("nothing")) for _ in range(2))
    with pytest.raises(ValueError, match="f names two things"):
        validate(program(f, g))
    with pytest.raises(ValueError, match="f names two things"):
        validate(program(f, structs=[Struct("f", "A struct.", (Field("a", R),))]))


@pytest.mark.parametrize("name", ["everything6", "hinge5"])
def test_a_lowered_function_writes_all_that_it_does_not_only_read(name: str) -> None:
    """What nothing writes is `const` in C."""
    validate(generated(name).program)
    for f in generated(name).program.functions:
        written = {id(s.place.root) for s in statements(f.body) if isinstance(s, Set)}
        written |= {id(s.target.root) for s in statements(f.body) if isinstance(s, Copy)}
        calls = [e for e in expressions(f.body) if isinstance(e, Call)]
        passed = [v for call in calls for p, v in call.pairs if p.direction != "in"]
        written |= {id(v.root) for v in passed if isinstance(v, Place)}
        assert [a.name for a in f.arguments if a.direction != "in" and id(a.variable) not in written] == [], f.name
