"""Fins in the program of a stand: those of all bodies, one after the other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import TwistFunction
from mahovik.core.lower.member import Member, members
from mahovik.core.lower.run_time_input import RunTimeInput
from mahovik.core.program.build import Body as Statements
from mahovik.core.program.expression import Expr, Place, and_, magnitude, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.fin.data import MOST_DEFLECTION, SPEEDS, Fins
from mahovik.laws.fin.strips import axes_of

INT, REAL = Kind.INT, Kind.REAL
RIGHT_ANGLE = math.pi / 2


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "fins" if damped_bodies(structure) else ""


def damped_bodies(structure: Structure) -> set[int]:
    """Indices of the bodies that have fins."""
    return {index for index, _ in structure.law("fins") or ()}


def fin_count(structure: Structure) -> int:
    """Number of fins of all bodies."""
    return len(_kinds(structure))


def run_time_input(structure: Structure) -> RunTimeInput | None:
    """The deflections; None without fins."""
    names = tuple(name for name, _, _ in _kinds(structure))
    count = NamedCount("FINS", len(names), "fins: those of the table, whose deflections are inputs")
    words = "deflections of fins"
    return RunTimeInput("fin", "deflection", MOST_DEFLECTION, count, names, "FIN_", words) if names else None


def _kinds(structure: Structure) -> list[tuple[str, bool, bool]]:
    """Name of each fin, whether the angle of the flow counts, whether it stalls."""
    return [kind for _, kinds in structure.law("fins") or () for kind in kinds]


def _feels_flow(structure: Structure) -> bool:
    return any(incidence for _, incidence, _ in _kinds(structure))


def _stalls(structure: Structure) -> bool:
    return any(stalls for _, _, stalls in _kinds(structure))


def fin_struct(stalls: bool, incidence: bool) -> Struct:
    """One fin; `stall` and `incidence` only where any fin has them."""
    fields = [
        Field("deflection", REAL, (), "rad", f"may be set at run time; at most {MOST_DEFLECTION:g}"),
        Field("position", REAL, (3,), "m", "in the body's frame, as the axes"),
        Field("chord", REAL, (3,), "", "axes of length one: forward"),
        Field("span", REAL, (3,), "", "to the side"),
        Field("normal", REAL, (3,), "", "chord x span; a positive deflection pushes against it"),
        Field("size", REAL, (), "kg/m", "density/2 times area"),
        Field("lift_slope", REAL, (), "1/rad", "C_L over the angle"),
        Field("drag", REAL, (), "", "C_D without lift"),
        Field("induced", REAL, (), "", "C_D over C_L^2"),
        Field("speed", INT, (), "", "squares in U^2 are of: 0 chord; 1 chord, normal; 2 all axes"),
    ]
    if stalls:
        fields.append(Field("stall", REAL, (), "rad", "angle beyond which lift falls; 0: it does not"))
    if incidence:
        fields.append(Field("incidence", INT, (), "", "1: the angle of the flow counts; 0: the deflection alone"))
    return Struct("fin", "A lifting surface.", tuple(fields))


def table_fields(structure: Structure) -> list[Field]:
    """The fins of all bodies, where there are any."""
    given = run_time_input(structure)
    return [Field("fin", fin_struct(_stalls(structure), _feels_flow(structure)), (given.count,))] if given else []


def damper_fields(structure: Structure) -> list[Field]:
    """Members of the damper of a body: the range of its fins."""
    if not fin_count(structure):
        return []
    return [Field("first_fin", INT, (), "", "fins first_fin .. last_fin - 1 of the table"), Field("last_fin", INT)]


def damper_values(body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """The members of a damper; the fins of the body are appended to `rows` of "fin"."""
    if damper.field("first_fin") is None:
        return {}
    fins, law = rows.setdefault("fin", []), body.law(Fins)
    first = len(fins)
    for fin in law.fins if law else ():
        chord, span, normal = axes_of(fin)
        row: dict[str, Any] = {key: getattr(fin, key) for key in ("deflection", "lift_slope", "drag", "induced")}
        row |= {"position": list(fin.position), "chord": list(chord), "span": list(span), "normal": list(normal)}
        row |= {"size": 0.5 * fin.density * fin.area, "speed": SPEEDS.index(fin.speed)}
        stall = 0.0 if fin.stall is None else fin.stall
        fins.append(row | {"stall": stall, "incidence": int(fin.incidence)})
    return {"first_fin": first, "last_fin": len(fins)}


def fin_members(stand: Stand, rows: Any) -> Iterator[Member]:
    """Every real of the fins, in the order in which the table has them, counted from 1."""
    fins = [fin for body in stand.bodies if (law := body.law(Fins)) for fin in law.fins]
    struct = fin_struct(any(fin.stall is not None for fin in fins), any(fin.incidence for fin in fins))
    for number, row in enumerate(rows):
        yield from members(f"fin[{number + 1}]", struct, row)


ARRAY_MEMBERS = {"fin": fin_members}
"""Reals of the arrays of the table, by name."""

BY_TWIST = ("add_fins", "add_fins_slope")
"""Functions that add the wrench of a body's own twist, and its change."""


