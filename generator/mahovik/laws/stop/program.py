"""The stops of freedoms in the program of a stand."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import ATTITUDE, WRENCH, CarrierProgram, Run, declared
from mahovik.core.program.kernel import Reals, Record, argument, inline
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.program.vector import dot
from mahovik.core.stand.hold import wrench_columns
from mahovik.core.stand.model import Hold, Stand, Structure
from mahovik.laws.stop.law import Stop, stops_of

REAL = Kind.REAL


def _struct(kind: str, words: str, axis: str, *home: Field) -> Struct:
    """A stop of one kind of freedom."""
    direction = "wrench of a force 1 along the freedom; its product with V is the speed"
    at, stiffness, damping = declared(Stop)
    fields = (
        Field("direction", REAL, (6,), "", direction, of_hold=True),
        Field("axis", REAL, (3,), "", axis, of_hold=True),
        *home,
        at,
        Field("side", REAL, (), "", "1: stops what goes above, -1: what goes below", of_hold=True),
        stiffness,
        damping,
    )
    return Struct(f"{kind}_stop", words, fields)


TURN_STOP = _struct(
    "turn", "A stop of what turns.", "of the freedom, in E1, of length 1",
    Field("C0", REAL, (9,), "", "attitude of the home pose, row by row", of_hold=True),
)  # fmt: skip
SLIDE_STOP = _struct(
    "slide", "A stop of what slides.", "direction of the freedom in the home pose, in E0, of length 1",
    Field("home", REAL, (3,), "m", "place of the pivot in the home pose, in E0", of_hold=True),
)  # fmt: skip


@inline
def push(law: Record, V: Reals, coordinate: float, F: Reals) -> None:
    """F -= side depth (stiffness + damping side speed) W, where both factors are positive: a stop never pulls."""
    depth = (coordinate - law.at) * law.side  # beyond the stop
    if depth > 0:
        speed = dot(V, law.direction)  # of the freedom
        push = law.damping * law.side * speed + law.stiffness  # per depth
        if push > 0:  # a stop does not pull
            force = law.side * (depth * push)
            for i in range(6):
                F[i] -= force * law.direction[i]


class StopsProgram(CarrierProgram):
    """All stops: those of what slides, then those of what turns."""

    words = "stops"

    def arrays(self, structure: Structure) -> list[tuple[Struct, int, str]]:
        """One struct per stop."""
        kinds = ((SLIDE_STOP, "slide_stops", "stop_slide"), (TURN_STOP, "turn_stops", "stop_turn"))
        return [(struct, count, name) for struct, key, name in kinds if (count := structure.law(key))]

    def values(self, stand: Stand, run: Run) -> dict[str, list[dict[str, object]]]:
        """The numbers of the file, the wrench along the freedom, and its home pose."""
        hold = stand.hold
        assert hold is not None
        attitude = run("quaternion", {"angles": hold.angles})[1]["attitude"]
        C0, along = run("rotation", {"q": attitude})[1]["C"], wrench_columns(hold)
        rows: dict[str, list[dict[str, object]]] = {}
        for stop in stops_of(stand):
            kind = hold.freedoms[stop.freedom].kind
            rows.setdefault(f"{kind}_stop", []).append(_row(stop, hold, kind, along[stop.freedom], C0))
        return rows

    def units(self, stand: Stand, struct: Struct, number: int) -> Mapping[str, units.Unit]:
        """Those of what slides or turns."""
        kind: Literal["slide", "turn"] = "slide" if struct is SLIDE_STOP else "turn"
        of_kind = (units.of(d.si) for d in Stop.dimensions[kind])
        return dict(zip((f.name for f in declared(Stop)), of_kind, strict=True))

    def add_functions(self, lib: FunctionSet) -> None:
        """The push of one stop."""
        structure = lib.layout.structure
        if structure.law("slide_stops"):

            @lib.kernel(equation="(7)")
            def stop_slide(
                law: Record = argument(struct=SLIDE_STOP), table: Record = lib.table, x: Record = lib.x,
                C: Reals = ATTITUDE, F: Reals = WRENCH,
            ) -> None:  # fmt: skip
                """Adds the push of a stop of what slides."""
                coordinate = dot(C @ table.pivot + x.position - law.home, law.axis)
                push(law, x.V, coordinate, F)

        if structure.law("turn_stops"):

            @lib.kernel(equation="(7)")
            def stop_turn(
                law: Record = argument(struct=TURN_STOP), x: Record = lib.x, C: Reals = ATTITUDE, F: Reals = WRENCH
            ) -> None:
                """Adds the push of a stop of what turns."""
                R: Reals = (law.C0.T @ C.square).flat  # attitude from the home pose, row by row
                a = law.axis
                sine = (
                    R[2] * a[1] + R[3] * a[2] + R[7] * a[0] - R[1] * a[2] - R[5] * a[0] - R[6] * a[1]
                )  # times a factor that the cosine has too
                cosine = (
                    R[0] + R[4] + R[8] - (R[0] * a[0] + R[3] * a[1] + R[6] * a[2]) * a[0]
                    - (R[1] * a[0] + R[4] * a[1] + R[7] * a[2]) * a[1]
                    - (R[2] * a[0] + R[5] * a[1] + R[8] * a[2]) * a[2]
                )  # fmt: skip
                coordinate = lib["atan2"](sine, cosine)  # angle from the home pose
                push(law, x.V, coordinate, F)


LAW = StopsProgram()


def _row(stop: Stop, hold: Hold, kind: str, direction: list[float], C0: list[float]) -> dict[str, object]:
    """Numbers of one stop; the moment of what turns is its axis."""
    row = {"direction": direction, "at": stop.at, "side": 1.0 if stop.above else -1.0}
    row |= {"stiffness": stop.stiffness, "damping": stop.damping}
    if kind == "turn":
        return row | {"axis": direction[3:], "C0": list(C0)}
    home = [place + arm for place, arm in zip(hold.position, _rotate(C0, list(hold.pivot)), strict=True)]
    return row | {"axis": _rotate(C0, direction[:3]), "home": home}


def _rotate(C: list[float], a: list[float]) -> list[float]:
    """C a, in a fixed order of summation."""
    return [C[3 * i] * a[0] + C[3 * i + 1] * a[1] + C[3 * i + 2] * a[2] for i in range(3)]
