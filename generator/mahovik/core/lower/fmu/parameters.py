"""What is measured on a stand, number by number, in the order of the structs that hold it: parameters and laws."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mahovik.core.lower.fmu import units
from mahovik.core.lower.fmu.member import Member, matrix, member, members, vector
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.values import Values
from mahovik.core.program.types import Struct
from mahovik.core.stand.model import TWIST_LETTERS, WRENCH_LETTERS, DampingTerm, Stand


def parameters(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of `parameters`, depth first."""
    named = {
        "instrument": [p.name for p in stand.instruments],
        "flywheel": [s.name for s in stand.flywheels],
        "point": [p.name for p in stand.points],
    }
    given = values.parameters
    for f in layout.parameters.fields:
        if f.name == "added_mass":
            yield from matrix("added_mass", f, given[f.name], units.added_mass, "added mass Lambda, about O1 in E1")
        elif f.name == "carrier":
            assert isinstance(f.type, Struct)
            yield from members("carrier", f.type, given[f.name])
        else:
            assert isinstance(f.type, Struct)
            for name, value in zip(named[f.name], given[f.name], strict=True):
                yield from members(name, f.type, value)


def laws(stand: Stand, layout: Layout, values: Values) -> Iterator[Member]:
    """All reals of the table that `prepare` does not touch, depth first."""
    table = values.table
    for k, own in enumerate(layout.own if layout.own_damped else ()):
        assert layout.frame.field("damper") is not None
        name = stand.bodies[own.index].name
        yield from _damper(name, layout.damper, member(member(table, "frame")[k], "damper"))
    for f in layout.laws:
        given = member(table, f.name)
        if f.name in ("gravity", "stream"):
            what = {"gravity": "gravity in E0", "stream": "velocity of the fluid in E0"}[f.name]
            yield from vector(f.name, f, given, what)
        elif f.name == "damper":
            yield from _damper("carrier", layout.damper, given)
        elif f.name == "term":
            yield from _terms(stand, given)
        else:
            law = next(law for law in layout.law_tables if f in law.fields(layout.structure))
            yield from law.members(f, given)


def _damper(body: str, struct: Struct, value: Any) -> Iterator[Member]:
    """Matrices of damping; the hydrodynamic derivatives follow in a table of their own."""
    for f in struct.fields:
        if f.name == "linear":
            what = f"{body}: linear damping, of its own twist relative to the fluid, in its own frame"
            yield from matrix(f"{body}.damping.linear", f, member(value, f.name), lambda i, j: units.law(i, (j,)), what)
        elif f.name == "quadratic":
            what = f"{body}: damping quadratic in its own twist relative to the fluid, in its own frame"
            yield from matrix(
                f"{body}.damping.quadratic", f, member(value, f.name), lambda i, j: units.law(i, (j, j)), what
            )


def _terms(stand: Stand, rows: Any) -> Iterator[Member]:
    """Hydrodynamic derivatives, in the order in which the table has them."""
    own: list[tuple[str, DampingTerm]] = [
        (body.name, term) for body in stand.bodies if body.damping is not None for term in body.damping.terms
    ]
    for k, ((body, term), row) in enumerate(zip(own, rows, strict=True)):
        factors = [f"|{TWIST_LETTERS[f.component]}|" if f.absolute else TWIST_LETTERS[f.component] for f in term.of]
        text = f"{body}: hydrodynamic derivative, {WRENCH_LETTERS[term.wrench]} += value {' '.join(factors)}"
        unit = units.law(term.wrench, tuple(f.component for f in term.of))
        yield Member(f"derivative[{k + 1}]", unit, text, float(member(row, "value")))
