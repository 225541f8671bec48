"""Removes calls of functions that do nothing but return OK: a clamped carrier has no equations to solve."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Status
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Declare, Return, Set, Statement, Statements, When
from mahovik.core.program.walk import used_variables, with_blocks


def without_idle_calls(functions: Sequence[Function]) -> tuple[Function, ...]:
    """The functions without calls of idle ones and the checks of their status; without such calls they are the same."""
    idle = {function.name for function in functions if not function.public and _is_idle(function)}
    return tuple(_leave_out(function, idle) for function in functions) if idle else tuple(functions)


def _is_idle(function: Function) -> bool:
    match function.body:
        case (Return(Status(name="OK")),):
            return True
    return False


def _leave_out(function: Function, idle: set[str]) -> Function:
    body = _block(function.body, idle)
    used = used_variables(body)
    before = used_variables(function.body)
    unused = before - used
    return replace(function, body=tuple(s for s in body if not (isinstance(s, Declare) and id(s.variable) in unused)))


def _block(body: Statements, idle: set[str]) -> Statements:
    kept: list[Statement] = []
    checked = False
    for s in body:
        if checked and isinstance(s, When):
            checked = False
            continue
        checked = isinstance(s, Set) and isinstance(s.value, Call) and s.value.signature.name in idle
        if not checked:
            kept.append(with_blocks(s, lambda inner: _block(inner, idle)))
    return tuple(kept)
