"""Calls of functions. A call knows the signature of its function and not the body: a program finds that by the name."""

from __future__ import annotations

from dataclasses import dataclass, field

from mahovik.core.program.expression import Expr, Place, Variable
from mahovik.core.program.types import Kind, NamedCount, Struct


@dataclass(frozen=True, eq=False)
class Argument:
    """An argument: `direction` is "in", "out" or "inout"; unit, frame and purpose are for the reader."""

    name: str
    type: Kind | Struct
    shape: tuple[int | NamedCount, ...] = ()
    direction: str = "in"
    unit: str = ""
    purpose: str = ""
    variable: Variable = field(init=False)

    def __post_init__(self) -> None:
        pointer = not self.shape and (isinstance(self.type, Struct) or self.direction != "in")
        object.__setattr__(self, "variable", Variable(self.name, self.type, self.shape, pointer))

    @property
    def place(self) -> Place:
        return self.variable.place


@dataclass(frozen=True, eq=False)
class Signature:
    """Name, arguments and result of a function; `returns` is None, REAL or STATUS."""

    name: str
    arguments: tuple[Argument, ...]
    returns: Kind | None = None


class Call(Expr):
    """A call of a function. Array and struct arguments are whole places. It has a kind only if it returns something."""

    __slots__ = ("arguments", "signature")

    def __init__(self, signature: Signature, arguments: tuple[Expr, ...]) -> None:
        self.signature = signature
        self.arguments = arguments
        if signature.returns is not None:
            self.kind = signature.returns
