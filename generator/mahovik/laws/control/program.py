"""Control derivatives in the program of a stand: those of all bodies, one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import OWN_TWIST, SIX, WRENCH, BodyProgram
from mahovik.core.lower.units import Member
from mahovik.core.program.kernel import Reals, Record, inline, let, reals
from mahovik.core.program.types import Field, Kind, Struct, member
from mahovik.core.stand.model import WRENCH_LETTERS, Body, Stand, Structure
from mahovik.laws.control.law import MOST_FACTORS, Control, ControlDerivatives, Factor

INT, REAL = Kind.INT, Kind.REAL
ORDER = ("first", "second", "third", "fourth")
ARRAYS = {"deflection": ("fin", "deflection"), "speed": ("propeller", "speed"), "race": ("propeller", "speed")}
"""Array of the table, and its member, from which a factor comes."""

RACE = Field("race", REAL, (), "m2/rad2", "race of a propeller: sign(n) (sqrt(u u + race n n) - |u|)")

Fact = tuple[str, int, bool]
"""A factor: "velocity" and its component, or an input and its place in the array; whether the magnitude counts."""

TWIST = 13
"""Factors that every stand with the law has: 1, the twist, its magnitudes."""


def _inputs(structure: Structure) -> tuple[Fact, ...]:
    """The inputs among the factors, each once, in the order in which the derivatives name them."""
    terms = (term for _, derivatives in structure.law("control_derivatives") or () for term in derivatives)
    return tuple(dict.fromkeys(fact for _, facts in terms for fact in facts if fact[0] != "velocity"))


@inline
def race(lib: FunctionSet, k: int, u: float, a: float, n: float) -> Any:
    """The race a |n| n / (sqrt(u u + a n n) + |u|) of one propeller, which loses no digits."""
    root = let(f"behind{k + 1}", lib["sqrt"](u * u + a * (n * n)), "speed in the race")
    both = let(f"both{k + 1}", root + abs(u))
    return let(f"race{k + 1}", a * (abs(n) * n) / (both if both > 0 else 1.0))


class Steering(BodyProgram):
    """The derivatives of every body, and the constant of its races, in its damper."""

    words = "control derivatives"
    function = "add_control"
    array = "control"
    plural = "control derivatives"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies that have control derivatives."""
        return {index for index, _ in structure.law("control_derivatives") or ()}

    def count(self, structure: Structure) -> int:
        """Number of control derivatives of all bodies."""
        return sum(len(terms) for _, terms in structure.law("control_derivatives") or ())

    def struct(self, structure: Structure) -> Struct:
        """One derivative."""
        most = TWIST - 1 + len(_inputs(structure))
        inputs = f", 13..{most} the inputs" if most >= TWIST else ""
        fields = (
            Field("wrench", INT, (), "", "component of the wrench, 0..5 = X Y Z K M N"),
            Field("first", INT, (), "", f"0 is 1; 1..6 = u v w p q r, 7..12 their magnitudes{inputs}"),
            *(Field(name, INT, (), "", "likewise") for name in ORDER[1:]),
            Field("value", REAL, (), "SI", "wrench += value * first * second * third * fourth"),
        )
        return Struct("control", "A control derivative.", fields)

    def rows(self, body: Body, before: Sequence[dict[str, float]]) -> list[dict[str, float]]:
        """The derivatives of a body.

        Its inputs come after those of the bodies before it, as in `_inputs`: no two bodies share one.
        """
        law, inputs, rows = body.law(ControlDerivatives), dict[Factor, int](), []
        start = max((TWIST, *(int(row[name]) + 1 for row in before for name in ORDER)))

        def place(factor: Factor) -> int:
            if not isinstance(factor, Control):
                return 1 + factor.component + 6 * factor.absolute
            return inputs.setdefault(factor, start + len(inputs))

        for term in law.terms if law else ():
            places = [*map(place, term.of), *[0] * (MOST_FACTORS - len(term.of))]
            rows.append({"wrench": term.wrench, "value": term.value} | dict(zip(ORDER, places, strict=True)))
        return rows

    def damper_fields(self, structure: Structure) -> list[Field]:
        """The range of the derivatives, and the constant of races."""
        races = any(what == "race" for what, _, _ in _inputs(structure))
        return super().damper_fields(structure) + ([RACE] if races else [])

    def damper_values(self, body: Body, damper: Struct, rows: dict[str, list[dict[str, object]]]) -> dict[str, object]:
        """The range of the derivatives, and the constant of races."""
        law = body.law(ControlDerivatives)
        constant = {"race": law.race if law else 0.0} if damper.field("race") is not None else {}
        return super().damper_values(body, damper, rows) | constant

    def damper_members(self, name: str, damper: Struct, value: object) -> Iterator[Member]:
        """The constant of races; the derivatives follow in a table of their own."""
        if damper.field("race") is not None:
            text, size = f"{name}: constant of the races of its propellers", float(member(value, "race"))
            yield Member(f"{name}.control_derivatives.race", units.RACE, text, size, positive=True)

    def members(self, stand: Stand, field: Field, value: Sequence[object]) -> Iterator[Member]:
        """The derivatives, with their bodies and factors."""
        laws = ((body.name, body.law(ControlDerivatives)) for body in stand.bodies)
        derivatives = [(name, term) for name, law in laws if law is not None for term in law.terms]
        for k, ((name, term), row) in enumerate(zip(derivatives, value, strict=True)):
            factors = " ".join(factor.text for factor in term.of)
            text = f"{name}: control derivative, {WRENCH_LETTERS[term.wrench]} += value {factors}"
            metres, radians, rates = (sum(power) for power in zip(*(f.powers for f in term.of), strict=True))
            unit = units.coefficient(term.wrench, metres, radians, rates)
            yield Member(f"control_derivative[{k + 1}]", unit, text, float(member(row, "value")))

    def add_functions(self, lib: FunctionSet) -> None:
        """The control derivatives of one body."""
        inputs = _inputs(lib.layout.structure)
        size, numbered = TWIST + len(inputs), [(k, *fact) for k, fact in enumerate(inputs)]

        @lib.kernel(equation="(7)")
        def add_control(
            table: Record = lib.table, damper: Record = lib.damper, V: Reals = OWN_TWIST, P: Reals = WRENCH
        ) -> None:
            """Adds the control derivatives of one body to its wrench, both in the body's own frame."""
            x = reals(size)  # 1, u v w p q r, their magnitudes, inputs
            x[0] = 1
            x[1:7] = V
            for k in SIX:
                x[7 + k] = abs(V[k])
            for k, what, place, absolute in numbered:
                value = table.member(ARRAYS[what][0])[place].member(ARRAYS[what][1])
                if what == "race":
                    value = race(lib, k, V[0], damper.race, value)
                x[TWIST + k] = abs(value) if absolute else value
            for term in self.elements(lib, table, damper, "t"):
                P[term.wrench] += term.value * x[term.first] * x[term.second] * x[term.third] * x[term.fourth]


LAW = Steering()
