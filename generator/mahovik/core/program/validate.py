"""Checks of a program that C would only warn of: no name hides another, nothing is used before it is declared."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.program.expression import Expr, Place, Variable
from mahovik.core.program.function import Function, Program
from mahovik.core.program.statement import Block, Declare, Let, Loop, Return, Statement, When
from mahovik.core.program.types import Kind
from mahovik.core.program.walk import called, expressions, used_variables


def validate(program: Program) -> None:
    """Raises ValueError with the function and the name where a program is not well-formed."""
    names = [f.name for f in program.functions] + [s.name for s in program.structs]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{name} names two things")
    known: set[str] = set()
    for function in program.functions:
        unknown = called(function.body) - known
        if unknown:
            raise ValueError(f"{function.name} calls {sorted(unknown)[0]}, which does not come before it")
        known.add(function.name)
        scope = {a.name: id(a.variable) for a in function.arguments}
        _check_block(function, function.body, scope)
        used = used_variables(function.body)
        for variable in _declared(function.body):
            if id(variable) not in used:
                raise ValueError(f"{function.name}: {variable.name} is never used")


def _declared(body: tuple[Statement, ...]) -> Iterator[Variable]:
    for statement in body:
        match statement:
            case Let(variable) | Declare(variable):
                yield variable
            case Loop(_, _, _, inner) | Block(inner):
                yield from _declared(inner)
            case When(_, inner, otherwise):
                yield from _declared(inner)
                yield from _declared(otherwise)


def _check_block(function: Function, body: tuple[Statement, ...], scope: dict[str, int]) -> None:
    scope = dict(scope)
    for statement in body:
        match statement:
            case Let(variable, value):
                _check_uses(function, value, scope)
                _declare(function, variable.name, id(variable), scope)
            case Declare(variable):
                _declare(function, variable.name, id(variable), scope)
            case Loop(index, start, stop, inner):
                _check_uses(function, start, scope)
                _check_uses(function, stop, scope)
                nested = dict(scope)
                _declare(function, index.name, id(index), nested)
                _check_block(function, inner, nested)
            case Block(inner):
                _check_block(function, inner, scope)
            case When(condition, inner, otherwise):
                _check_uses(function, condition, scope)
                _check_block(function, inner, scope)
                _check_block(function, otherwise, scope)
            case _:
                for e in expressions((statement,)):
                    _check_place(function, e, scope)


def _declare(function: Function, name: str, identity: int, scope: dict[str, int]) -> None:
    if name in scope:
        raise ValueError(f"{function.name}: {name} hides another {name}")
    scope[name] = identity


def _check_uses(function: Function, value: Expr, scope: dict[str, int]) -> None:
    for e in expressions((Return(value),)):
        _check_place(function, e, scope)


def _check_place(function: Function, e: Expr, scope: dict[str, int]) -> None:
    if not isinstance(e, Place):
        return
    if scope.get(e.root.name) != id(e.root):
        raise ValueError(f"{function.name}: {e.root.name} is used outside its block")
    for step in e.path:
        if isinstance(step, Expr) and step.kind is not Kind.INT:
            raise ValueError(f"{function.name}: {e!r} has an index that is no int")
