"""A builder of function bodies: lowering code reads like the C that comes out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from mahovik.core.program.call import Argument, Call
from mahovik.core.program.expression import Expr, Operand, Place, Status, Variable, as_expr
from mahovik.core.program.function import Function
from mahovik.core.program.statement import (
    Block,
    Copy,
    Declare,
    Do,
    Let,
    Loop,
    Note,
    Return,
    Set,
    Shortcut,
    Statement,
    When,
)
from mahovik.core.program.types import Kind, NamedCount, Struct

CHECKED = ("OK", "NOT_FINITE", "RANGE")
"""Statuses of a function that checks its inputs."""


class Body:
    """Collects the statements of a function; blocks are `with` blocks."""

    def __init__(self) -> None:
        self._blocks: list[list[Statement]] = [[]]

    def _add(self, statement: Statement) -> None:
        self._blocks[-1].append(statement)

    @property
    def statements(self) -> tuple[Statement, ...]:
        """The collected statements; all blocks must be closed."""
        assert len(self._blocks) == 1
        return tuple(self._blocks[0])

    def note(self, text: str) -> None:
        """A comment line."""
        self._add(Note(text))

    def let(self, name: str, value: Expr, comment: str = "") -> Place:
        """A named temporary that gets its value once."""
        variable = Variable(name, value.kind)
        self._add(Let(variable, value, comment))
        return variable.place

    def local(
        self,
        name: str,
        shape: Sequence[int | NamedCount] = (),
        type_: Kind | Struct = Kind.REAL,
        comment: str = "",
    ) -> Place:
        """A local array, struct or scalar that is written later."""
        variable = Variable(name, type_, tuple(shape), written=not shape and isinstance(type_, Kind))
        self._add(Declare(variable, comment))
        return variable.place

    def set(self, place: Place, value: Operand, comment: str = "") -> None:
        """place = value"""
        self._add(Set(_scalar(place), as_expr(value, place.kind), comment))

    def add(self, place: Place, value: Operand, comment: str = "") -> None:
        """place += value"""
        self._add(Set(_scalar(place), as_expr(value, place.kind), comment, add=True))

    def copy(self, target: Place, source: Place, comment: str = "") -> None:
        """A struct is copied whole."""
        self._add(Copy(target, source, comment))

    def copy_array(self, target: Place, source: Place) -> None:
        """The elements of a one-dimensional array are copied one by one."""
        if len(target) != len(source):
            raise TypeError(f"{target!r} has {len(target)} elements, {source!r} {len(source)}")
        for i in range(len(target)):
            self.set(target[i], source[i])

    def call(self, function: Function, *arguments: Operand, comment: str = "") -> None:
        """A call whose results are its output arguments."""
        self._add(Do(_call(function, arguments), comment))

    def function(
        self,
        name: str,
        purpose: str,
        arguments: tuple[Argument, ...],
        equation: str = "",
        returns: Kind | None = None,
        notes: tuple[str, ...] = (),
        public: bool = False,
    ) -> Function:
        """The function of this body, without a status."""
        return Function(name, purpose, arguments, self.statements, equation, returns, (), notes, public)

    def checked_function(
        self,
        name: str,
        purpose: str,
        arguments: tuple[Argument, ...],
        statuses: tuple[str, ...] = CHECKED,
        equation: str = "",
        notes: tuple[str, ...] = (),
        public: bool = False,
    ) -> Function:
        """The function of this body, which returns OK where it has not returned another status before."""
        self.ret(Status("OK"))
        return Function(name, purpose, arguments, self.statements, equation, Kind.STATUS, statuses, notes, public)

    def ret(self, value: Expr) -> None:
        """return value"""
        self._add(Return(value))

    @contextmanager
    def loop(self, name: str, stop: Operand, start: Operand = 0, comment: str = "", most: int = 1) -> Iterator[Place]:
        """for name in start..stop-1"""
        index = Variable(name, Kind.INT)
        self._blocks.append([])
        yield index.place
        body = tuple(self._blocks.pop())
        self._add(Loop(index, as_expr(start, Kind.INT), as_expr(stop, Kind.INT), body, comment, most))

    @contextmanager
    def block(self) -> Iterator[None]:
        """A block of its own: its locals end with it. (One turn of a loop that is not printed as such.)"""
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(Block(body))

    @contextmanager
    def shortcut(self) -> Iterator[None]:
        """A block that may return early what would be returned anyway."""
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(Shortcut(body))

    @contextmanager
    def when(self, condition: Expr, comment: str = "") -> Iterator[None]:
        """if (condition)"""
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(When(condition, body, (), comment))

    @contextmanager
    def otherwise(self) -> Iterator[None]:
        """else, of the `when` just before"""
        last = self._blocks[-1].pop()
        assert isinstance(last, When)
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(When(last.condition, last.body, body, last.comment))


def call(function: Function, *arguments: Operand) -> Expr:
    """A call as an expression, of a function that returns a real or a status."""
    if function.returns is None:
        raise TypeError(f"{function.name} returns nothing")
    return _call(function, arguments)


def _call(function: Function, arguments: Sequence[Operand]) -> Call:
    if len(arguments) != len(function.arguments):
        raise TypeError(f"{function.name} takes {len(function.arguments)} arguments, not {len(arguments)}")
    return Call(
        function.signature,
        tuple(_checked_argument(a, p, function) for a, p in zip(arguments, function.arguments, strict=True)),
    )


def _checked_argument(value: Operand, parameter: Argument, function: Function) -> Expr:
    """`value` as what `parameter` takes: kinds, structs and lengths are checked here, once, for every call."""
    where = f"{function.name}, argument {parameter.name}"
    if parameter.shape or isinstance(parameter.type, Struct) or parameter.direction != "in":
        if not isinstance(value, Place) or value.type != parameter.type or len(value.shape) != len(parameter.shape):
            raise TypeError(f"{where}: {value!r} does not fit")
        for have, want in zip(value.shape, parameter.shape, strict=True):
            # A length of 0 stands for "any": the callee gets the length as an argument of its own.
            if int(want) and int(have) != int(want):
                raise TypeError(f"{where}: {value!r} has {int(have)} elements, expected {int(want)}")
        return value
    assert isinstance(parameter.type, Kind)
    expr = as_expr(value, parameter.type)
    if expr.kind is not parameter.type:
        raise TypeError(f"{where}: {expr.kind.value} given, {parameter.type.value} expected")
    return expr


def _scalar(place: Place) -> Place:
    if not place.is_scalar:
        raise TypeError(f"{place!r} is not a scalar")
    return place
