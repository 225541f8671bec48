"""Copies small functions into their callers, and short loops out: longer straight stretches of code.

A function is copied where it has no loop, no status and no calls that stay: sine and cosine, what one flywheel adds.
Every local variable of the result has a name of its own. Operations and their order stay as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Const, Expr, Place, Variable
from mahovik.core.program.function import Function
from mahovik.core.program.statement import Block, Declare, Do, Let, Loop, Note, Return, Set, Statement, When
from mahovik.core.program.types import Kind, Struct
from mahovik.core.program.walk import FreshNames, map_expressions, rebuilt, substitution, used_variables, with_blocks

LONGEST = 6
"""Most iterations of a loop that is unrolled."""


class Inliner:
    """Functions of a program by name, each with what it calls copied into it."""

    def __init__(self, functions: dict[str, Function], reserved: tuple[str, ...] = ()) -> None:
        """`functions`: each after those it calls; `reserved`: names that no variable may get."""
        self._functions: dict[str, Function] = {}
        for name, function in functions.items():
            self._functions[name] = _Body(function, self._function_named, reserved).function()

    def _function_named(self, name: str) -> Function:
        return self._functions[name]

    def __getitem__(self, name: str) -> Function:
        return self._functions[name]


def is_flat(function: Function) -> bool:
    """Can the function be copied into its callers?"""
    return function.returns is not Kind.STATUS and _flat(function.body, outer=True)


def _flat(body: tuple[Statement, ...], outer: bool = False) -> bool:
    for number, s in enumerate(body):
        match s:
            case Note() | Let() | Declare() | Set():
                pass
            case Return() if outer and number == len(body) - 1:
                pass
            case When(_, inner, otherwise) if _flat(inner) and _flat(otherwise):
                pass
            case _:
                return False
    return True


def _gets_flat(body: tuple[Statement, ...], function_of: Callable[[str], Function]) -> bool:
    """Will the body of a loop be flat when functions are copied into it, and its own short loops out?"""
    for s in body:
        match s:
            case Do(call):
                callee = function_of(call.signature.name)
                if callee.returns is not None or not is_flat(callee):
                    return False
            case Loop(_, Const(), Const() as stop, inner) if not stop.name and int(stop.value) <= LONGEST:
                if not _gets_flat(inner, function_of):
                    return False
            case When(_, inner, otherwise) if _gets_flat(inner, function_of) and _gets_flat(otherwise, function_of):
                pass
            case _ if not _flat((s,)):
                return False
    return True


class _Body:
    """One function while it is rewritten."""

    def __init__(self, function: Function, function_of: Callable[[str], Function], reserved: tuple[str, ...]) -> None:
        self._function = function
        self._function_of = function_of
        self._fresh = FreshNames((*reserved, *(a.name for a in function.arguments)))

    def function(self) -> Function:
        return replace(self._function, body=tuple(self._block(self._function.body, {})))

    def _block(self, body: tuple[Statement, ...], meanings: dict[int, Expr]) -> Iterator[Statement]:
        for s in body:
            yield from self._statement(s, meanings)

    def _expr(self, e: Expr, meanings: dict[int, Expr], before: list[Statement]) -> Expr:
        """An expression; `before` gets what must be done before it: the bodies of the functions that it calls."""

        def inline_call(call: Call) -> Expr:
            function = self._function_of(call.signature.name)
            if function.returns is None:  # its value is a result
                result = function.arguments[-1]
                made = Variable(self._fresh(function.name), result.type, written=True)
                with_result = Call(function.signature, (*call.arguments, made.place))
                before.extend([Declare(made), *(self._fitting(function, with_result.arguments) or [Do(with_result)])])
                return made.place
            if not is_flat(function):
                raise TypeError(f"{call.signature.name} is called inside an expression, but cannot be copied there")
            steps, value = self._copy_body(call)
            before.extend(steps)
            assert value is not None
            return value

        return rebuilt(e, substitution(meanings), inline_call)

    def _statement(self, s: Statement, meanings: dict[int, Expr]) -> Iterator[Statement]:
        match s:
            case Do(call):
                yield from self._do(s, call, meanings)
            case Block(inner):
                yield from self._block(inner, meanings)
            case Loop():
                yield from self._loop(s, meanings)
            case _:
                before: list[Statement] = []
                new = map_expressions(s, lambda e: self._expr(e, meanings, before))
                yield from before
                if isinstance(new, Let | Declare):
                    new = replace(new, variable=self._again(new.variable, meanings))
                yield with_blocks(new, lambda inner: tuple(self._block(inner, dict(meanings))))

    def _again(self, variable: Variable, meanings: dict[int, Expr]) -> Variable:
        new = self._fresh.like(variable)
        meanings[id(variable)] = new.place
        return new

    def _do(self, s: Do, call: Call, meanings: dict[int, Expr]) -> Iterator[Statement]:
        before: list[Statement] = []
        new = tuple([self._expr(argument, meanings, before) for argument in call.arguments])
        yield from before
        function = self._function_of(call.signature.name)
        yield from self._fitting(function, new) or (replace(s, call=Call(function.signature, new)),)

    def _fitting(self, function: Function, arguments: tuple[Expr, ...]) -> list[Statement]:
        """The body of a function at a call where it is flat, perhaps with these arguments only; else nothing."""
        if function.returns is not None:
            return []
        if is_flat(function):
            return self._copy_body(Call(function.signature, arguments))[0]
        if not all(isinstance(s, Loop | Note | Declare) for s in function.body):
            return []
        names = self._fresh
        self._fresh = names.copy()
        steps = self._copy_body(Call(function.signature, arguments))[0]
        if _flat(tuple(steps)):
            return steps
        self._fresh = names
        return []

    def _loop(self, s: Loop, meanings: dict[int, Expr]) -> Iterator[Statement]:
        start, stop = (rebuilt(e, substitution(meanings)) for e in (s.start, s.stop))
        if isinstance(start, Const) and isinstance(stop, Const) and not stop.name:
            turns = range(int(start.value), int(stop.value))
            if len(turns) <= LONGEST and _gets_flat(s.body, self._function_of):
                for turn in turns:
                    yield from self._block(s.body, {**meanings, id(s.index): Const(turn, Kind.INT)})
                return
        inner = dict(meanings)
        index = self._again(s.index, inner)
        yield replace(s, index=index, start=start, stop=stop, body=tuple(self._block(s.body, inner)))

    def _copy_body(self, call: Call) -> tuple[list[Statement], Expr | None]:
        """The body of a function at a call, and the value that it returns."""
        function = self._function_of(call.signature.name)
        purpose = function.purpose[0].lower() + function.purpose[1:]
        steps: list[Statement] = [Note(f"{function.name}: {purpose}")] if function.returns is None else []
        meanings: dict[int, Expr] = {}
        used = used_variables(function.body)
        for parameter, value in zip(function.arguments, call.arguments, strict=True):
            if id(parameter.variable) not in used:
                continue
            if _by_name(parameter, value):
                meanings[id(parameter.variable)] = self._with_named_indices(value, steps)
            else:
                variable = Variable(self._fresh(parameter.name), value.kind)
                steps.append(Let(variable, value))
                meanings[id(parameter.variable)] = variable.place
        body = function.body
        last = body[-1] if body else None
        if not isinstance(last, Return):
            return [*steps, *self._block(body, meanings)], None
        steps += self._block(body[:-1], meanings)
        return steps, self._expr(last.value, meanings, steps)

    def _with_named_indices(self, value: Expr, before: list[Statement]) -> Expr:
        """A place whose indices that are read from memory have names: it is printed wherever the body uses it."""
        if not isinstance(value, Place):
            return value

        def named(step: str | Expr) -> str | Expr:
            if not isinstance(step, Place) or not step.path:
                return step
            index = Variable(self._fresh("index"), Kind.INT)
            before.append(Let(index, step))
            return index.place

        return Place(value.root, tuple(map(named, value.path)), value.type, value.shape)


def _by_name(parameter: Argument, value: Expr) -> bool:
    """May the argument stand in the body as it is? What is computed, or read from a place, gets a name there."""
    if parameter.shape or isinstance(parameter.type, Struct) or parameter.direction != "in":
        return True
    if isinstance(value, Const):
        return True
    return isinstance(value, Place) and not value.path and not value.root.written
