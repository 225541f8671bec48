"""Walks over programs: which variables and functions a body uses."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Binary, BitCast, Compare, Convert, Expr, Logic, Negate, Not, Place, Select
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Copy, Declare, Do, Let, Loop, Note, Return, Set, Statement, When


def expressions(body: tuple[Statement, ...]) -> Iterator[Expr]:
    """Every expression of a body, from the outside in; places that are written are there as well."""
    for statement in body:
        yield from _of_statement(statement)


def _of_statement(s: Statement) -> Iterator[Expr]:
    match s:
        case Note() | Declare():
            return
        case Let(_, value) | Return(value):
            yield from inside(value)
        case Set(place, value):
            yield from inside(place)
            yield from inside(value)
        case Copy(target, source):
            yield from inside(target)
            yield from inside(source)
        case Do(call):
            yield from inside(call)
        case Block(body):
            yield from expressions(body)
        case Loop(_, start, stop, body):
            yield from inside(start)
            yield from inside(stop)
            yield from expressions(body)
        case When(condition, body, otherwise):
            yield from inside(condition)
            yield from expressions(body)
            yield from expressions(otherwise)


def inside(e: Expr) -> Iterator[Expr]:
    """An expression and all its parts, from the outside in."""
    yield e
    match e:
        case Place():
            children: tuple[Expr, ...] = tuple(step for step in e.path if isinstance(step, Expr))
        case Negate() | Not() | Convert() | BitCast():
            children = (e.operand,)
        case Binary() | Compare() | Logic():
            children = (e.left, e.right)
        case Select():
            children = (e.condition, e.yes, e.no)
        case Call():
            children = e.arguments
        case _:
            children = ()
    for child in children:
        yield from inside(child)


def used_variables(body: tuple[Statement, ...]) -> set[int]:
    """`id` of every variable that a body reads or writes."""
    return {id(e.root) for e in expressions(body) if isinstance(e, Place)}


def called(body: tuple[Statement, ...]) -> set[str]:
    """Names of the functions that a body calls itself."""
    return {e.signature.name for e in expressions(body) if isinstance(e, Call)}


def reachable(functions: tuple[Function, ...]) -> tuple[Function, ...]:
    """Functions that are public or called, directly or not, by a public one; order kept."""
    by_name = {f.name: f for f in functions}
    wanted = [f.name for f in functions if f.public]
    seen: set[str] = set()
    while wanted:
        name = wanted.pop()
        if name not in seen:
            seen.add(name)
            wanted += called(by_name[name].body)
    return tuple(f for f in functions if f.name in seen)
