"""Walks over programs, and rebuilds them: what every pass needs of their statements, expressions and functions."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Place, Present, Variable
from mahovik.core.program.function import Function
from mahovik.core.program.statement import (
    Block,
    Copy,
    Declare,
    Do,
    Let,
    Loop,
    Return,
    Set,
    Shortcut,
    Statement,
    Statements,
    When,
)
from mahovik.core.program.types import Struct

Leaf = Callable[[Place], Expr]

_EXPRESSIONS: Mapping[type, tuple[str, ...]] = {
    Let: ("value",),
    Return: ("value",),
    Set: ("place", "value"),
    Copy: ("target", "source"),
    Do: ("call",),
    Loop: ("start", "stop"),
    When: ("condition",),
}
_BODIES: Mapping[type, tuple[str, ...]] = {
    Loop: ("body",),
    Block: ("body",),
    Shortcut: ("body",),
    When: ("body", "otherwise"),
}


# ---- statements ----


def direct_expressions(s: Statement) -> tuple[Expr, ...]:
    """The expressions of a statement, without those of the statements inside it."""
    names = _EXPRESSIONS.get(type(s))
    return tuple([getattr(s, name) for name in names]) if names else ()


def map_expressions(s: Statement, part: Callable[[Expr], Expr], **other: Any) -> Statement:
    """The same statement with `part` of each of its own expressions, and with other members that differ."""
    changed: dict[str, Any] = {name: part(getattr(s, name)) for name in _EXPRESSIONS.get(type(s), ())}
    return replace(s, **changed, **other)


def blocks(s: Statement) -> tuple[Statements, ...]:
    """The bodies inside a statement."""
    names = _BODIES.get(type(s))
    return tuple([getattr(s, name) for name in names]) if names else ()


def with_blocks(s: Statement, block: Callable[[Statements], Statements]) -> Statement:
    """The same statement with `block` of each body inside it."""
    names = _BODIES.get(type(s), ())
    changed: dict[str, Any] = {name: block(getattr(s, name)) for name in names}
    return replace(s, **changed) if names else s


def statements(body: Iterable[Statement]) -> Iterator[Statement]:
    """Every statement of a body, each before those inside it."""
    for s in body:
        yield s
        for inner in blocks(s):
            yield from statements(inner)


# ---- expressions ----


def expressions(body: Iterable[Statement]) -> Iterator[Expr]:
    """Every expression of a body, from the outside in; places that are written are included."""
    for s in statements(body):
        for e in direct_expressions(s):
            yield from inside(e)


def inside(e: Expr) -> Iterator[Expr]:
    """An expression and all its parts, from the outside in."""
    waiting = [e]
    while waiting:
        outer = waiting.pop()
        yield outer
        if parts := outer.operands:
            waiting.extend(parts[::-1])


def rebuilt(e: Expr, leaf: Leaf, call: Callable[[Call], Expr] | None = None) -> Expr:
    """The same tree with `leaf` of every place (its indices done already), and with `call` of every call."""

    def again(inner: Expr) -> Expr:
        return rebuilt(inner, leaf, call)

    if isinstance(e, Place):
        steps = tuple(again(step) if isinstance(step, Expr) else step for step in e.path)
        return leaf(Place(e.root, steps, e.type, e.shape))
    expression = e.with_operands(again)
    return call(expression) if call is not None and isinstance(expression, Call) else expression


def substitution(meanings: Mapping[int, Expr]) -> Leaf:
    """Replace the root of a place by its meaning (by `id` of the variable), keep the path; other places stay."""

    def leaf(place: Place) -> Expr:
        meant = meanings.get(id(place.root))
        if meant is None:
            return place
        if isinstance(meant, Place):
            return Place(meant.root, (*meant.path, *place.path), place.type, place.shape)
        assert not place.path
        return meant

    return leaf


def are_same(a: Expr, b: Expr) -> bool:
    """Are two expressions the same tree?"""

    def head(e: Expr) -> tuple[Any, ...]:
        match e:
            case Place():
                return (id(e.root), *(step for step in e.path if isinstance(step, str)))
            case Call():
                return (e.signature.name,)
        return tuple(getattr(e, name, None) for name in ("value", "name", "operator", "kind"))

    if type(a) is not type(b) or head(a) != head(b) or len(a.operands) != len(b.operands):
        return False
    return all(are_same(x, y) for x, y in zip(a.operands, b.operands, strict=True))


# ---- variables and functions ----


def used_variables(body: Iterable[Statement]) -> set[int]:
    """`id` of every variable that a body reads or writes."""
    return {id(e.root) for e in expressions(body) if isinstance(e, Place)}


def without_missing(function: Function) -> Function:
    """The function for callers who leave out what may be missing: without these arguments and what looks at them."""

    def block(body: Statements) -> Statements:
        statements: list[Statement] = []
        for s in body:
            if isinstance(s, When) and isinstance(s.condition, Present):
                statements += block(s.otherwise)
            else:
                statements.append(with_blocks(s, block))
        return tuple(statements)

    kept = tuple(a for a in function.arguments if a.optional != "missing")
    return function if kept == function.arguments else replace(function, arguments=kept, body=block(function.body))


@lru_cache(maxsize=1024)
def called_names(body: Statements) -> frozenset[str]:
    """Names of the functions that a body calls itself."""
    return frozenset(e.signature.name for e in expressions(body) if isinstance(e, Call))


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


class FreshNames:
    """Names that no other variable of a function has."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = set(taken)

    def __call__(self, wish: str) -> str:
        """`wish` itself, or with the least number that makes it new, in place of the number that it has."""
        name, number = wish, 1
        stem = re.sub(r"_\d+$", "", wish)
        while name in self._taken:
            number += 1
            name = f"{stem}_{number}"
        self._taken.add(name)
        return name

    def copy(self) -> FreshNames:
        """The same names taken; what is taken of the copy is not taken here."""
        return FreshNames(self._taken)

    def like(self, variable: Variable) -> Variable:
        """A variable of the same type under a name of its own."""
        return Variable(
            self(variable.name), variable.type, variable.shape, pointer=variable.pointer, written=variable.written
        )


def used_structs(functions: tuple[Function, ...]) -> list[Struct]:
    """Struct types of arguments and local variables, each after those that it holds."""
    types = [
        type_
        for f in functions
        for type_ in (
            *(a.type for a in f.arguments),
            *(s.variable.type for s in statements(f.body) if isinstance(s, Declare)),
        )
    ]
    return list(dict.fromkeys(s for type_ in types if isinstance(type_, Struct) for s in type_.inner_structs()))
