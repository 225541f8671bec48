"""Statements of a program."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.call import Call
from mahovik.core.program.expression import Expr, Place, Variable


@dataclass(frozen=True, eq=False)
class Let:
    """A local scalar that gets its value once."""

    variable: Variable
    value: Expr
    comment: str = ""


@dataclass(frozen=True, eq=False)
class Declare:
    """A local array, struct or scalar that is written later."""

    variable: Variable
    comment: str = ""


@dataclass(frozen=True, eq=False)
class Set:
    """place = value; with `add`, place += value."""

    place: Place
    value: Expr
    comment: str = ""
    add: bool = False


@dataclass(frozen=True, eq=False)
class Copy:
    """A whole struct is copied."""

    target: Place
    source: Place
    comment: str = ""


@dataclass(frozen=True, eq=False)
class Do:
    """A call whose results are its output arguments."""

    call: Call
    comment: str = ""


@dataclass(frozen=True, eq=False)
class Loop:
    """for (index = start; index < stop; ++index). `most`: turns to count where the bounds are not literals."""

    index: Variable
    start: Expr
    stop: Expr
    body: Statements
    comment: str = ""
    most: int = 1


@dataclass(frozen=True, eq=False)
class When:
    """if (condition) ... else ..."""

    condition: Expr
    body: Statements
    otherwise: Statements = ()
    comment: str = ""


@dataclass(frozen=True, eq=False)
class Return:
    """return value"""

    value: Expr


@dataclass(frozen=True, eq=False)
class Note:
    """A comment on a line of its own, before what it speaks of."""

    text: str


@dataclass(frozen=True, eq=False)
class Block:
    """{ ... }: locals of their own."""

    body: Statements


@dataclass(frozen=True, eq=False)
class Shortcut(Block):
    """A quick way to return what the statements after it would return as well.

    States side by side do not need it: they leave it out.
    """


Statement = Block | Let | Declare | Set | Copy | Do | Loop | When | Return | Note
Statements = tuple[Statement, ...]
"""Statements of a function or a block."""
