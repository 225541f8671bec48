"""Functions and whole programs."""

from __future__ import annotations

from dataclasses import dataclass

from mahovik.core.program.call import Argument, Signature
from mahovik.core.program.statement import Statement
from mahovik.core.program.types import Kind, NamedCount, Precision, Struct


@dataclass(frozen=True, eq=False)
class Function:
    """A function of the program.

    `equation` are numbers of the paper, "(8)"; `returns` None, REAL or STATUS; `statuses` those it can return;
    `notes` further lines of the contract; `public` functions stand in the header; `apart`: not copied into its callers;
    `short`: a compiler is asked to copy it there, which takes fewer instructions and no more code than calls;
    `copied`: on desktop processors it is made to copy it there, which is faster and takes more code.
    """

    name: str
    purpose: str
    arguments: tuple[Argument, ...]
    body: tuple[Statement, ...]
    equation: str = ""
    returns: Kind | None = None
    statuses: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    public: bool = False
    apart: bool = False
    short: bool = False
    copied: bool = False

    @property
    def signature(self) -> Signature:
        """Facts that a call of the function needs."""
        return Signature(self.name, self.arguments, self.returns)


@dataclass(frozen=True, eq=False)
class Program:
    """A whole program: functions in an order in which each comes after what it calls.

    spare  functions that these do not call, for states side by side
    """

    name: str
    precision: Precision
    counts: tuple[NamedCount, ...]
    structs: tuple[Struct, ...]
    functions: tuple[Function, ...]
    spare: tuple[Function, ...] = ()

    def function(self, name: str) -> Function:
        """The function of that name. Raises KeyError."""
        for function in self.functions:
            if function.name == name:
                return function
        raise KeyError(name)
