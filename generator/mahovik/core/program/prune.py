"""Removes unused code: local variables that are only written, and calls that only write such variables.

A structure without some kind of wrench leaves such remainders; C compilers would warn of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Place
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Declare, Do, Let, Set, Statement, Statements
from mahovik.core.program.walk import blocks, expressions, inside, own, statements, with_blocks


def prune(function: Function) -> Function:
    """The function without dead locals and without arguments that it has no use for."""
    body = function.body
    while True:
        alive = {id(p.root) for p in _used_places(body)} | {id(a.variable) for a in function.arguments}
        shorter = _block(body, alive, alive | _written_by_calls(body, alive))
        if len(list(statements(shorter))) == len(list(statements(body))):
            break
        body = shorter
    used = {id(e.root) for e in expressions(body) if isinstance(e, Place)}
    kept = tuple(a for a in function.arguments if id(a.variable) in used)
    names = function.parameters or tuple(a.name for a in function.arguments)
    return replace(function, arguments=kept, body=body, parameters=names)


def _used_places(body: Statements) -> Iterator[Place]:
    """Places whose value is used: all but targets of Set and output arguments of calls that are statements."""
    for s in body:
        match s:
            case Set(place, value):
                yield from _places(value)
                yield from (p for step in place.path if isinstance(step, Expr) for p in _places(step))
            case Do(call):
                for parameter, value in call.pairs:
                    whole = isinstance(value, Place) and parameter.direction != "in"
                    yield from list(_places(value))[1 if whole else 0 :]
            case _:
                yield from (p for e in own(s) for p in _places(e))
        for inner in blocks(s):
            yield from _used_places(inner)


def _written_by_calls(body: Statements, alive: set[int]) -> set[int]:
    """Variables that a call which stays writes, read or not."""
    calls = (s.call for s in statements(body) if isinstance(s, Do) and not _dead(s.call, alive))
    return {id(v.root) for call in calls for v in call.arguments if isinstance(v, Place)}


def _places(e: Expr) -> Iterator[Place]:
    return (x for x in inside(e) if isinstance(x, Place))


def _block(body: Statements, alive: set[int], kept_variables: set[int]) -> Statements:
    kept: list[Statement] = []
    for s in body:
        match s:
            case Let(variable) | Declare(variable) if id(variable) not in kept_variables:
                continue
            case Set(place) if id(place.root) not in kept_variables:
                continue
            case Do(call) if _dead(call, alive):
                continue
            case _:
                kept.append(with_blocks(s, lambda inner: _block(inner, alive, kept_variables)))
    return tuple(kept)


def _dead(call: Call, alive: set[int]) -> bool:
    """A call without status all of whose results nobody reads."""
    if call.signature.returns is not None:
        return False
    results = [v for p, v in call.pairs if p.direction != "in"]
    return all(isinstance(v, Place) and id(v.root) not in alive for v in results)
