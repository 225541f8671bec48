"""Propellers in the program of a stand: those of all bodies, one after the other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import TwistFunction
from mahovik.core.lower.member import Member, member
from mahovik.core.lower.run_time_input import RunTimeInput
from mahovik.core.program.expression import Expr, Place, magnitude
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.stand.columns import hypot
from mahovik.core.stand.model import Body, Stand, Vec3
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.propeller.law import Propeller, Propellers

INT, REAL = Kind.INT, Kind.REAL


@dataclass(frozen=True)
class Screw:
    """Thrust and torque on the body as t0 |n| n + t1 |n| u + t2 |u| u of the speed n (rad/s) and the velocity u (m/s).

    axis    of length one
    thrust  t0 (N s2/rad2), t1 (N s2/(rad m)), t2 (N s2/m2)
    torque  likewise, about the axis, N m
    """

    axis: Vec3
    thrust: Vec3
    torque: Vec3


def screw_of(p: Propeller) -> Screw:
    """The propeller so."""
    force = p.density * p.diameter**4
    hand = 1.0 if p.left else -1.0
    thrust = _in_radians(p, p.thrust, (1.0 - p.deduction) * force)
    return Screw(_unit(p.axis), thrust, _in_radians(p, p.torque, hand * force * p.diameter))


def _in_radians(p: Propeller, k: Vec3, size: float) -> Vec3:
    advance = (1.0 - p.wake) / p.diameter
    return (
        size * k[0] / (math.tau * math.tau),
        size * k[1] * advance / math.tau,
        size * k[2] * abs(advance) * advance,
    )


def _unit(a: Vec3) -> Vec3:
    largest = max(abs(x) for x in a)  # first, so that squares neither overflow nor vanish
    x, y, z = (each / largest for each in a)
    length = hypot(x, y, z)
    return (x / length, y / length, z / length)


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "propellers" if damped_bodies(structure) else ""


def damped_bodies(structure: Structure) -> set[int]:
    """Indices of the bodies that have propellers."""
    return {index for index, _ in structure.law("propellers") or ()}


def propeller_count(structure: Structure) -> int:
    """Number of propellers of all bodies."""
    return sum(len(kinds) for _, kinds in structure.law("propellers") or ())


def run_time_input(structure: Structure) -> RunTimeInput | None:
    """The speeds; None without propellers."""
    names = tuple(name for _, kinds in structure.law("propellers") or () for name, _ in kinds)
    count = NamedCount("PROPELLERS", len(names), "propellers: those of the table, whose speeds are inputs")
    words = "speeds of propellers"
    return RunTimeInput("propeller", "speed", "MAX_SPEED", count, names, "PROPELLER_", words) if names else None


def _whole(structure: Structure) -> bool:
    """Whether any propeller meets the length of the velocity."""
    return any(whole for _, kinds in structure.law("propellers") or () for _, whole in kinds)


def propeller_struct(structure: Structure) -> Struct:
    """One propeller; `whole` only where any is so."""
    fields = [
        Field("speed", REAL, (), "rad/s", "n; may be set at run time, up to MAX_SPEED"),
        Field("position", REAL, (3,), "m", "in the body's frame, as the axis"),
        Field("axis", REAL, (3,), "", "direction of the thrust, of length one"),
        Field("thrust", REAL, (3,), "SI", "t0, t1, t2: thrust += t0 |n| n + t1 |n| u + t2 |u| u, u the velocity"),
        Field("torque", REAL, (3,), "SI", "likewise, on the body about the axis"),
    ]
    if _whole(structure):
        fields.append(Field("whole", INT, (), "", "1: u is the length of the velocity; 0: its part along the axis"))
    return Struct("propeller", "A propeller of which the speed is given.", tuple(fields))


def table_fields(structure: Structure) -> list[Field]:
    """The propellers of all bodies, where there are any."""
    given = run_time_input(structure)
    return [Field("propeller", propeller_struct(structure), (given.count,))] if given else []


def damper_fields(structure: Structure) -> list[Field]:
    """Members of the damper of a body: the range of its propellers."""
    if not propeller_count(structure):
        return []
    which = "propellers first_propeller .. last_propeller - 1 of the table"
    return [Field("first_propeller", INT, (), "", which), Field("last_propeller", INT)]


def damper_values(body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """The members of a damper; the propellers of the body are appended to `rows` of "propeller"."""
    if damper.field("first_propeller") is None:
        return {}
    found, law = rows.setdefault("propeller", []), body.law(Propellers)
    first = len(found)
    for p in law.propellers if law else ():
        screw = screw_of(p)
        row: dict[str, Any] = {"speed": p.speed, "position": list(p.position), "axis": list(screw.axis)}
        found.append(row | {"thrust": list(screw.thrust), "torque": list(screw.torque), "whole": int(p.whole)})
    return {"first_propeller": first, "last_propeller": len(found)}


def propeller_members(stand: Stand, rows: Any) -> Iterator[Member]:
    """Every real of the propellers, in the order in which the table has them, counted from 1."""
    own = [(body.name, p.name) for body in stand.bodies if (law := body.law(Propellers)) for p in law.propellers]
    for number, ((body, name), row) in enumerate(zip(own, rows, strict=True)):
        place, of = f"propeller[{number + 1}]", f"{body}: propeller {name}"
        yield Member(f"{place}.speed", units.ANGULAR_VELOCITY, f"{of}, speed", float(member(row, "speed")))
        for key, unit_of, what in (
            ("position", (units.METRE,) * 3, "place in the body's frame"),
            ("axis", (units.NONE,) * 3, "direction of its thrust"),
            ("thrust", _units(0), "thrust by |n| n, |n| u, |u| u"),
            ("torque", _units(3), "torque by |n| n, |n| u, |u| u"),
        ):
            for i, (unit, value) in enumerate(zip(unit_of, member(row, key), strict=True)):
                yield Member(f"{place}.{key}[{i + 1}]", unit, f"{of}, {what}; component {i + 1}", float(value))


def _units(row: int) -> tuple[units.Unit, ...]:
    """Units of a component of a wrench over the squares of a turn, turn and velocity, velocity."""
    return tuple(units.law(row, factors) for factors in ((3, 3), (0, 3), (0, 0)))


ARRAY_MEMBERS = {"propeller": propeller_members}
"""Reals of the arrays of the table, by name."""

BY_TWIST = "add_propellers"
"""The function that adds the wrench of a body by its own twist."""


def add_functions(lib: FunctionSet) -> None:
    """Thrust and torque of the propellers of one body, where any body has propellers."""
    if propeller_count(lib.layout.structure):
        lib.add(add_propellers(lib))


def add_propellers(lib: FunctionSet) -> Function:
    """Thrust and torque of the propellers of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body = adding.body
    with adding.each("propeller", propeller_count(lib.layout.structure)) as p:
        velocity, r, V = body.local("velocity", (3,), comment="of the propeller"), p.position, adding.V
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            body.set(velocity[i], V[i] + (V[3 + j] * r[k] - V[3 + k] * r[j]))
        u = body.local("u", comment="velocity that it meets")
        body.set(u, _dot(p.axis, velocity))
        if _whole(lib.layout.structure):
            with body.when(p.whole > 0):
                body.set(u, lib["sqrt"](_dot(velocity, velocity)))
        squares = (magnitude(p.speed) * p.speed, magnitude(p.speed) * u, magnitude(u) * u)
        thrust, torque = (
            body.let(name, of[0] * squares[0] + of[1] * squares[1] + of[2] * squares[2])
            for name, of in (("thrust", p.thrust), ("torque", p.torque))
        )
        force = body.local("force", (3,))
        for i in range(3):
            body.set(force[i], thrust * p.axis[i])
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            body.add(adding.P[i], force[i])
            body.add(adding.P[3 + i], torque * p.axis[i] + (r[j] * force[k] - r[k] * force[j]))
    return adding.function(
        "add_propellers",
        "Adds thrust and torque of the propellers of one body to its wrench, both in the body's own frame.",
    )


def _dot(a: Place, b: Place) -> Expr:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
