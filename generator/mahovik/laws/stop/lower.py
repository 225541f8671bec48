"""The stops of freedoms in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from mahovik.core.formula.derived import FormulaModule
from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import LawLowering
from mahovik.core.lower.member import Member, members
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.hold import wrench_columns
from mahovik.core.stand.model import Hold, Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.stop.law import Stop as Row
from mahovik.laws.stop.law import stops_of

if TYPE_CHECKING:
    from mahovik.laws.stop import derive as formulas
else:
    formulas = FormulaModule("laws.stop.derive")

REAL = Kind.REAL
_ALONG = "wrench of a force 1 along the freedom; its product with V is the speed"
_DIRECTION = Field("direction", REAL, (6,), "", _ALONG, of_hold=True)
_PUSH = (
    Field("at", REAL, (), "SI", "coordinate at which the stop begins"),
    Field("side", REAL, (), "", "1: stops what goes above, -1: what goes below", of_hold=True),
    Field("stiffness", REAL, (), "SI", "force per depth"),
    Field("damping", REAL, (), "SI", "force per depth and speed"),
)
TURN_STOP = Struct(
    "turn_stop",
    "A stop of what turns.",
    (
        _DIRECTION,
        Field("axis", REAL, (3,), "", "of the freedom, in E1, of length 1", of_hold=True),
        Field("C0", REAL, (9,), "", "attitude of the home pose, row by row", of_hold=True),
        *_PUSH,
    ),
)
SLIDE_STOP = Struct(
    "slide_stop",
    "A stop of what slides.",
    (
        _DIRECTION,
        Field("axis", REAL, (3,), "", "direction of the freedom in the home pose, in E0, of length 1", of_hold=True),
        Field("home", REAL, (3,), "m", "place of the pivot in the home pose, in E0", of_hold=True),
        *_PUSH,
    ),
)

_UNITS = {
    "slide_stop": {"at": units.METRE, "stiffness": units.STIFFNESS, "damping": units.DEPTH_DAMPING},
    "turn_stop": {
        "at": units.RADIAN,
        "stiffness": units.ROTARY_STIFFNESS,
        "damping": units.ROTARY_DEPTH_DAMPING,
    },
}
"""Units of numbers of a stop that are those of its freedom, by the name of the struct."""


class Stops(LawLowering):
    """All stops: those of what slides, then those of what turns."""

    words = "stops"

    def present(self, structure: Structure) -> bool:
        """Whether there is any."""
        return bool(structure.law("slide_stops") or structure.law("turn_stops"))

    def fields(self, structure: Structure) -> list[Field]:
        """One struct per stop."""
        given = (("slide_stops", SLIDE_STOP), ("turn_stops", TURN_STOP))
        return [Field(each.name, each, (count,)) for key, each in given if (count := structure.law(key))]

    def values(self, stand: Stand, run: Any) -> dict[str, Any]:
        """The numbers of the file, the wrench along the freedom, and its home pose."""
        hold = stand.hold
        assert hold is not None
        attitude = run("quaternion", {"angles": hold.angles})[1]["attitude"]
        C0 = run("rotation", {"q": attitude})[1]["C"]
        along = wrench_columns(hold)
        rows: dict[str, list[dict[str, Any]]] = {}
        for stop in stops_of(stand):
            kind = hold.freedoms[stop.freedom].kind
            rows.setdefault(f"{kind}_stop", []).append(_row(stop, hold, kind, along[stop.freedom], C0))
        return rows

    def members(self, stand: Stand, field: Field, value: Any) -> Iterator[Member]:
        """Stop by stop, counted from 1."""
        assert isinstance(field.type, Struct)
        for k, stop in enumerate(value):
            yield from members(f"{field.name}[{k + 1}]", field.type, stop, _UNITS[field.name])

    def add_functions(self, lib: FunctionSet) -> None:
        """The push of one stop."""
        structure = lib.layout.structure
        if structure.law("slide_stops"):
            lib.add(stop_slide(lib))
        if structure.law("turn_stops"):
            lib.add(stop_turn(lib))

    def act(self, lib: FunctionSet, body: Body, table: Place, x: Place, C: Place, F: Place) -> None:
        """Adds the push of every stop."""
        named = {"table": table, "x": x, "C": C, "F": F}
        for kind in ("slide", "turn"):
            if count := lib.layout.structure.law(f"{kind}_stops"):
                with body.loop("k", count) as k:
                    law = table.member(f"{kind}_stop")[k]
                    body.call(lib[f"stop_{kind}"], *lib.arguments_of(f"stop_{kind}", law=law, **named))


LOWERING = Stops()


def _row(stop: Row, hold: Hold, kind: str, direction: list[Any], C0: list[Any]) -> dict[str, Any]:
    """Numbers of one stop."""
    own = {"direction": direction, "at": stop.at, "side": 1.0 if stop.above else -1.0}
    own |= {"stiffness": stop.stiffness, "damping": stop.damping}
    if kind == "turn":
        # the moment of the freedom is its axis
        return own | {"axis": direction[3:], "C0": list(C0)}
    axis = _rotate(C0, direction[:3])
    home = [place + arm for place, arm in zip(hold.position, _rotate(C0, list(hold.pivot)), strict=True)]
    return own | {"axis": axis, "home": home}


def _rotate(C: list[Any], a: list[Any]) -> list[Any]:
    """C a, in a fixed order of summation."""
    return [C[3 * i] * a[0] + C[3 * i + 1] * a[1] + C[3 * i + 2] * a[2] for i in range(3)]


class _StopFunction:
    """A function that adds the push of a stop to F."""

    def __init__(self, lib: FunctionSet, struct: Struct) -> None:
        law, table, x = Argument("law", struct), lib.table_argument(), lib.state_argument()
        C = Argument("C", REAL, (9,), purpose="attitude of the carrier")
        F = Argument("F", REAL, (6,), "inout", "N, N m", "wrench; this law is added to it")
        self._arguments = (law, table, x, C, F)
        self.law, self.table, self.x, self.C, self.F = (a.place for a in self._arguments)
        self.body = Body()

    def finish(self, name: str, what: str, coordinate: Expr) -> Function:
        """F -= side depth (stiffness + damping side speed) W, where both factors are positive: a stop never pulls."""
        body, law, F = self.body, self.law, self.F
        found = formulas.stop()
        bound = {name: getattr(law, name) for name in ("at", "side", "stiffness", "damping")}
        depth = body.let("depth", translate(found.depth, bound | {"coordinate": coordinate}), "beyond the stop")
        moved = {"direction": law.direction, "V": self.x.V}
        with body.when(depth > 0):
            speed = body.let("speed", translate(found.speed, moved), "of the freedom")
            push = body.let("push", translate(found.push, bound | {"speed": speed}), "per depth")
            with body.when(push > 0, comment="a stop does not pull"):
                force = body.let("force", law.side * (depth * push))
                with body.loop("i", 6) as i:
                    body.add(F[i], -(force * law.direction[i]))
        return body.function(name, f"Adds the push of {what}.", self._arguments, equation="(7)")


def stop_slide(lib: FunctionSet) -> Function:
    """Push of a stop of what slides, added to F."""
    adding = _StopFunction(lib, SLIDE_STOP)
    law, body = adding.law, adding.body
    bound = {"axis": law.axis, "home": law.home, "O1": adding.x.position, "C": adding.C, "pivot": adding.table.pivot}
    coordinate = body.let("coordinate", translate(formulas.way(), bound))
    return adding.finish("stop_slide", "a stop of what slides", coordinate)


def stop_turn(lib: FunctionSet) -> Function:
    """Push of a stop of what turns, added to F."""
    adding = _StopFunction(lib, TURN_STOP)
    law, body = adding.law, adding.body
    R = body.local("R", (9,), comment="attitude from the home pose, row by row")
    assign(body, list(R), formulas.relative(), {"C0": law.C0, "C": adding.C})
    sine, cosine = formulas.sine_and_cosine()
    bound = {"axis": law.axis, "R": R}
    s = body.let("sine", translate(sine, bound), "times a factor that the cosine has too")
    c = body.let("cosine", translate(cosine, bound))
    coordinate = body.let("coordinate", lib["atan2"](s, c), "angle from the home pose")
    return adding.finish("stop_turn", "a stop of what turns", coordinate)
