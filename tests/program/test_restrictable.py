"""Pointers called `restrict`: results that no caller lets overlap another argument."""

from __future__ import annotations

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.restrictable import restrictable
from mahovik.core.program.types import DOUBLE, Field, Kind, Struct

PAIR = Struct("pair", "Two vectors.", (Field("a", Kind.REAL, (3,)), Field("b", Kind.REAL, (3,))))


def copy() -> Function:
    source = Argument("source", Kind.REAL, (3,))
    target = Argument("target", Kind.REAL, (3,), "out")
    body = Body()
    body.copy_array(target.place, source.place)
    return Function("copy", "A copy.", (source, target), body.statements)


def program(*functions: Function) -> Program:
    return Program("small", DOUBLE, (), (PAIR,), functions)


def test_what_a_caller_cannot_promise_its_callee_cannot_either() -> None:
    """middle(x, y) copies x to y; who calls it with one array for both takes the promise from middle and from copy."""
    inner = copy()
    x = Argument("x", Kind.REAL, (3,))
    y = Argument("y", Kind.REAL, (3,), "out")
    through = Body()
    through.call(inner, x.place, y.place)
    middle = Function("middle", "", (x, y), through.statements)
    z = Argument("z", Kind.REAL, (3,), "inout")
    body = Body()
    body.call(middle, z.place, z.place)
    assert restrictable(program(inner, middle, Function("f", "", (z,), body.statements, public=True))) == set()


def test_a_result_that_may_overlap_inputs_takes_the_promise_from_all_that_write_it() -> None:
    """f(given, out) may get one array for both: neither copy nor middle, which hands it on, promises otherwise."""
    inner = copy()
    x, y = Argument("x", Kind.REAL, (3,)), Argument("y", Kind.REAL, (3,), "out")
    through = Body()
    through.call(inner, x.place, y.place)
    middle = Function("middle", "", (x, y), through.statements)
    for overlaps in (False, True):
        given, out = Argument("given", Kind.REAL, (3,)), Argument("out", Kind.REAL, (3,), "out", overlaps=overlaps)
        body = Body()
        body.call(middle, given.place, out.place)
        found = restrictable(program(inner, middle, Function("f", "", (given, out), body.statements, public=True)))
        assert found == (set() if overlaps else {("copy", "target"), ("middle", "y")})
