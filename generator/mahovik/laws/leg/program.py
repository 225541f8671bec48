"""The legs in the program of a stand."""

from __future__ import annotations

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import ATTITUDE, WRENCH, CarrierProgram, Run, declared
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import OK, RANGE, Reals, Record, argument, reals
from mahovik.core.program.types import Struct
from mahovik.core.program.vector import cross, dot
from mahovik.core.stand.model import Stand, Structure
from mahovik.laws.leg.law import Leg, legs_of

LEG = Struct("leg", "A spring-damper between a point of E0 and one of E1.", declared(Leg))


class LegsProgram(CarrierProgram):
    """All legs, one after the other."""

    words = "legs"
    invalid = "leg of no length"
    refuses = True

    def arrays(self, structure: Structure) -> list[tuple[Struct, int, str]]:
        """One struct per leg."""
        return [(LEG, structure.law("legs"), "add_leg")] if structure.law("legs") else []

    def values(self, stand: Stand, run: Run) -> dict[str, object]:
        """Every leg as the file gives it."""
        return {"leg": [{f.name: getattr(leg, f.name) for f in LEG.fields} for leg in legs_of(stand)]}

    def add_functions(self, lib: FunctionSet) -> None:
        """The force of one leg."""
        least = lib.thresholds.zero_length

        @lib.kernel(equation="(7)", statuses=("OK", "RANGE"))
        def add_leg(
            leg: Record = argument(struct=LEG), x: Record = lib.x, C: Reals = ATTITUDE, F: Reals = WRENCH
        ) -> Status:
            """Adds the wrench of one leg; RANGE if its ends meet, since it then has no direction."""
            span = reals(3)
            span1 = reals(3)  # in E1, from O1
            reach = reals(3)  # from the carrier's end to the ground's, in E1
            direction = reals(3)
            velocity = reals(3)  # velocity of the carrier's end, in E1
            force = reals(3)
            span[:] = leg.ground - x.position
            lib["rotate_back"](C, span, span1)
            reach[:] = span1 - leg.carrier
            distance = lib["sqrt"](dot(reach, reach))
            if distance < least:  # the leg has no direction
                return RANGE
            inverse = 1 / distance
            direction[:] = reach * inverse
            velocity[:] = -cross(leg.carrier, x.V[3:6]) + x.V[0:3]
            rate = (
                -direction[0] * velocity[0] - direction[1] * velocity[1] - direction[2] * velocity[2]
            )  # rate of its length
            tension = leg.damping * rate + (distance - leg.length) * leg.stiffness
            force[:] = tension * direction
            F[0:3] += force
            F[3:6] += cross(leg.carrier, force)
            return OK


LAW = LegsProgram()
