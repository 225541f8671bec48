"""Fading damping in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import OWN_TWIST, WRENCH, BodyProgram
from mahovik.core.lower.units import Member, matrix
from mahovik.core.program.kernel import Reals, Record
from mahovik.core.program.types import Field, Kind, Struct, member
from mahovik.core.program.vector import dot
from mahovik.core.stand.fields import ZERO6
from mahovik.core.stand.model import Body, Structure
from mahovik.laws.fading.law import FadingDamping

LINEAR = Field("fading", Kind.REAL, (6, 6), "SI", "wrench -= exp(-fading_rate U) fading V, U = |v|")
RATE = Field("fading_rate", Kind.REAL, (), "s/m", "not negative")


class Fading(BodyProgram):
    """Matrix and rate of every body, in its damper."""

    words = "fading damping"
    function = "add_fading"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that have fading damping."""
        return set(structure.law("fading_damping") or ())

    def damper_fields(self, structure: Structure) -> list[Field]:
        """Matrix and rate, where any body has them."""
        return [LINEAR, RATE] if self.bodies(structure) else []

    def damper_values(self, body: Body, damper: Struct, rows: dict[str, list[dict[str, object]]]) -> dict[str, object]:
        """Matrix and rate; zeros where the body has no such damping."""
        if damper.field("fading") is None:
            return {}
        law = body.law(FadingDamping)
        return {"fading": law.linear if law else ZERO6, "fading_rate": law.rate if law else 0.0}

    def damper_members(self, name: str, damper: Struct, value: object) -> Iterator[Member]:
        """Matrix and rate."""
        if damper.field("fading") is None:
            return
        what = f"{name}: linear damping that fades, of its own twist relative to the fluid, in its own frame"
        rows = member(value, "fading")
        yield from matrix(f"{name}.fading_damping.linear", LINEAR, rows, lambda i, j: units.law(i, (j,)), what)
        text, rate = f"{name}: rate at which that damping falls with its speed", float(member(value, "fading_rate"))
        yield Member(f"{name}.fading_damping.rate", units.SECOND_PER_METRE, text, rate, positive=True)

    def add_functions(self, lib: FunctionSet) -> None:
        """The fading damping of one body, and the exponential that it needs."""
        lib.add_exponential()

        @lib.kernel(equation="(7)")
        def add_fading(damper: Record = lib.damper, V: Reals = OWN_TWIST, P: Reals = WRENCH) -> None:
            """Adds the fading damping of one body to its wrench, both in the body's own frame."""
            speed = lib["sqrt"](dot(V[0:3], V[0:3]))  # of the body through the fluid
            fade = lib["exp"](-(damper.fading_rate * speed))
            for i in range(6):
                P[i] -= fade * dot(V, damper.fading[i])


LAW = Fading()
