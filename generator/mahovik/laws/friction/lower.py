"""The friction of freedoms in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.derived import FormulaModule
from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import LawLowering
from mahovik.core.lower.member import Member, members
from mahovik.core.lower.symbolic import translate
from mahovik.core.lower.units import Unit
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.hold import wrench_columns
from mahovik.core.stand.model import FreedomKind, Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.friction.law import Friction as Row
from mahovik.laws.friction.law import frictions_of

if TYPE_CHECKING:
    from mahovik.laws.friction import derive as formulas
else:
    formulas = FormulaModule("laws.friction.derive")

REAL = Kind.REAL
_ALONG = "wrench of a force 1 along the freedom; its product with V is the speed"
FRICTION = Struct(
    "friction",
    "Friction of one freedom.",
    (
        Field("direction", REAL, (6,), "", _ALONG, of_hold=True),
        Field("viscous", REAL, (), "SI", "force per speed"),
        Field("coulomb", REAL, (), "SI", "force at high speed"),
        Field("breakaway", REAL, (), "SI", "force at low speed"),
        Field("stribeck_speed", REAL, (), "SI", "speed at which half of the rise is left; not zero"),
        Field("smoothing", REAL, (), "SI", "speed at which the smoothed sign is 1/sqrt(2); not zero"),
    ),
)

_KEYS = ("viscous", "coulomb", "breakaway", "stribeck_speed", "smoothing")
_UNITS: dict[FreedomKind, tuple[Unit, ...]] = {
    "slide": (units.DAMPING, units.FORCE, units.FORCE, units.VELOCITY, units.VELOCITY),
    "turn": (units.ROTARY_DAMPING, units.TORQUE, units.TORQUE, units.ANGULAR_VELOCITY, units.ANGULAR_VELOCITY),
    "twist": (units.JOULE_SECOND, units.ENERGY, units.ENERGY, units.RATE, units.RATE),
}
"""Units of _KEYS by what the freedom does."""

_LAW = Argument("law", FRICTION)
_TWIST = Argument("V", REAL, (6,), purpose="twist of the carrier")


class Friction(LawLowering):
    """Friction of all freedoms that have some."""

    words = "friction"
    placed = False

    def present(self, structure: Structure) -> bool:
        """Whether any freedom has some."""
        return bool(structure.law("frictions"))

    def fields(self, structure: Structure) -> list[Field]:
        """One struct per freedom with friction."""
        return [Field("friction", FRICTION, (structure.law("frictions"),))]

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """The numbers of the file, and the wrench along the freedom."""
        assert stand.hold is not None
        along = wrench_columns(stand.hold)
        return {"friction": [_row(friction, along[friction.freedom]) for friction in frictions_of(stand)]}

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """Freedom by freedom, counted from 1."""
        assert stand.hold is not None
        for k, (friction, row) in enumerate(zip(value, frictions_of(stand), strict=True)):
            kind = stand.hold.freedoms[row.freedom].kind
            own = dict(zip(_KEYS, _UNITS[kind], strict=True))
            yield from members(f"friction[{k + 1}]", FRICTION, friction, own)

    def add_functions(self, lib: FunctionSet) -> None:
        """The friction of one freedom."""
        lib.add(rub(lib))

    def act(self, lib: FunctionSet, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds the friction of every freedom."""
        with body.loop("k", lib.layout.structure.law("frictions")) as k:
            body.call(lib["rub"], table.friction[k], x.V, F)


LOWERING = Friction()


def _row(friction: Row, direction: list[Any]) -> dict[str, Any]:
    numbers = {name: getattr(friction, name) for name in ("viscous", "coulomb", "breakaway", "smoothing")}
    stribeck = 1.0 if friction.stribeck_speed is None else friction.stribeck_speed
    return {"direction": direction, **numbers, "stribeck_speed": stribeck}


def rub(lib: FunctionSet) -> Function:
    """Friction of one freedom, added to F."""
    law, V = _LAW, _TWIST
    F = Argument("F", REAL, (6,), "inout", "N, N m", "wrench; this law is added to it")
    own, body = law.place, Body()
    moved = {"direction": own.direction, "V": V.place}
    speed = body.let("speed", translate(formulas.friction().speed, moved), "of the freedom")
    square = body.let("square", speed * speed)
    length = body.let("length", lib["sqrt"](square + own.smoothing * own.smoothing))
    sign = body.let("sign", speed / length, "smoothed")
    limit = body.let("limit", own.stribeck_speed * own.stribeck_speed)
    slow = body.let("slow", limit / (limit + square), "1 at rest, 1/2 at the Stribeck speed")
    bound = {name: getattr(own, name) for name in ("viscous", "coulomb", "breakaway")}
    bound |= {"speed": speed, "sign": sign, "slow": slow}
    drag = body.let("drag", translate(formulas.friction().drag, bound))
    with body.loop("i", 6) as i:
        body.add(F.place[i], -(drag * own.direction[i]))
    return body.function(
        "rub",
        "Adds the friction of one freedom: viscous, Coulomb with a smoothed sign, and Stribeck's rise at low speed.",
        (law, V, F),
        equation="(7)",
    )
