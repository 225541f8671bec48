"""Calls of functions. A call knows the signature of its function and not the body: a program finds that by the name."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Literal

from mahovik.core.program.expression import Expr, Place, Variable
from mahovik.core.program.types import Kind, ProgramError, Shape, Struct


@dataclass(frozen=True, eq=False)
class Argument:
    """An argument: `direction` is "in", "out" or "inout"; unit, frame and purpose are for the reader.

    `optional`: its address may be null in a call of a public function: then it is "zeros", or it is "missing", which
    the function sees by `Present`; empty: it may not.
    `overlaps`: a result of a public function that may overlap any of its inputs.
    """

    name: str
    type: Kind | Struct
    shape: Shape = ()
    direction: str = "in"
    unit: str = ""
    purpose: str = ""
    optional: Literal["", "zeros", "missing"] = ""
    overlaps: bool = False
    variable: Variable = field(init=False)

    def __post_init__(self) -> None:
        pointer = not self.shape and (isinstance(self.type, Struct) or self.direction != "in")
        object.__setattr__(
            self, "variable", Variable(self.name, self.type, self.shape, pointer, self.direction != "in")
        )

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

    def __getattr__(self, name: str) -> Kind:
        if name == "kind":
            raise ProgramError(f"{self.signature.name} returns nothing")
        raise AttributeError(name)

    @property
    def operands(self) -> tuple[Expr, ...]:
        return self.arguments

    def with_operands(self, part: Callable[[Expr], Expr]) -> Expr:
        return Call(self.signature, tuple(part(a) for a in self.arguments))

    @property
    def pairs(self) -> Iterator[tuple[Argument, Expr]]:
        """Each parameter with its argument."""
        return zip(self.signature.arguments, self.arguments, strict=True)
