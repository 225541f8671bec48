"""Tugs in the program of a stand."""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import WRENCH, BodyProgram, declared
from mahovik.core.program.kernel import Reals
from mahovik.core.program.types import Field, Struct
from mahovik.core.stand.fields import ZERO3
from mahovik.core.stand.model import Body, Structure

from .law import Tug  # noqa: TID252  # its package is that of the laws


class TugProgram(BodyProgram):
    """The force of every body, in its damper."""

    words = "tugs"
    function = "add_tug"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that have one."""
        return set(structure.law("tug") or ())

    def damper_fields(self, structure: Structure) -> list[Field]:
        """The force, where any body has one."""
        return list(declared(Tug)) if self.bodies(structure) else []

    def damper_values(self, body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
        """The force; zero where the body has none."""
        law = body.law(Tug)
        return {"force": law.force if law else ZERO3} if damper.field("force") else {}

    def add_functions(self, lib: FunctionSet) -> None:
        """The force of one body."""

        @lib.kernel(equation="(7)")
        def add_tug(damper: Any = lib.damper, P: Reals = WRENCH) -> None:
            """Adds the force that goes with one body to its wrench, both in the body's own frame."""
            P[0:3] += damper.force


LAW = TugProgram()
