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
from mahovik.core.stand.columns import hypot
from mahovik.core.stand.model import Body, Stand, Vec3
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.fin.law import MOST_DEFLECTION, SPEEDS, Fin, Fins

INT, REAL = Kind.INT, Kind.REAL
RIGHT_ANGLE = math.pi / 2


def axes_of(fin: Fin) -> tuple[Vec3, Vec3, Vec3]:
    """Chord, span and normal of length one, at right angles, in the body's frame."""
    chord = _unit(fin.chord)
    normal = _unit(_cross(chord, _unit(fin.span)))
    return chord, _cross(normal, chord), normal


def _cross(a: Vec3, b: Vec3) -> Vec3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _unit(a: Vec3) -> Vec3:
    largest = max(abs(x) for x in a)  # first, so that squares neither overflow nor vanish
    x, y, z = (each / largest for each in a)
    length = hypot(x, y, z)
    return (x / length, y / length, z / length)


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

BY_TWIST = "add_fins"
"""The function that adds the wrench of a body by its own twist."""


def add_functions(lib: FunctionSet) -> None:
    """Lift and drag of the fins of one body, where any body has fins."""
    if fin_count(lib.layout.structure):
        lib.add(add_fins(lib))


def add_fins(lib: FunctionSet) -> Function:
    """Lift and drag of the fins of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body = adding.body
    with adding.each("fin", fin_count(lib.layout.structure)) as fin:
        chord, span, normal, r, V = fin.chord, fin.span, fin.normal, fin.position, adding.V
        velocity = body.local("velocity", (3,), comment="of the fin")
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            body.set(velocity[i], V[i] + (V[3 + j] * r[k] - V[3 + k] * r[j]))
        a, b, c = (
            body.let(name, x[0] * velocity[0] + x[1] * velocity[1] + x[2] * velocity[2])
            for name, x in (("a", chord), ("b", span), ("c", normal))
        )
        square = body.local("square", comment="U^2")
        body.set(square, a * a)
        with body.when(fin.speed > 0):
            body.add(square, c * c)
        with body.when(fin.speed > 1):
            body.add(square, b * b)
        pressure = body.let("pressure", fin.size * square)
        C_L, ahead, up = _lift(lib, body, fin, a, c)
        lift = body.let("lift", pressure * C_L)
        drag = body.let("drag", pressure * (fin.drag + fin.induced * C_L * C_L))
        along = body.let("along", lift * up - drag * ahead, "force along the chord")
        across = body.let("across", -(lift * ahead + drag * up), "force along the normal")
        force = body.local("force", (3,))
        for i in range(3):
            body.set(force[i], along * chord[i] + across * normal[i])
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            body.add(adding.P[i], force[i])
            body.add(adding.P[3 + i], r[j] * force[k] - r[k] * force[j])
    return adding.function(
        "add_fins", "Adds lift and drag of the fins of one body to its wrench, both in the body's own frame."
    )


def _lift(lib: FunctionSet, body: Statements, fin: Place, a: Place, c: Place) -> tuple[Expr, Expr, Expr]:
    """C_L, and the direction of the flow in the plane of chord and normal, along which it moves by a and c.

    The direction is (1, 0) where the angle of the flow does not count.
    """
    structure = lib.layout.structure
    ahead: Expr = real(1)
    up: Expr = real(0)
    angle = body.local("angle", comment="of the lift")
    body.set(angle, fin.deflection)
    if _feels_flow(structure):
        plane = body.let("plane", a * a + c * c)
        ahead, up = body.local("ahead", comment="direction of the flow"), body.local("up")
        body.set(ahead, real(1))
        body.set(up, real(0))
        with body.when(and_(fin.incidence > 0, plane > 0)):
            speed = body.let("speed", lib["sqrt"](plane))
            body.set(ahead, a / speed)
            body.set(up, c / speed)
            body.add(angle, lib["atan2"](c, a))
    size = body.local("size", comment="of the angle that lifts")
    body.set(size, magnitude(angle))
    if _stalls(structure):
        with body.when(and_(fin.stall > 0, size > fin.stall)):
            fade = body.let("fade", fin.stall / (RIGHT_ANGLE - fin.stall))
            body.set(size, select(size < RIGHT_ANGLE, fade * (RIGHT_ANGLE - size), real(0)))
    return body.let("C_L", fin.lift_slope * select(angle < 0, -size, size)), ahead, up
