"""Control derivatives in the program of a stand: those of all bodies, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import TwistFunction
from mahovik.core.lower.member import Member, member
from mahovik.core.program.build import Body as Statements
from mahovik.core.program.expression import Expr, Place, magnitude, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import WRENCH_LETTERS, Body, Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.control.law import MOST_FACTORS, ControlDerivatives, Factor, Velocity

INT, REAL = Kind.INT, Kind.REAL
ORDER = ("first", "second", "third", "fourth")
ARRAYS = {"deflection": ("fin", "deflection"), "speed": ("propeller", "speed"), "race": ("propeller", "speed")}
"""Array of the table, and its member, from which a factor comes."""

Fact = tuple[str, int, bool]
"""A factor: "velocity" and its component, or an input and its place in the array; whether the magnitude counts."""

TWIST = 13
"""Factors that every stand with the law has: 1, the twist, its magnitudes."""


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "control derivatives" if damped_bodies(structure) else ""


def damped_bodies(structure: Structure) -> set[int]:
    """Indices of the bodies that have control derivatives."""
    return {index for index, _ in structure.law("control_derivatives") or ()}


def term_count(structure: Structure) -> int:
    """Number of control derivatives of all bodies."""
    return sum(len(terms) for _, terms in structure.law("control_derivatives") or ())


def _terms(structure: Structure) -> Iterator[tuple[int, tuple[Fact, ...]]]:
    """Wrench component and factors of each derivative, in the order of the table."""
    for _, terms in structure.law("control_derivatives") or ():
        yield from terms


def _inputs(structure: Structure) -> tuple[Fact, ...]:
    """The inputs among the factors, each once, in the order in which the derivatives name them."""
    found = (fact for _, facts in _terms(structure) for fact in facts if fact[0] != "velocity")
    return tuple(dict.fromkeys(found))


def _has_race(structure: Structure) -> bool:
    return any(what == "race" for what, _, _ in _inputs(structure))


def table_fields(structure: Structure) -> list[Field]:
    """The control derivatives of all bodies, where there are any."""
    count, most = term_count(structure), TWIST - 1 + len(_inputs(structure))
    inputs = f", 13..{most} the inputs" if most >= TWIST else ""
    fields = [
        Field("wrench", INT, (), "", "component of the wrench, 0..5 = X Y Z K M N"),
        Field("first", INT, (), "", f"0 is 1; 1..6 = u v w p q r, 7..12 their magnitudes{inputs}"),
        *(Field(name, INT, (), "", "likewise") for name in ORDER[1:]),
        Field("value", REAL, (), "SI", "wrench += value * first * second * third * fourth"),
    ]
    return [Field("control", Struct("control", "A control derivative.", tuple(fields)), (count,))] if count else []


def damper_fields(structure: Structure) -> list[Field]:
    """Members of the damper of a body: the range of its derivatives, and the constant of races."""
    if not term_count(structure):
        return []
    fields = [
        Field("first_control", INT, (), "", "control derivatives first_control .. last_control - 1 of the table"),
        Field("last_control", INT),
    ]
    if _has_race(structure):
        fields.append(Field("race", REAL, (), "m^2/rad^2", "race of a propeller: sign(n) (sqrt(u u + race n n) - |u|)"))
    return fields


def damper_values(body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """The members of a damper; the derivatives of the body are appended to `rows` of "control".

    Its inputs come after those of the bodies before it, as in `_inputs`: no two bodies share one.
    """
    if damper.field("first_control") is None:
        return {}
    law, found = body.law(ControlDerivatives), rows.setdefault("control", [])
    first, own = len(found), dict[Factor, int]()
    taken = max((row[name] + 1 for row in found for name in ORDER), default=0)
    for term in law.terms if law else ():
        places = [_place(factor, own, max(taken, TWIST)) for factor in term.of]
        places += [0] * (MOST_FACTORS - len(places))
        found.append({"wrench": term.wrench, "value": term.value} | dict(zip(ORDER, places, strict=True)))
    race = {"race": law.race if law else 0.0} if damper.field("race") is not None else {}
    return {"first_control": first, "last_control": len(found)} | race


def _place(factor: Factor, own: dict[Factor, int], start: int) -> int:
    """Index of a factor in the vector of all; an input takes the next one from `start`."""
    if isinstance(factor, Velocity):
        return 1 + factor.component + 6 * factor.absolute
    return own.setdefault(factor, start + len(own))


def damper_members(body: str, struct: Struct, value: Any) -> Iterator[Member]:
    """The constant of races; the derivatives follow in a table of their own."""
    if struct.field("race") is not None:
        text = f"{body}: constant of the races of its propellers"
        yield Member(f"{body}.control_derivatives.race", units.RACE, text, float(member(value, "race")), positive=True)


def control_members(stand: Stand, rows: Any) -> Iterator[Member]:
    """The derivatives, in the order in which the table has them, counted from 1."""
    laws = ((body.name, body.law(ControlDerivatives)) for body in stand.bodies)
    own = [(name, term) for name, law in laws if law is not None for term in law.terms]
    for k, ((body, term), row) in enumerate(zip(own, rows, strict=True)):
        factors = " ".join(factor.text for factor in term.of)
        text = f"{body}: control derivative, {WRENCH_LETTERS[term.wrench]} += value {factors}"
        metres, radians, rates = (sum(each) for each in zip(*(f.powers for f in term.of), strict=True))
        unit = units.coefficient(term.wrench, metres, radians, rates)
        yield Member(f"control_derivative[{k + 1}]", unit, text, float(member(row, "value")))


ARRAY_MEMBERS = {"control": control_members}
"""Reals of the arrays of the table, by name."""

BY_TWIST = "add_control"
"""The function that adds the wrench of a body by its own twist."""


def add_functions(lib: FunctionSet) -> None:
    """The control derivatives of one body, where any body has some."""
    if term_count(lib.layout.structure):
        lib.add(add_control(lib))


def add_control(lib: FunctionSet) -> Function:
    """Control derivatives of one body in its own frame, added to a wrench."""
    adding = TwistFunction(lib)
    body, x = adding.body, _factors(lib, adding)
    with adding.each("control", term_count(lib.layout.structure), "t") as term:
        factors = x[term.first], x[term.second], x[term.third], x[term.fourth]
        body.add(adding.P[term.wrench], term.value * factors[0] * factors[1] * factors[2] * factors[3])
    return adding.function(
        "add_control", "Adds the control derivatives of one body to its wrench, both in the body's own frame."
    )


def _factors(lib: FunctionSet, adding: TwistFunction) -> Place:
    """All factors of the derivatives of a stand: 1, twist, magnitudes, inputs."""
    inputs, body, V = _inputs(lib.layout.structure), adding.body, adding.V
    x = body.local("x", (TWIST + len(inputs),), comment="1, u v w p q r, their magnitudes, inputs")
    body.set(x[0], real(1))
    for k in range(6):
        body.set(x[1 + k], V[k])
    for k in range(6):
        body.set(x[7 + k], magnitude(V[k]))
    for k, (what, place, absolute) in enumerate(inputs):
        array, name = ARRAYS[what]
        value: Expr = adding.table.member(array)[place].member(name)
        if what == "race":
            value = _race(lib, body, f"{k + 1}", V[0], adding.damper.race, value)
        body.set(x[TWIST + k], magnitude(value) if absolute else value)
    return x


def _race(lib: FunctionSet, body: Statements, number: str, u: Place, constant: Place, n: Expr) -> Expr:
    """The race a |n| n / (sqrt(u u + a n n) + |u|) of one propeller, a the constant; it loses no digits."""
    root = body.let(f"behind{number}", lib["sqrt"](u * u + constant * (n * n)), "speed in the race")
    both = body.let(f"both{number}", root + magnitude(u))
    return body.let(f"race{number}", constant * (magnitude(n) * n) / select(both > 0, both, real(1)))
