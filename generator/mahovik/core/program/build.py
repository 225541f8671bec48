"""A builder of function bodies: what the compiler of kernels puts statements into."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from functools import partial
from typing import Any

from mahovik.core.program.call import Call
from mahovik.core.program.expression import (
    OPERANDS,
    Expr,
    Operand,
    Place,
    Status,
    Variable,
    as_expr,
    condition,
    paired,
    to_write,
    unequal,
)
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
    Statements,
    When,
)
from mahovik.core.program.types import Kind, NamedCount, ProgramError, Struct

CHECKED = ("OK", "NOT_FINITE", "RANGE")
"""Statuses of a function that checks its inputs."""


def returns(body: Sequence[Statement]) -> bool:
    """Does every way through the statements end with a return?"""
    match body[-1:]:
        case [Return()]:
            return True
        case [When(_, inner, otherwise)]:
            return returns(inner) and returns(otherwise)
        case [Block(inner) as block]:
            return returns(inner) and not isinstance(block, Shortcut)
    return False


class Body:
    """Collects the statements of a function; blocks are `with` blocks."""

    def __init__(self) -> None:
        self._blocks: list[list[Statement]] = [[]]
        self._status: Variable | None = None  # of calls that are checked

    def _add(self, statement: Statement) -> None:
        if returns(self._blocks[-1]):
            raise ProgramError("no state comes here: all that stands before has returned")
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
        variable = Variable(name, type_, tuple(shape), written=True)
        self._add(Declare(variable, comment))
        return variable.place

    def set(self, place: Any, value: Any, comment: str = "") -> None:
        """place = value; of an array or a vector element by element, of a struct whole."""
        if not isinstance(place, Place) or place.shape:
            if isinstance(value, OPERANDS) and not getattr(value, "shape", ()):
                raise ProgramError(f"{place!r} is not a scalar")
            for one, element in paired(place, tuple(value)):
                self.set(one, element, comment)
                comment = ""
        elif isinstance(place.type, Struct):
            self.copy(place, value, comment)
        else:
            self._add(Set(to_write(place), as_expr(value, place.kind), comment))

    def add(self, place: Any, value: Any, comment: str = "", subtract: bool = False) -> None:
        """place += value, or -= with `subtract`; of an array element by element, without those that are 0."""
        if not isinstance(place, Place) or place.shape:
            for one, element in paired(place, value):
                if isinstance(element, Expr) or element != 0:
                    self.add(one, element, comment, subtract)
                    comment = ""
        else:
            change = as_expr(value, place.kind)
            self._add(Set(to_write(place), -change if subtract else change, comment, add=True))

    def copy(self, target: Place, source: Place, comment: str = "") -> None:
        """A struct is copied whole."""
        if not isinstance(source, Place) or (source.type, source.shape) != (target.type, ()):
            raise ProgramError(f"{source!r} is no {target!r}: expected the same struct")
        self._add(Copy(to_write(target), source, comment))

    def check(self, call: Expr, status: str = "") -> None:
        """A call that returns a status: where it is not OK, that is returned, or `status` in its place."""
        if self._status is None:
            self._status = Variable("status", Kind.STATUS, written=True)
            first = self._blocks[0]
            first.insert(1 if first and isinstance(first[0], Shortcut) else 0, Declare(self._status))
        self.set(self._status.place, call)
        with self.when(unequal(self._status.place, Status("OK"))):
            self.ret(Status(status) if status else self._status.place)

    def do(self, call: Call, comment: str = "") -> None:
        """A call as a statement."""
        self._add(Do(call, comment))

    def ret(self, value: Expr) -> None:
        """return value"""
        self._add(Return(value))

    @contextmanager
    def _inner(self, outer: Callable[[Statements], Statement]) -> Iterator[None]:
        """Statements that become a part of another one, `outer`."""
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(outer(body))

    @contextmanager
    def loop(self, name: str, stop: Operand, start: Operand = 0, comment: str = "", most: int = 1) -> Iterator[Place]:
        """for name in start..stop-1"""
        index = Variable(name, Kind.INT)
        first, last = as_expr(start, Kind.INT), as_expr(stop, Kind.INT)
        with self._inner(lambda body: Loop(index, first, last, body, comment, most)):
            yield index.place

    def block(self) -> AbstractContextManager[None]:
        """A block of its own: its locals end with it. (One turn of a loop that is not printed as such.)"""
        return self._inner(Block)

    def shortcut(self) -> AbstractContextManager[None]:
        """A block that may return early what would be returned anyway."""
        return self._inner(Shortcut)

    def when(self, test: Expr, comment: str = "") -> AbstractContextManager[None]:
        """if (test)"""
        return self._inner(partial(When, condition(test), comment=comment))

    def otherwise(self) -> AbstractContextManager[None]:
        """else, of the `when` just before"""
        last = self._blocks[-1].pop()
        assert isinstance(last, When)
        return self._inner(lambda body: replace(last, otherwise=body))
