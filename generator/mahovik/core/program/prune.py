"""Removes what nobody reads: local variables that are only written, and calls that only write such variables.

A structure without some kind of wrench leaves such remainders; C compilers would warn of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Place
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Declare, Do, Let, Loop, Set, Statement, When
from mahovik.core.program.walk import expressions, inside


def pruned(function: Function) -> Function:
    """The function without dead locals and without arguments that it has no use for."""
    body = function.body
    while True:
        alive = {id(p.root) for p in _read(body)} | {id(a.variable) for a in function.arguments}
        shorter = _block(body, alive, alive | _written_by_calls(body, alive))
        if _size(shorter) == _size(body):
            break
        body = shorter
    used = {id(e.root) for e in expressions(body) if isinstance(e, Place)}
    kept = tuple(a for a in function.arguments if id(a.variable) in used)
    return replace(function, arguments=kept, body=body)


def _read(body: tuple[Statement, ...]) -> Iterator[Place]:
    """Places whose value is used: all but targets of Set and output arguments of calls that are statements."""
    for s in body:
        match s:
            case Set(place, value):
                yield from _places(value)
                yield from (p for step in place.path if isinstance(step, Expr) for p in _places(step))
            case Do(call):
                for parameter, value in zip(call.signature.arguments, call.arguments, strict=True):
                    whole = isinstance(value, Place) and parameter.direction != "in"
                    yield from list(_places(value))[1 if whole else 0 :]
            case Loop(_, start, stop, inner):
                yield from (*_places(start), *_places(stop), *_read(inner))
            case Block(inner):
                yield from _read(inner)
            case When(condition, inner, otherwise):
                yield from (*_places(condition), *_read(inner), *_read(otherwise))
            case _:
                yield from (e for e in expressions((s,)) if isinstance(e, Place))


def _written_by_calls(body: tuple[Statement, ...], alive: set[int]) -> set[int]:
    """Variables that a call which stays writes, read or not."""
    found: set[int] = set()
    for s in body:
        match s:
            case Do(call) if not _dead(call, alive):
                found |= {id(v.root) for v in call.arguments if isinstance(v, Place)}
            case Loop() | Block():
                found |= _written_by_calls(s.body, alive)
            case When():
                found |= _written_by_calls((*s.body, *s.otherwise), alive)
            case _:
                pass
    return found


def _places(e: Expr) -> Iterator[Place]:
    return (x for x in inside(e) if isinstance(x, Place))


def _block(body: tuple[Statement, ...], alive: set[int], kept_variables: set[int]) -> tuple[Statement, ...]:
    kept: list[Statement] = []
    for s in body:
        match s:
            case Let(variable) | Declare(variable) if id(variable) not in kept_variables:
                continue
            case Set(place) if id(place.root) not in kept_variables:
                continue
            case Do(call) if _dead(call, alive):
                continue
            case Block():
                kept.append(replace(s, body=_block(s.body, alive, kept_variables)))
            case Loop():
                kept.append(replace(s, body=_block(s.body, alive, kept_variables)))
            case When():
                kept.append(
                    replace(
                        s,
                        body=_block(s.body, alive, kept_variables),
                        otherwise=_block(s.otherwise, alive, kept_variables),
                    )
                )
            case _:
                kept.append(s)
    return tuple(kept)


def _dead(call: Call, alive: set[int]) -> bool:
    """A call without status all of whose results nobody reads."""
    if call.signature.returns is not None:
        return False
    results = [v for p, v in zip(call.signature.arguments, call.arguments, strict=True) if p.direction != "in"]
    return all(isinstance(v, Place) and id(v.root) not in alive for v in results)


def _size(body: tuple[Statement, ...]) -> int:
    total = len(body)
    for s in body:
        if isinstance(s, Loop | Block):
            total += _size(s.body)
        elif isinstance(s, When):
            total += _size(s.body) + _size(s.otherwise)
    return total
