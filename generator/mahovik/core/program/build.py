"""A builder of function bodies: what the compiler of kernels puts statements into."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
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
    When,
)
from mahovik.core.program.types import Kind, NamedCount, Struct

CHECKED = ("OK", "NOT_FINITE", "RANGE")
"""Statuses of a function that checks its inputs."""


class Body:
    """Collects the statements of a function; blocks are `with` blocks."""

    def __init__(self) -> None:
        self._blocks: list[list[Statement]] = [[]]
        self._status: Variable | None = None  # of calls that are checked

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

    def set(self, place: Any, value: Any, comment: str = "") -> None:
        """place = value; of an array or a vector element by element, of a struct whole."""
        if not isinstance(place, Place) or place.shape:
            if isinstance(value, OPERANDS) and not getattr(value, "shape", ()):
                raise TypeError(f"{place!r} is not a scalar")
            values = tuple(value)
            if len(place) != len(values):
                raise TypeError(f"{place!r} has {len(place)} elements, {value!r} {len(values)}")
            for one, element in zip(place, values, strict=True):
                self.set(one, element, comment)
                comment = ""
        elif isinstance(place.type, Struct):
            self.copy(place, value, comment)
        else:
            self._add(Set(place, as_expr(value, place.kind), comment))

    def add(self, place: Any, value: Any, comment: str = "", subtract: bool = False) -> None:
        """place += value, or -= with `subtract`; of an array element by element, without those that are 0."""
        if not isinstance(place, Place) or place.shape:
            for one, element in zip(place, value, strict=True):
                if isinstance(element, Expr) or element != 0:
                    self.add(one, element, comment, subtract)
                    comment = ""
        else:
            change = as_expr(value, place.kind)
            self._add(Set(place, -change if subtract else change, comment, add=True))

    def copy(self, target: Place, source: Place, comment: str = "") -> None:
        """A struct is copied whole."""
        self._add(Copy(target, source, comment))

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
    def when(self, test: Expr, comment: str = "") -> Iterator[None]:
        """if (test)"""
        condition(test)
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(When(test, body, (), comment))

    @contextmanager
    def otherwise(self) -> Iterator[None]:
        """else, of the `when` just before"""
        last = self._blocks[-1].pop()
        assert isinstance(last, When)
        self._blocks.append([])
        yield
        body = tuple(self._blocks.pop())
        self._add(When(last.condition, last.body, body, last.comment))
