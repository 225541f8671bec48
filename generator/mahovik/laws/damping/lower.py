"""Damping in the program of a stand."""

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
from mahovik.core.program.expression import Place, magnitude
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct
from mahovik.core.stand.model import WRENCH_LETTERS, Body, Stand
from mahovik.core.stand.structure_facts import Structure
from mahovik.laws.damping.law import Damping

INT = Kind.INT


def words(structure: Structure) -> str:
    """The law in a word; empty where the stand does not have it."""
    return "damping" if damped_bodies(structure) else ""


def damped_bodies(structure: Structure) -> set[int]:
    """Indices of the bodies on which any damping acts."""
    with_terms = (index for index, _ in structure.law("damping_terms"))
    products = structure.law("products_in_derivatives") or ()
    return {*structure.law("linear_damping"), *structure.law("quadratic_damping"), *with_terms, *products}


def term_count(structure: Structure) -> int:
    """Number of hydrodynamic derivatives of all bodies."""
    return sum(len(kinds) for _, kinds in structure.law("damping_terms"))


def table_fields(structure: Structure) -> list[Field]:
    """The hydrodynamic derivatives of all bodies, where there are any."""
    fields = (
        Field("wrench", INT, (), "", "component of the wrench, 0..5 = X Y Z K M N"),
        Field("first", INT, (), "", "0..5 = u v w p q r, 6..11 their magnitudes"),
        Field("second", INT, (), "", "likewise"),
        Field("value", Kind.REAL, (), "SI", "wrench += value * first * second"),
    )
    count = term_count(structure)
    return [Field("term", Struct("term", "A hydrodynamic derivative.", fields), (count,))] if count else []


def damper_fields(structure: Structure) -> list[Field]:
    """Members of the damper of a body: those only that some body has."""
    fields = []
    if structure.law("linear_damping"):
        fields.append(Field("linear", Kind.REAL, (6, 6), "SI", "wrench -= linear V"))
    if structure.law("quadratic_damping"):
        fields.append(Field("quadratic", Kind.REAL, (6, 6), "SI", "wrench -= quadratic (V |V|)"))
    if term_count(structure):
        fields.append(Field("first_term", INT, (), "", "terms first_term .. last_term - 1 of the table"))
        fields.append(Field("last_term", INT))
    if structure.law("products_in_derivatives"):
        text = "added mass whose products the derivatives contain: wrench += Phi(V) (contained V)"
        fields.append(Field("contained", Kind.REAL, (6, 6), "SI", text))
    return fields


def damper_values(body: Body, damper: Struct, rows: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """The members of a damper; the hydrodynamic derivatives of the body are appended to `rows` of "term"."""
    damping, zero = body.law(Damping), ((0.0,) * 6,) * 6
    found: dict[str, Any] = {}
    if damper.field("linear") is not None:
        found["linear"] = damping.linear if damping and damping.linear else zero
    if damper.field("quadratic") is not None:
        found["quadratic"] = damping.quadratic if damping and damping.quadratic else zero
    if damper.field("first_term") is not None:
        terms = rows.setdefault("term", [])
        found["first_term"] = len(terms)
        for term in damping.terms if damping else ():
            first, second = (f.component + 6 * f.absolute for f in term.of)
            terms.append({"wrench": term.wrench, "first": first, "second": second, "value": term.value})
        found["last_term"] = len(terms)
    if damper.field("contained") is not None:
        contains = damping is not None and damping.contains_products
        found["contained"] = getattr(body, "added_mass", None) if contains else zero
    return found


def damper_members(body: str, struct: Struct, value: Any) -> Iterator[Member]:
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
        elif f.name == "contained":
            what = f"{body}: added mass whose products its derivatives contain"
            yield from matrix(f"{body}.damping.contained", f, member(value, f.name), units.added_mass, what)


def term_members(stand: Stand, rows: Any) -> Iterator[Member]:
    """Hydrodynamic derivatives, in the order in which the table has them."""
    damped = ((body.name, body.law(Damping)) for body in stand.bodies)
    own = [(name, term) for name, damping in damped if damping is not None for term in damping.terms]
    for k, ((body, term), row) in enumerate(zip(own, rows, strict=True)):
        factors = " ".join(factor.letter for factor in term.of)
        text = f"{body}: hydrodynamic derivative, {WRENCH_LETTERS[term.wrench]} += value {factors}"
        unit = units.law(term.wrench, tuple(f.component for f in term.of))
        yield Member(f"derivative[{k + 1}]", unit, text, float(member(row, "value")))


ARRAY_MEMBERS = {"term": term_members}
"""Reals of the arrays of the table, by name."""

BY_TWIST = "damp"
"""The function that adds the wrench of a body by its own twist."""


def add_functions(lib: FunctionSet) -> None:
    """The damping of one body, where any body is damped."""
    if damped_bodies(lib.layout.structure):
        lib.add(damp(lib))


def damp(lib: FunctionSet) -> Function:
    """Damping of one body in its own frame, added to a wrench."""
    struct, terms = lib.layout.damper, term_count(lib.layout.structure)
    adding = TwistFunction(lib)
    body, damper, V, P = adding.body, adding.damper, adding.V, adding.P
    factors: Place | None = None
    if terms or struct.field("quadratic") is not None:
        factors = body.local("x", (12,), comment="u v w p q r and their magnitudes")
        for k in range(6):
            body.set(factors[k], V[k])
        for k in range(6):
            body.set(factors[k + 6], magnitude(V[k]))
    if struct.field("linear") is not None:
        with body.loop("i", 6) as i:
            body.add(P[i], -translate(derived.row_times(), {"row": damper.linear[i], "column": V}))
    if struct.field("quadratic") is not None:
        assert factors is not None
        with body.loop("i", 6) as i, body.loop("j", 6) as j:
            drag = damper.quadratic[i][j] * (factors[j] * factors[j + 6])
            body.add(P[i], -drag)
    if terms:
        assert factors is not None
        with adding.each("term", terms, "t") as term:
            body.add(P[term.wrench], term.value * factors[term.first] * factors[term.second])
    if struct.field("contained") is not None:
        Z = body.local("Z", (6,), comment="momentum of the added mass")
        _times(body, damper.contained, V, Z)
        _add_crossed(body, V, Z, P)
    return adding.function("damp", "Adds the damping of one body to its wrench, both in the body's own frame.")


def _times(body: Statements, added_mass: Place, V: Place, Z: Place) -> None:
    """Z = Lambda V (6)."""
    with body.loop("i", 6) as i:
        body.set(Z[i], translate(derived.row_times(), {"row": added_mass[i], "column": V}))


def _add_crossed(body: Statements, V: Place, Z: Place, P: Place) -> None:
    """P += (omega x p, v x p + omega x h), Z = (p, h)."""
    for k in range(3):
        a, b = (k + 1) % 3, (k + 2) % 3
        body.add(P[k], V[3 + a] * Z[b] - V[3 + b] * Z[a])
        body.add(P[3 + k], V[a] * Z[b] - V[b] * Z[a])
        body.add(P[3 + k], V[3 + a] * Z[3 + b] - V[3 + b] * Z[3 + a])
