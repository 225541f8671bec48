"""Small programs for tests: one function from a few lines, run by the interpreter."""

from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.function import Function, Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import DOUBLE, Kind, Precision


def argument(name: str, kind=Kind.REAL, shape=(), direction="in"):
    """An argument."""
    return Argument(name, kind, shape, direction)


def function(name: str, arguments, write, returns=None, public=True):
    """A function whose body `write(body, *places)` writes."""
    body = Body()
    write(body, *(a.place for a in arguments))
    return Function(name, f"{name}.", tuple(arguments), body.statements, returns=returns, public=public)


def value_of(kinds, tree, returns=Kind.REAL):
    """A function `f` of scalars of some kinds that returns tree(*scalars)."""
    arguments = [argument(f"a{i}", kind) for i, kind in enumerate(kinds)]
    return function("f", arguments, lambda body, *places: body.ret(tree(*places)), returns)


def program(*functions, precision: Precision = DOUBLE, structs=()):
    """A program of those functions."""
    return Program("t", precision, (), tuple(structs), tuple(functions))


def run(function, inputs, precision: Precision = DOUBLE):
    """Value and outputs of one function."""
    return Interpreter(program(function, precision=precision)).run(function.name, inputs)


def evaluate(kinds, tree, *values, precision: Precision = DOUBLE):
    """tree of scalars of some kinds, evaluated."""
    f = value_of(kinds, tree)
    numbers = [precision.scalar(v) if k is Kind.REAL else v for k, v in zip(kinds, values, strict=True)]
    return Interpreter(program(f, precision=precision)).call("f", *numbers)
