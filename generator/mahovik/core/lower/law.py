"""The lowering of a law of `laws/`: members of structs, and functions, that it adds to a stand's program.

Of a law between E0 and the carrier `LawLowering`; of one that acts on a body in its own frame by functions that begin
as `TwistFunction` does.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.member import Member
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure_facts import Structure


class LawLowering:
    """A law between E0 and the carrier: LOWERING of the module `lower` of its folder.

    Every law has its own form of the methods that raise NotImplementedError; the empty ones it may leave as they are.

    words        the law in the list of kinds of wrench
    placed       does its wrench depend on the place of O1?
    invalid      what of it may have a length that it must not have, for the list of statuses; "" for nothing
    quaternions  places in the table that must have unit length
    refuses      may its function refuse a state? Its status is RANGE then
    """

    words: str
    placed = True
    invalid = ""
    quaternions: tuple[str, ...] = ()
    refuses = False

    def present(self, structure: Structure) -> bool:
        """Whether a stand has the law."""
        raise NotImplementedError

    def fields(self, structure: Structure) -> list[Field]:
        """Members that the law adds to the table."""
        raise NotImplementedError

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """The numbers of its members, by name; `run` runs a function of the program."""
        raise NotImplementedError

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """Every real of one of its members, depth first, for simulators; none that follows from the hold."""
        raise NotImplementedError

    def add_functions(self, lib: FunctionSet) -> None:
        """Adds the functions that `act` calls."""

    def act(self, lib: FunctionSet, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds its wrench, in E1 about O1, to F. `table`: the table; `x`: the state; `C`: the attitude (9)."""
        raise NotImplementedError


class TwistFunction:
    """A function that adds the wrench of a body by its own twist to P.

    table, damper  prepared table, and its part that belongs to the body
    V              twist of the body relative to the fluid, in the body's frame
    P              wrench of the body, to which the function adds
    body           statements
    """

    def __init__(self, lib: FunctionSet) -> None:
        V = Argument("V", Kind.REAL, (6,), purpose="twist relative to the fluid, in the body's frame")
        P = Argument("P", Kind.REAL, (6,), "inout", "N, N m", "wrench; this law is added to it")
        table, damper = lib.table_argument(), Argument("damper", lib.layout.damper)
        self._arguments = (table, damper, V, P)
        self.table, self.damper, self.V, self.P = (a.place for a in self._arguments)
        self.body = Body()

    @contextmanager
    def each(self, array: str, most: int, index: str = "k") -> Iterator[Place]:
        """Loop over the structs of an array of the table that belong to the body, at most `most`."""
        first, last = (self.damper.member(f"{end}_{array}") for end in ("first", "last"))
        with self.body.loop(index, last, start=first, most=most) as k:
            yield self.table.member(array)[k]

    def function(self, name: str, purpose: str) -> Function:
        """The function."""
        return self.body.function(name, purpose, self._arguments, equation="(7)")
