"""Cross-flow drag in the program of a stand: the strips of all bodies, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import TwistFunction
from mahovik.core.lower.member import Member, member
from mahovik.core.program.expression import magnitude, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Body, Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.cross_flow.law import CrossFlow

INT, REAL = Kind.INT, Kind.REAL


@dataclass(frozen=True)
class Strip:
    """A strip at x (m): force over the square of its velocity along y and along z (N s2/m2)."""

    x: float
    y: float
    z: float


def strips_of(law: CrossFlow) -> tuple[Strip, ...]:
    """The strips of a body, from the first station on."""
    nodes, weights = np.polynomial.legendre.leggauss(law.points)
    found = []
    for k, (a, b) in enumerate(pairwise(law.x)):
        half = 0.5 * (b - a)
        for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
            x = a + half * (1.0 + node)
            height, breadth, drag_y, drag_z = (
                (table[k + 1] - table[k]) / (b - a) * (x - a) + table[k]
                for table in (law.height, law.breadth, law.drag_y, law.drag_z)
            )
            scale = 0.5 * law.density * half * weight
            found.append(Strip(x, scale * drag_y * height, scale * drag_z * breadth))
    return tuple(found)


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "cross-flow drag" if damped_bodies(structure) else ""


def damped_bodies(structure: Structure) -> set[int]:
    """Indices of the bodies that have cross-flow drag."""
    return {index for index, _, _ in structure.law("cross_flow") or ()}


def strip_count(structure: Structure) -> int:
    """Number of strips of all bodies."""
    return sum(count for _, count, _ in structure.law("cross_flow") or ())


def _together(structure: Structure) -> bool:
    """Whether on any body both directions act together."""
    return any(together for _, _, together in structure.law("cross_flow") or ())


def strip_struct(structure: Structure) -> Struct:
    """One strip; `together` only where any body has it."""
    fields = [
        Field("x", REAL, (), "m", "its place along the body's first axis"),
        Field("y", REAL, (), "N s2/m2", "force over the square of its velocity along y"),
        Field("z", REAL, (), "N s2/m2", "likewise along z"),
    ]
    if _together(structure):
        fields.append(Field("together", INT, (), "", "1: the drag is along the whole velocity across; 0: y, z apart"))
    return Struct("strip", "A strip of a slender body in cross flow.", tuple(fields))


def table_fields(structure: Structure) -> list[Field]:
    """The strips of all bodies, where there are any."""
    count = strip_count(structure)
    return [Field("strip", strip_struct(structure), (count,))] if count else []


def damper_fields(structure: Structure) -> list[Field]:
    """Members of the damper of a body: the range of its strips."""
    if not strip_count(structure):
        return []
    first = Field("first_strip", INT, (), "", "strips first_strip .. last_strip - 1 of the table")
    return [first, Field("last_strip", INT)]


def damper_values(body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """The members of a damper; the strips of the body are appended to `rows` of "strip"."""
    if damper.field("first_strip") is None:
        return {}
    strips, law = rows.setdefault("strip", []), body.law(CrossFlow)
    first = len(strips)
    for strip in strips_of(law) if law else ():
        strips.append({"x": strip.x, "y": strip.y, "z": strip.z, "together": int(law.together if law else False)})
    return {"first_strip": first, "last_strip": len(strips)}


def strip_members(stand: Stand, rows: Any) -> Iterator[Member]:
    """The strips, in the order in which the table has them, counted from 1."""
    own = [(body.name, k) for body in stand.bodies if (law := body.law(CrossFlow)) for k in range(len(strips_of(law)))]
    for number, ((body, k), row) in enumerate(zip(own, rows, strict=True)):
        for name, unit, what in (
            ("x", units.METRE, "place along its first axis"),
            ("y", units.law(1, (1, 1)), "drag over the square of its velocity along y"),
            ("z", units.law(1, (1, 1)), "drag over the square of its velocity along z"),
        ):
            text = f"{body}: strip {k + 1} in cross flow, {what}"
            yield Member(f"strip[{number + 1}].{name}", unit, text, float(member(row, name)))


ARRAY_MEMBERS = {"strip": strip_members}
"""Reals of the arrays of the table, by name."""

BY_TWIST = "add_strips"
"""The function that adds the wrench of a body by its own twist."""


def add_functions(lib: FunctionSet) -> None:
    """The drag of the strips of one body, where any body has strips."""
    if strip_count(lib.layout.structure):
        lib.add(add_strips(lib))


def add_strips(lib: FunctionSet) -> Function:
    """Cross-flow drag of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body, P = adding.body, adding.P
    with adding.each("strip", strip_count(lib.layout.structure)) as strip:
        v = body.let("v", adding.V[1] + strip.x * adding.V[5])
        w = body.let("w", adding.V[2] - strip.x * adding.V[4])
        Y, Z = body.local("Y"), body.local("Z")
        body.set(Y, -(strip.y * (v * magnitude(v))))
        body.set(Z, -(strip.z * (w * magnitude(w))))
        if _together(lib.layout.structure):
            with body.when(strip.together > 0):
                across = body.let("across", lib["sqrt"](v * v + w * w))
                # 1 in place of a speed of zero, where all forces are zero
                speed = body.let("speed", select(across > 0, across, real(1)), "of the strip across the axis")
                drag = body.let("drag", (strip.y * v * v + strip.z * w * w) / speed)
                body.set(Y, -(drag * v))
                body.set(Z, -(drag * w))
        body.add(P[1], Y)
        body.add(P[2], Z)
        body.add(P[4], -(strip.x * Z))
        body.add(P[5], strip.x * Y)
    return adding.function(
        "add_strips", "Adds the cross-flow drag of one body to its wrench, both in the body's own frame."
    )
