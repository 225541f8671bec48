"""Checks of a program that C would only warn of: no name hides another, no use before a declaration, no idle loop."""

from __future__ import annotations

from mahovik.core.program.expression import Place, Variable
from mahovik.core.program.function import Function, Program
from mahovik.core.program.simplify import loops_of_no_turn
from mahovik.core.program.statement import Declare, Let, Loop, Statements
from mahovik.core.program.walk import blocks, called_names, direct_expressions, inside, statements, used_variables


def validate(program: Program) -> None:
    """Raises ValueError with the function and the name where a program is not well-formed."""
    names = [f.name for f in program.functions] + [s.name for s in program.structs]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{name} names two things")
    known = {f.name for f in program.called if f.public}
    for function in program.functions:
        unknown = called_names(function.body) - known
        if unknown:
            raise ValueError(f"{function.name} calls {sorted(unknown)[0]}, which does not come before it")
        known.add(function.name)
        variables = (*program.constants, *(a.variable for a in function.arguments))
        scope = {variable.name: id(variable) for variable in variables}
        _check_block(function, function.body, scope)
        used = used_variables(function.body)
        for loop in loops_of_no_turn(function.body):
            raise ValueError(f"{function.name}: the loop over {loop.index.name} has no turn")
        for s in statements(function.body):
            if isinstance(s, Let | Declare) and id(s.variable) not in used:
                raise ValueError(f"{function.name}: {s.variable.name} is never used")


def _check_block(function: Function, body: Statements, scope: dict[str, int]) -> None:
    scope = dict(scope)
    for s in body:
        for e in direct_expressions(s):
            for part in inside(e):
                if isinstance(part, Place) and scope.get(part.root.name) != id(part.root):
                    raise ValueError(f"{function.name}: {part.root.name} is used outside its block")
        within = scope
        match s:
            case Let(variable) | Declare(variable):
                _declare(function, variable, scope)
            case Loop(index):
                within = dict(scope)
                _declare(function, index, within)
        for inner in blocks(s):
            _check_block(function, inner, within)


def _declare(function: Function, variable: Variable, scope: dict[str, int]) -> None:
    if variable.name in scope:
        raise ValueError(f"{function.name}: {variable.name} hides another {variable.name}")
    scope[variable.name] = id(variable)
