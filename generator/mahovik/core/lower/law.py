"""Functions that a law of `laws/` adds to a stand's program."""

from __future__ import annotations

from typing import cast

from mahovik.core.lower.law_table import LawTable
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.expression import Place


class LawLowering(LawTable):
    """A law between E0 and the carrier: LOWERING of the module `lower` of its folder.

    refuses    may its function refuse a state? Its status is RANGE then
    per_twist  does `slope` add what a change of twist makes?
    """

    refuses = False
    per_twist = False

    def add_functions(self, lib: Library) -> None:
        """Adds the functions that `act` calls."""

    def act(self, lib: Library, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds its wrench, in E1 about O1, to F. `table`: the table; `x`: the state; `C`: the attitude (9)."""
        raise NotImplementedError

    def add_slopes(self, lib: Library) -> None:
        """Adds the functions that `slope` calls."""

    def constant_slope(self, lib: Library, body: Body, table: Place, out: Place) -> None:
        """Adds the derivative by the twist, where it is a constant, to `out` (36, row by row)."""

    def slope(self, lib: Library, body: Body, table: Place, x: Place, C: Place, change: Place, F: Place) -> None:
        """Adds the change of its wrench with a change of twist to F."""


def laws_of(lib: Library) -> tuple[LawLowering, ...]:
    """The laws of `laws/` that the stand has."""
    return cast(tuple[LawLowering, ...], lib.layout.law_tables)
