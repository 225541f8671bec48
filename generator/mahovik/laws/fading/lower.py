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
from mahovik.core.program.build import Body as Statements
from mahovik.core.program.expression import Expr, Place, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import Body
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.fading.data import FadingDamping

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


BY_TWIST = ("add_fading", "add_fading_slope")
"""Functions that add the wrench of a body's own twist, and its change."""


def add_functions(lib: FunctionSet) -> None:
    """The fading damping of one body, where any body has it, and the exponential that it needs."""
    if damped_bodies(lib.layout.structure):
        lib.add_exponential()
        lib.add(add_fading(lib))


def add_slopes(lib: FunctionSet) -> None:
    """The change of that damping."""
    if damped_bodies(lib.layout.structure):
        lib.add(add_fading_slope(lib))


def add_fading(lib: FunctionSet) -> Function:
    """Fading damping of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body, damper, V = adding.body, adding.damper, adding.V
    _, fade = _fade(lib, body, damper, V)
    with body.loop("i", 6) as i:
        body.add(adding.P[i], -(fade * _row(damper, i, V)))
    return adding.function(
        "add_fading", "Adds the fading damping of one body to its wrench, both in the body's own frame."
    )


def add_fading_slope(lib: FunctionSet) -> Function:
    """Derivative of one body's fading damping by its twist, times a twist."""
    adding = TwistFunction(lib, slope=True)
    body, damper, V, change = adding.body, adding.damper, adding.V, adding.change
    speed, fade = _fade(lib, body, damper, V)
    speed_by = body.let("speed_by", _dot(V, change) / select(speed > 0, speed, real(1)), "change of the speed")
    exponent_by = body.let("exponent_by", damper.fading_rate * speed_by)
    with body.loop("i", 6) as i:
        slope = _row(damper, i, change) - exponent_by * _row(damper, i, V)
        body.add(adding.P[i], -(fade * slope))
    return adding.function("add_fading_slope", "Change of the fading damping of one body with its twist.")


def _fade(lib: FunctionSet, body: Statements, damper: Place, V: Place) -> tuple[Place, Place]:
    """Speed U of the body through the fluid, and exp(-rate U)."""
    speed = body.let("speed", lib["sqrt"](_dot(V, V)), "of the body through the fluid")
    return speed, body.let("fade", lib["exp"](-(damper.fading_rate * speed)))


def _row(damper: Place, i: Place, V: Place) -> Expr:
    """Row i of the matrix times a twist."""
    return translate(derived.row_times(), {"row": damper.fading[i], "column": V})


def _dot(a: Place, b: Place) -> Expr:
    """Product of the linear parts."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
