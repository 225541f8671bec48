"""Walks over programs: their statements and expressions, which variables and functions a body uses."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Given, Place
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Copy, Do, Let, Loop, Return, Set, Statement, Statements, When


def statements(body: Iterable[Statement]) -> Iterator[Statement]:
    """Every statement of a body, each before those inside it."""
    for s in body:
        yield s
        for inner in blocks(s):
            yield from statements(inner)


def blocks(s: Statement) -> tuple[Statements, ...]:
    """The bodies inside a statement."""
    match s:
        case Loop() | Block():
            return (s.body,)
        case When():
            return (s.body, s.otherwise)
    return ()


def with_blocks(s: Statement, block: Callable[[Statements], Statements]) -> Statement:
    """The same statement with `block` of each body inside it."""
    match s:
        case Loop() | Block():
            return replace(s, body=block(s.body))
        case When():
            return replace(s, body=block(s.body), otherwise=block(s.otherwise))
    return s


def own(s: Statement) -> tuple[Expr, ...]:
    """The expressions of a statement, without those of the statements inside it."""
    match s:
        case Let(_, value) | Return(value):
            return (value,)
        case Set(place, value):
            return (place, value)
        case Copy(target, source):
            return (target, source)
        case Do(call):
            return (call,)
        case Loop(_, start, stop):
            return (start, stop)
        case When(condition):
            return (condition,)
    return ()


def expressions(body: Iterable[Statement]) -> Iterator[Expr]:
    """Every expression of a body, from the outside in; places that are written are included."""
    for s in statements(body):
        for e in own(s):
            yield from inside(e)


def inside(e: Expr) -> Iterator[Expr]:
    """An expression and all its parts, from the outside in."""
    waiting = [e]
    while waiting:
        outer = waiting.pop()
        yield outer
        if parts := outer.operands:
            waiting.extend(parts[::-1])


def used_variables(body: Iterable[Statement]) -> set[int]:
    """`id` of every variable that a body reads or writes."""
    return {id(e.root) for e in expressions(body) if isinstance(e, Place)}


def without_missing(function: Function) -> Function:
    """The function for callers who leave out what may be missing: without these arguments and what looks at them."""

    def block(body: Statements) -> Statements:
        found: list[Statement] = []
        for s in body:
            if isinstance(s, When) and isinstance(s.condition, Given):
                found += block(s.otherwise)
            else:
                found.append(with_blocks(s, block))
        return tuple(found)

    kept = tuple(a for a in function.arguments if a.optional != "missing")
    return function if kept == function.arguments else replace(function, arguments=kept, body=block(function.body))


def called_names(body: Statements) -> set[str]:
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
            wanted += called_names(by_name[name].body)
    return tuple(f for f in functions if f.name in seen)
