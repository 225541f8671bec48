"""Mutants of a program's function: one operation changed, by number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from mahovik.core.program.call import Call
from mahovik.core.program.expression import (
    Binary,
    BitCast,
    Compare,
    Const,
    Convert,
    Expr,
    Logic,
    Negate,
    Not,
    Place,
    Select,
)
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Let, Loop, Return, Set, Statement, When
from mahovik.core.program.types import Kind

TURNED = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}


@dataclass
class _Site:
    """Counts the places where something can be changed, and changes one of them."""

    wanted: int
    seen: int = 0
    kind: str = ""

    def here(self, kind: str) -> bool:
        """Is this the place? Each call is one."""
        self.seen += 1
        if self.seen - 1 != self.wanted:
            return False
        self.kind = kind
        return True


def sites(function: Function) -> int:
    """How many mutants a function has."""
    site = _Site(-1)
    _body(function.body, site)
    return site.seen


def mutant(function: Function, number: int) -> tuple[Function, str]:
    """The function with one operation changed, and what was done to it."""
    site = _Site(number)
    body = _body(function.body, site)
    if not site.kind:
        raise IndexError(f"{function.name} has {site.seen} mutants, not {number}")
    return replace(function, body=body), site.kind


MUTANTS = 10
"""Most mutants of one function."""


def chosen(count: int, most: int) -> list[int]:
    """Numbers of at most this many mutants, evenly spread."""
    return sorted({round((i + 0.5) * count / most - 0.5) for i in range(most)}) if count > most else list(range(count))


def _body(body: tuple[Statement, ...], site: _Site) -> tuple[Statement, ...]:
    return tuple(_statement(s, site) for s in body)


def _statement(s: Statement, site: _Site) -> Statement:
    match s:
        case Let() | Set():
            return replace(s, value=_expression(s.value, site))
        case Return() if s.value.kind is not Kind.STATUS:
            return replace(s, value=_expression(s.value, site))
        case Block():
            return replace(s, body=_body(s.body, site))
        case Loop():
            stop: Expr = s.stop
            if site.here("loop one turn short"):
                stop = Binary("-", s.stop, Const(1, Kind.INT))
            return replace(s, stop=stop, body=_body(s.body, site))
        case When():
            return replace(
                s,
                condition=_expression(s.condition, site),
                body=_body(s.body, site),
                otherwise=_body(s.otherwise, site),
            )
    return s


def _expression(e: Expr, site: _Site) -> Expr:
    """The expression with at most one operation changed. Places and what is called are left as they are."""
    match e:
        case Binary(operator="+" | "-"):
            left, right = _expression(e.left, site), _expression(e.right, site)
            if site.here("sign of a term"):
                return Binary("-" if e.operator == "+" else "+", left, right)
            if site.here("term dropped"):
                return left
            return Binary(e.operator, left, right)
        case Binary():
            return Binary(e.operator, _expression(e.left, site), _expression(e.right, site))
        case Negate():
            inner = _expression(e.operand, site)
            return inner if site.here("minus dropped") else Negate(inner)
        case Compare():
            left, right = _expression(e.left, site), _expression(e.right, site)
            operator = TURNED[e.operator] if site.here("comparison turned round") else e.operator
            return Compare(operator, left, right)
        case Logic():
            left, right = _expression(e.left, site), _expression(e.right, site)
            operator = ("||" if e.operator == "&&" else "&&") if site.here("and / or exchanged") else e.operator
            return Logic(operator, left, right)
        case Select():
            condition, yes, no = (_expression(x, site) for x in (e.condition, e.yes, e.no))
            return Select(condition, no, yes) if site.here("choice exchanged") else Select(condition, yes, no)
        case Const() if e.kind is Kind.REAL and e.value != 0 and not e.name:
            return Const(e.value * 1.5, e.kind) if site.here("number times 1.5") else e
        case Not():
            return Not(_expression(e.operand, site))
        case Convert():
            return Convert(_expression(e.operand, site), e.kind)
        case BitCast():
            return BitCast(_expression(e.operand, site), e.kind)
        case Call():
            return Call(e.signature, tuple(x if isinstance(x, Place) else _expression(x, site) for x in e.arguments))
    return e


def planted(name: str, number: int) -> Callable[[Any], Any]:
    """Puts a mutant into tuples of functions: what has no function of that name stays."""

    def change(functions: tuple[Function, ...]) -> tuple[Function, ...]:
        return tuple(mutant(f, number)[0] if f.name == name else f for f in functions)

    return change
