"""Fading damping in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import TwistFunction
from mahovik.core.lower.member import Member, matrix, member
from mahovik.core.lower.symbolic import translate
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Body
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.fading.law import FadingDamping

REAL = Kind.REAL


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "fading damping" if damped_bodies(structure) else ""


def damped_bodies(structure: Structure) -> set[int]:
    """Indices of the bodies that have fading damping."""
    return set(structure.law("fading_damping") or ())


def damper_fields(structure: Structure) -> list[Field]:
    """Members of the damper of a body, where any body has fading damping."""
    if not damped_bodies(structure):
        return []
    return [
        Field("fading", REAL, (6, 6), "SI", "wrench -= exp(-fading_rate U) fading V, U = |v|"),
        Field("fading_rate", REAL, (), "s/m", "not negative"),
    ]


def damper_values(body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """The members of a damper; zeros where the body has no such damping."""
    if damper.field("fading") is None:
        return {}
    law = body.law(FadingDamping)
    return {"fading": law.linear if law else ((0.0,) * 6,) * 6, "fading_rate": law.rate if law else 0.0}


def damper_members(body: str, struct: Struct, value: Any) -> Iterator[Member]:
    """Matrix and rate."""
    f = struct.field("fading")
    if f is None:
        return
    what = f"{body}: linear damping that fades, of its own twist relative to the fluid, in its own frame"
    yield from matrix(f"{body}.fading_damping.linear", f, member(value, f.name), lambda i, j: units.law(i, (j,)), what)
    text = f"{body}: rate at which that damping falls with its speed"
    rate = float(member(value, "fading_rate"))
    yield Member(f"{body}.fading_damping.rate", units.SECOND_PER_METRE, text, rate, positive=True)


BY_TWIST = "add_fading"
"""The function that adds the wrench of a body by its own twist."""


def add_functions(lib: FunctionSet) -> None:
    """The fading damping of one body, where any body has it, and the exponential that it needs."""
    if damped_bodies(lib.layout.structure):
        lib.add_exponential()
        lib.add(add_fading(lib))


def add_fading(lib: FunctionSet) -> Function:
    """Fading damping of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body, damper, V = adding.body, adding.damper, adding.V
    square = V[0] * V[0] + V[1] * V[1] + V[2] * V[2]
    speed = body.let("speed", lib["sqrt"](square), "of the body through the fluid")
    fade = body.let("fade", lib["exp"](-(damper.fading_rate * speed)))
    with body.loop("i", 6) as i:
        row = translate(derived.row_times(), {"row": damper.fading[i], "column": V})
        body.add(adding.P[i], -(fade * row))
    return adding.function(
        "add_fading", "Adds the fading damping of one body to its wrench, both in the body's own frame."
    )
