"""Every refusal of validate, and what it lets pass."""

import pytest

from emit.stands import NAMES, float_texts, generated, stand
from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Const, Place, Variable, integer, real
from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, When
from mahovik.core.program.types import DOUBLE, Field, Kind, Struct
from mahovik.core.program.validate import validate
from mahovik.core.program.walk import expressions, statements
from program.small import argument, function, program
from toolchain.quick import quick

R, I = Kind.REAL, Kind.INT
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
        ([LET_A, Set(OUT.place[0], OTHER_A.place), USE_A], "f: a is used outside its block"),
        ([When(X.place < 0, (LET_A, USE_A)), USE_A], "f: a is used outside its block"),
        ([When(X.place < 0, (LET_A, USE_A), (USE_A,))], "f: a is used outside its block"),
        ([When(A.place < 0, (Note("nothing"),))], "f: a is used outside its block"),
        ([Loop(K, integer(0), integer(2), (LET_A, USE_A)), USE_A], "f: a is used outside its block"),
        ([Loop(K, integer(0), K.place, ())], "f: k is used outside its block"),
        ([Loop(K, K.place, integer(2), ())], "f: k is used outside its block"),
        ([Let(A, A.place + 1)], "f: a is used outside its block"),
        ([LET_A, USE_A, Let(OTHER_A, real(2)), Set(OUT.place[1], OTHER_A.place)], "f: a hides another a"),
        ([Declare(Variable("x", R))], "f: x hides another x"),
        ([LET_A, USE_A, When(X.place < 0, (Let(OTHER_A, real(1)),))], "f: a hides another a"),
        ([LET_A, USE_A, Loop(Variable("a", I), integer(0), integer(2), ())], "f: a hides another a"),
        ([LET_A], "f: a is never used"),
        ([Loop(K, integer(0), integer(2), (LET_A,))], "f: a is never used"),
        ([When(X.place < 0, (), (LET_A,))], "f: a is never used"),
        ([Declare(A)], "f: a is never used"),
        ([Set(Place(OUT.variable, (Const(0, R),), R, ()), real(1))], "an index that is no int"),
        ([Return(Place(OUT.variable, (X.place,), R, ()))], "an index that is no int"),
        ([Copy(A.place, X.place)], "f: a is used outside its block"),
    ],
)
def test_refusals(body: list[Statement], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        validate(program_of(*body))


def test_the_same_name_in_two_blocks_is_good() -> None:
    blocks = [When(X.place < 0, (Let(v, real(1)), Set(OUT.place[0], v.place))) for v in (A, OTHER_A)]
    validate(program_of(*blocks, Loop(K, integer(0), integer(2), (Set(OUT.place[K.place], X.place),))))


def test_two_things_of_one_name() -> None:
    f, g = (function("f", [argument("x")], lambda body, x: body.note("nothing")) for _ in range(2))
    with pytest.raises(ValueError, match="f names two things"):
        validate(program(f, g))
    with pytest.raises(ValueError, match="f names two things"):
        validate(program(f, structs=[Struct("f", "A struct.", (Field("a", R),))]))


def test_functions_come_after_those_they_call() -> None:
    inner = function("inner", [argument("x")], lambda body, x: body.note("nothing"))
    outer = function("outer", [argument("x")], lambda body, x: body.call(inner, x))
    validate(program(inner, outer))
    for functions in ((outer, inner), (outer,)):
        with pytest.raises(ValueError, match="outer calls inner, which does not come before it"):
            validate(Program("t", DOUBLE, (), (), functions))


def test_no_function_calls_itself() -> None:
    own = Function("own", "own.", (X,), ())
    calls = function("own", [argument("x")], lambda body, x: body.call(own, x))
    assert isinstance(calls.body[0], Do)
    with pytest.raises(ValueError, match="own calls own"):
        validate(program(calls))


@pytest.mark.parametrize("name", quick(8, NAMES))
def test_lowered_programs_are_valid(name: str) -> None:
    validate(generated(name).program)


@pytest.mark.parametrize("name", [*quick(8, NAMES), "hinge5"])
def test_a_lowered_function_writes_all_that_it_does_not_only_read(name: str) -> None:
    """What nothing writes is `const` in C."""
    for f in generated(name).program.functions:
        written = {id(s.place.root) for s in statements(f.body) if isinstance(s, Set)}
        written |= {id(s.target.root) for s in statements(f.body) if isinstance(s, Copy)}
        calls = [e for e in expressions(f.body) if isinstance(e, Call)]
        passed = [v for call in calls for p, v in call.pairs if p.direction != "in"]
        written |= {id(v.root) for v in passed if isinstance(v, Place)}
        assert [a.name for a in f.arguments if a.direction != "in" and id(a.variable) not in written] == [], f.name


def test_lowered_float_programs_are_valid() -> None:
    validate(float_texts(stand("everything6"))[1])