def add_functions(lib: FunctionSet) -> None:
    """Lift and drag of the fins of one body, where any body has fins."""
    if fin_count(lib.layout.structure):
        lib.add(add_fins(lib))


def add_slopes(lib: FunctionSet) -> None:
    """The change of that wrench."""
    if fin_count(lib.layout.structure):
        lib.add(add_fins_slope(lib))


def add_fins(lib: FunctionSet) -> Function:
    """Lift and drag of the fins of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body = adding.body
    with adding.each("fin", fin_count(lib.layout.structure)) as fin:
        flow = _Flow(lib, body, fin, adding.V)
        lift = body.let("lift", flow.pressure * flow.C_L)
        drag = body.let("drag", flow.pressure * (fin.drag + fin.induced * flow.C_L * flow.C_L))
        along = body.let("along", lift * flow.up - drag * flow.along, "force along the chord")
        across = body.let("across", -(lift * flow.along + drag * flow.up), "force along the normal")
        _add(body, fin, along, across, adding.P)
    return adding.function(
        "add_fins", "Adds lift and drag of the fins of one body to its wrench, both in the body's own frame."
    )


def add_fins_slope(lib: FunctionSet) -> Function:
    """Derivative of that wrench by the body's twist, times a twist."""
    adding = TwistFunction(lib, slope=True)
    body = adding.body
    with adding.each("fin", fin_count(lib.layout.structure)) as fin:
        flow = _Flow(lib, body, fin, adding.V)
        flow.change(body, fin, adding.change)
        C_D = body.let("C_D", fin.drag + fin.induced * flow.C_L * flow.C_L)
        C_D_by = 2 * fin.induced * flow.C_L * flow.C_L_by
        lift, drag = body.let("lift", flow.pressure * flow.C_L), body.let("drag", flow.pressure * C_D)
        lift_by = body.let("lift_by", flow.pressure_by * flow.C_L + flow.pressure * flow.C_L_by, "change of the lift")
        drag_by = body.let("drag_by", flow.pressure_by * C_D + flow.pressure * C_D_by, "change of the drag")
        by_turn = (lift * flow.along + drag * flow.up) * flow.turn
        along = body.let("along", lift_by * flow.up - drag_by * flow.along + by_turn)
        by_turn = (lift * flow.up - drag * flow.along) * flow.turn
        across = body.let("across", by_turn - (lift_by * flow.along + drag_by * flow.up))
        _add(body, fin, along, across, adding.P)
    return adding.function("add_fins_slope", "Change of lift and drag of the fins of one body with its twist.")


