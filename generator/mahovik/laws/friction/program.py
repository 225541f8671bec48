"""The friction of freedoms in the program of a stand."""

from __future__ import annotations

from collections.abc import Mapping

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import WRENCH, CarrierProgram, Run, declared
from mahovik.core.program.kernel import Reals, Record, argument
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.program.vector import dot
from mahovik.core.stand.hold import wrench_columns
from mahovik.core.stand.model import Stand, Structure
from mahovik.laws.friction.law import Friction, frictions_of

DIRECTION = Field(
    "direction", Kind.REAL, (6,), "", "wrench of a force 1 along the freedom; its product with V is the speed", True
)
FRICTION = Struct("friction", "Friction of one freedom.", (DIRECTION, *declared(Friction)))
OF_BASIS = (units.JOULE_SECOND, units.ENERGY, units.ENERGY, units.RATE, units.RATE)
"""Units of the numbers along a freedom of a basis."""


class FrictionProgram(CarrierProgram):
    """Friction of all freedoms that have some."""

    words = "friction"
    placed = False

    def arrays(self, structure: Structure) -> list[tuple[Struct, int, str]]:
        """One struct per freedom with friction."""
        return [(FRICTION, structure.law("frictions"), "rub")] if structure.law("frictions") else []

    def values(self, stand: Stand, run: Run) -> dict[str, object]:
        """The numbers of the file, and the wrench along the freedom; without a rise any speed that is not zero."""
        assert stand.hold is not None
        along, rows = wrench_columns(stand.hold), []
        for friction in frictions_of(stand):
            row = {f.name: getattr(friction, f.name) for f in declared(Friction)} | {
                "direction": along[friction.freedom]
            }
            rows.append(row | ({"stribeck_speed": 1.0} if friction.stribeck_speed is None else {}))
        return {"friction": rows}

    def units(self, stand: Stand, struct: Struct, number: int) -> Mapping[str, units.Unit]:
        """Those of what the freedom does."""
        assert stand.hold is not None
        kind = stand.hold.freedoms[frictions_of(stand)[number].freedom].kind
        of_kind = OF_BASIS if kind == "twist" else [units.of(d.si) for d in Friction.dimensions[kind]]
        return dict(zip((f.name for f in declared(Friction)), of_kind, strict=True))

    def add_functions(self, lib: FunctionSet) -> None:
        """The friction of one freedom."""

        words = "viscous, Coulomb with a smoothed sign, and Stribeck's rise at low speed"

        @lib.kernel(equation="(7)", purpose=f"Adds the friction of one freedom: {words}.")
        def rub(
            law: Record = argument(struct=FRICTION), V: Reals = argument("twist of the carrier", 6), F: Reals = WRENCH
        ) -> None:
            """Adds the friction of one freedom."""
            speed = dot(V, law.direction)  # of the freedom
            square = speed * speed
            length = lib["sqrt"](square + law.smoothing * law.smoothing)
            sign = speed / length  # smoothed
            limit = law.stribeck_speed * law.stribeck_speed
            slow = limit / (limit + square)  # 1 at rest, 1/2 at the Stribeck speed
            drag = ((law.breakaway - law.coulomb) * slow + law.coulomb) * sign + speed * law.viscous
            for i in range(6):
                F[i] -= drag * law.direction[i]


LAW = FrictionProgram()
