"""Small programs for tests: one function from a few lines, run by the interpreter."""

from collections.abc import Callable, Sequence
from typing import Any

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, Kind, NamedCount, Precision, Struct


def argument(
    name: str, kind: Kind | Struct = Kind.REAL, shape: tuple[int | NamedCount, ...] = (), direction: str = "in"
) -> Argument:
    """An argument."""
    return Argument(name, kind, shape, direction)


def function(
    name: str,
    arguments: Sequence[Argument],
    write: Callable[..., object],
    returns: Kind | None = None,
    public: bool = True,
) -> Function:
    """A function whose body `write(body, *places)` writes."""
    body = Body()
    write(body, *(a.place for a in arguments))
    return Function(name, f"{name}.", tuple(arguments), body.statements, returns=returns, public=public)


def value_of(kinds: Sequence[Kind], tree: Callable[..., Any], returns: Kind | None = Kind.REAL) -> Function:
    """A function `f` of scalars of some kinds that returns tree(*scalars)."""
    arguments = [argument(f"a{i}", kind) for i, kind in enumerate(kinds)]
    return function("f", arguments, lambda body, *places: body.ret(tree(*places)), returns)


def program(*functions: Function, precision: Precision = DOUBLE, structs: Sequence[Struct] = ()) -> Program:
    """A program of those functions."""
    return Program("t", precision, (), tuple(structs), tuple(functions))


def run(function: Function, inputs: dict[str, Any], precision: Precision = DOUBLE) -> tuple[Any, dict[str, Any]]:
    """Value and outputs of one function."""
    return Interpreter(program(function, precision=precision)).run(function.name, inputs)


def evaluate(kinds: Sequence[Kind], tree: Callable[..., Any], *values: Any, precision: Precision = DOUBLE) -> Any:
    """tree of scalars of some kinds, evaluated."""
    f = value_of(kinds, tree)
    numbers = [precision.scalar(v) if k is Kind.REAL else v for k, v in zip(kinds, values, strict=True)]
    return Interpreter(program(f, precision=precision)).call("f", *numbers)