class _Flow:
    """The flow at a fin, and the lift that it makes: places of a function's body.

    a, b, c    velocity relative to the fluid along chord, span, normal
    along, up  its direction in the plane of chord and normal; (1, 0) where the angle of the flow does not count
    pressure   force over C_L
    """

    def __init__(self, lib: FunctionSet, body: Statements, fin: Place, V: Place) -> None:
        structure = lib.layout.structure
        self._turning, self._falling = _feels_flow(structure), _stalls(structure)
        self.a, self.b, self.c = _velocity(body, fin, V, "")
        square = body.local("square", comment="U^2")
        body.set(square, self.a * self.a)
        with body.when(fin.speed > 0):
            body.add(square, self.c * self.c)
        with body.when(fin.speed > 1):
            body.add(square, self.b * self.b)
        self.pressure = body.let("pressure", fin.size * square)
        self.along: Expr = real(1)
        self.up: Expr = real(0)
        self.turn: Expr = real(0)
        angle: Place = body.local("angle", comment="of the lift")
        body.set(angle, fin.deflection)
        if self._turning:
            self.plane = body.let("plane", self.a * self.a + self.c * self.c)
            along, up = body.local("ahead", comment="direction of the flow"), body.local("up")
            body.set(along, real(1))
            body.set(up, real(0))
            with body.when(and_(fin.incidence > 0, self.plane > 0)):
                speed = body.let("speed", lib["sqrt"](self.plane))
                body.set(along, self.a / speed)
                body.set(up, self.c / speed)
                body.add(angle, lib["atan2"](self.c, self.a))
            self.along, self.up = along, up
        size = body.local("size", comment="of the angle that lifts")
        body.set(size, magnitude(angle))
        self.slope: Expr = fin.lift_slope
        if self._falling:
            slope = body.local("slope", comment="C_L over the angle, here")
            body.set(slope, fin.lift_slope)
            with body.when(and_(fin.stall > 0, size > fin.stall)):
                fade = body.let("fade", fin.stall / (RIGHT_ANGLE - fin.stall))
                body.set(slope, select(size < RIGHT_ANGLE, -(fin.lift_slope * fade), real(0)))
                body.set(size, select(size < RIGHT_ANGLE, fade * (RIGHT_ANGLE - size), real(0)))
            self.slope = slope
        self.C_L = body.let("C_L", fin.lift_slope * select(angle < 0, -size, size))

    def change(self, body: Statements, fin: Place, change: Place) -> None:
        """Changes of the flow with a change of the twist: `turn` of its angle, `pressure_by`, `C_L_by`."""
        da, db, dc = _velocity(body, fin, change, "_by")
        square = body.local("square_by", comment="change of U^2")
        body.set(square, 2 * self.a * da)
        with body.when(fin.speed > 0):
            body.add(square, 2 * self.c * dc)
        with body.when(fin.speed > 1):
            body.add(square, 2 * self.b * db)
        self.pressure_by = body.let("pressure_by", fin.size * square)
        if self._turning:
            turn = body.local("turn", comment="change of the angle of the flow")
            body.set(turn, real(0))
            with body.when(and_(fin.incidence > 0, self.plane > 0)):
                body.set(turn, (self.a * dc - self.c * da) / self.plane)
            self.turn = turn
        self.C_L_by = body.let("C_L_by", self.slope * self.turn)


def _velocity(body: Statements, fin: Place, V: Place, end: str) -> tuple[Place, ...]:
    """(v + omega x position) along chord, span, normal."""
    r = fin.position
    at = body.local(f"velocity{end}", (3,), comment="of the fin")
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        body.set(at[i], V[i] + (V[3 + j] * r[k] - V[3 + k] * r[j]))
    axes = (("a", fin.chord), ("b", fin.span), ("c", fin.normal))
    return tuple(body.let(n + end, x[0] * at[0] + x[1] * at[1] + x[2] * at[2]) for n, x in axes)


def _add(body: Statements, fin: Place, along: Expr, across: Expr, P: Place) -> None:
    """The force along chord and normal, at the fin's place."""
    force, r = body.local("force", (3,)), fin.position
    for i in range(3):
        body.set(force[i], along * fin.chord[i] + across * fin.normal[i])
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        body.add(P[i], force[i])
        body.add(P[3 + i], r[j] * force[k] - r[k] * force[j])
