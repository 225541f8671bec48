"""The legs in the program of a stand: one function per leg."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.derived import FormulaModule
from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import LawLowering
from mahovik.core.lower.laws import add_force
from mahovik.core.lower.member import Member, members
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place, Status
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.leg.law import legs_of

REAL = Kind.REAL
LEG = Struct(
    "leg",
    "A spring-damper between a point of E0 and one of E1.",
    (
        Field("ground", REAL, (3,), "m", "end in E0"),
        Field("carrier", REAL, (3,), "m", "end in E1"),
        Field("length", REAL, (), "m", "unstretched"),
        Field("stiffness", REAL, (), "N/m", ""),
        Field("damping", REAL, (), "N s/m", "along the leg"),
    ),
)

if TYPE_CHECKING:
    from mahovik.laws.leg import derive as formulas
else:
    formulas = FormulaModule("laws.leg.derive")


class Legs(LawLowering):
    """All legs, one after the other."""

    words = "legs"
    invalid = "leg of no length"
    refuses = True

    def present(self, structure: Structure) -> bool:
        """Whether there is any."""
        return bool(structure.law("legs"))

    def fields(self, structure: Structure) -> list[Field]:
        """One struct per leg."""
        return [Field("leg", LEG, (structure.law("legs"),))]

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """Every leg as the file gives it."""
        return {"leg": [{f.name: getattr(leg, f.name) for f in LEG.fields} for leg in legs_of(stand)]}

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """Leg by leg, counted from 1."""
        for k, leg in enumerate(value):
            yield from members(f"leg[{k + 1}]", LEG, leg)

    def add_functions(self, lib: FunctionSet) -> None:
        """The force of one leg."""
        lib.add(add_leg(lib))

    def act(self, lib: FunctionSet, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds the force of every leg."""
        with body.loop("k", lib.layout.structure.law("legs")) as k:
            lib.check(body, "add_leg", table.leg[k], x, C, F)


LOWERING = Legs()


def add_leg(lib: FunctionSet) -> Function:
    """Force of one leg, added to F."""
    law = Argument("leg", LEG)
    x = lib.state_argument()
    C = Argument("C", Kind.REAL, (9,), purpose="attitude of the carrier")
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "wrench; this law is added to it")
    body = Body()
    point = law.place.carrier
    span = body.local("span", (3,))
    span1 = body.local("span1", (3,), comment="in E1, from O1")
    reach = body.local("reach", (3,), comment="from the carrier's end to the ground's, in E1")
    direction = body.local("direction", (3,))
    velocity = body.local("velocity", (3,), comment="velocity of the carrier's end, in E1")
    force = body.local("force", (3,))
    for i in range(3):
        body.set(span[i], law.place.ground[i] - x.place.position[i])
    body.call(lib["rotate_back"], C.place, span, span1)
    for i in range(3):
        body.set(reach[i], span1[i] - point[i])
    square = reach[0] * reach[0] + reach[1] * reach[1] + reach[2] * reach[2]
    distance = body.let("distance", lib["sqrt"](square))
    with body.when(distance < lib.thresholds.zero_length, comment="the leg has no direction"):
        body.ret(Status("RANGE"))
    inverse = body.let("inverse", 1 / distance)
    for i in range(3):
        body.set(direction[i], reach[i] * inverse)
    six = list(x.place.V)
    assign(body, list(velocity), derived.twist_at(), {"v": six[:3], "omega": six[3:], "O": point})
    of_leg = formulas.leg()
    rate = body.let(
        "rate", translate(of_leg.rate, {"direction": direction, "velocity": velocity}), "rate of its length"
    )
    bound = {
        "stiffness": law.place.stiffness,
        "damping": law.place.damping,
        "distance": distance,
        "length": law.place.length,
        "rate": rate,
    }
    tension = body.let("tension", translate(of_leg.tension, bound))
    for i in range(3):
        body.set(force[i], tension * direction[i])
    add_force(body, list(F.place), point, list(force), None)
    return body.checked_function(
        "add_leg",
        "Adds the wrench of one leg; RANGE if its ends meet, since it then has no direction.",
        (law, x, C, F),
        equation="(7)",
        statuses=("OK", "RANGE"),
    )
