"""Functions and whole programs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

from mahovik.core.program.call import Argument, Call, Signature
from mahovik.core.program.expression import Expr, Missing, Operand, Place, Variable, as_expr, to_write
from mahovik.core.program.statement import Statement
from mahovik.core.program.types import Kind, NamedCount, Precision, ProgramError, Struct


@dataclass(frozen=True, eq=False)
class Function:
    """A function of the program.

    `equation` are numbers of the paper, "(8)"; `returns` None, REAL or STATUS; `statuses` those it can return;
    `notes` further lines of the contract; `public` functions stand in the header; `apart`: not copied into its callers;
    `short`: a compiler is asked to copy it there, which takes fewer instructions and no more code than calls;
    `copied`: on desktop processors it is made to copy it there, which is faster and takes more code;
    `parameters`: names of all arguments of its text, of which some may have been left out.
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
    parameters: tuple[str, ...] = ()

    def __call__(self, *arguments: Any) -> Any:
        """A Call: an expression, if the function returns a real or a status. Arguments: operands, of results places.

        There may be one for each of its parameters, and none, or None, for those that may be missing.
        """
        if len(arguments) == len(self.parameters):
            taken = [a.name for a in self.arguments]
            arguments = tuple(v for name, v in zip(self.parameters, arguments, strict=True) if name in taken)
        if len(arguments) == sum(a.optional != "missing" for a in self.arguments):
            passed = iter(arguments)
            arguments = tuple(Missing() if a.optional == "missing" else next(passed) for a in self.arguments)
        if len(arguments) != len(self.arguments):
            raise ProgramError(f"{self.name} takes {len(self.arguments)} arguments, not {len(arguments)}")
        return Call(self.signature, tuple(map(self._checked_argument, arguments, self.arguments)))

    def _checked_argument(self, value: Operand | None, parameter: Argument) -> Expr:
        """`value` as what `parameter` takes: kinds, structs and lengths are checked here, once, for every call."""
        where = f"{self.name}, argument {parameter.name}"
        if isinstance(value, Missing) or (value is None and parameter.optional == "missing"):
            return Missing()
        if parameter.shape or isinstance(parameter.type, Struct) or parameter.direction != "in":
            if not isinstance(value, Place) or value.type != parameter.type or len(value.shape) != len(parameter.shape):
                raise ProgramError(f"{where}: {value!r} does not fit")
            for have, want in zip(value.shape, parameter.shape, strict=True):
                # A length of 0 stands for "any": the callee gets the length as an argument of its own.
                if int(want) and int(have) != int(want):
                    raise ProgramError(f"{where}: {value!r} has {int(have)} elements, expected {int(want)}")
            return value if parameter.direction == "in" else to_write(value)
        try:
            return as_expr(cast(Operand, value), parameter.type)
        except ProgramError as error:
            raise ProgramError(f"{where}: {error}") from None

    @property
    def signature(self) -> Signature:
        """Facts that a call of the function needs."""
        return Signature(self.name, self.arguments, self.returns)


@dataclass(frozen=True, eq=False)
class Program:
    """A whole program: functions in an order in which each comes after what it calls.

    spare   functions that these do not call, for states side by side
    called  functions of another file: public ones that these call, and what those call
    constants  of another file
    """

    name: str
    precision: Precision
    counts: tuple[NamedCount, ...]
    structs: tuple[Struct, ...]
    functions: tuple[Function, ...]
    spare: tuple[Function, ...] = ()
    called: tuple[Function, ...] = ()
    constants: tuple[Variable, ...] = ()

    @cached_property
    def whole(self) -> tuple[Function, ...]:
        """All functions, with those of another file."""
        return (*self.called, *self.functions)

    def function(self, name: str) -> Function:
        """The function of that name. Raises KeyError."""
        return self._by_name[name]

    @cached_property
    def _by_name(self) -> dict[str, Function]:
        return {function.name: function for function in self.functions}
