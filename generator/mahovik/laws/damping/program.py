"""Damping in the program of a stand."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mahovik.core.lower import units
from mahovik.core.lower.function_set import FunctionSet
from mahovik.core.lower.law import CYCLES, OWN_TWIST, SIX, WRENCH, BodyProgram
from mahovik.core.lower.units import Member, matrix
from mahovik.core.program.kernel import Reals, Record, reals
from mahovik.core.program.types import Field, Kind, Struct, member
from mahovik.core.program.vector import dot
from mahovik.core.stand.fields import ZERO6
from mahovik.core.stand.model import WRENCH_LETTERS, Body, Stand, Structure
from mahovik.laws.damping.law import Damping

INT, REAL = Kind.INT, Kind.REAL
LINEAR = Field("linear", REAL, (6, 6), "SI", "wrench -= linear V")
QUADRATIC = Field("quadratic", REAL, (6, 6), "SI", "wrench -= quadratic (V |V|)")
CONTAINED = Field(
    "contained", REAL, (6, 6), "SI", "added mass whose products the derivatives contain: wrench += Phi(V) (contained V)"
)
TERM = Struct(
    "term",
    "A hydrodynamic derivative.",
    (
        Field("wrench", INT, (), "", "component of the wrench, 0..5 = X Y Z K M N"),
        Field("first", INT, (), "", "0..5 = u v w p q r, 6..11 their magnitudes"),
        Field("second", INT, (), "", "likewise"),
        Field("value", REAL, (), "SI", "wrench += value * first * second"),
    ),
)


class DampingProgram(BodyProgram):
    """Matrices of every body, in its damper, and all hydrodynamic derivatives."""

    words = "damping"
    function = "damp"
    array = "term"
    plural = "terms"

    def bodies(self, structure: Structure) -> set[int]:
        """Indices of the bodies on which any damping acts."""
        with_terms = (index for index, _ in structure.law("damping_terms"))
        products = structure.law("products_in_derivatives") or ()
        return {*structure.law("linear_damping"), *structure.law("quadratic_damping"), *with_terms, *products}

    def count(self, structure: Structure) -> int:
        """Number of hydrodynamic derivatives of all bodies."""
        return sum(len(kinds) for _, kinds in structure.law("damping_terms"))

    def struct(self, structure: Structure) -> Struct:
        """One derivative."""
        return TERM

    def rows(self, body: Body, before: Sequence[dict[str, object]]) -> list[dict[str, float]]:
        """The derivatives of a body."""
        rows, law = [], body.law(Damping)
        for term in law.terms if law else ():
            first, second = (f.component + 6 * f.absolute for f in term.of)
            rows.append({"wrench": term.wrench, "first": first, "second": second, "value": term.value})
        return rows

    def damper_fields(self, structure: Structure) -> list[Field]:
        """Members that some body has."""
        before = (("linear_damping", LINEAR), ("quadratic_damping", QUADRATIC))
        matrices = [field for key, field in before if structure.law(key)]
        contained = [CONTAINED] if structure.law("products_in_derivatives") else []
        return [*matrices, *super().damper_fields(structure), *contained]

    def damper_values(self, body: Body, damper: Struct, rows: dict[str, list[dict[str, object]]]) -> dict[str, object]:
        """Matrices and the range of the derivatives; zeros where the body has none."""
        law = body.law(Damping)
        matrices = dict(law.matrices) if law else {}
        if law is not None and law.contains_products:
            matrices["contained"] = getattr(body, "added_mass", None) or ZERO6
        members = {f.name: matrices.get(f.name, ZERO6) for f in (LINEAR, QUADRATIC, CONTAINED) if damper.field(f.name)}
        return members | super().damper_values(body, damper, rows)

    def damper_members(self, name: str, damper: Struct, value: object) -> Iterator[Member]:
        """Matrices of damping; the hydrodynamic derivatives follow in a table of their own."""
        twist = "of its own twist relative to the fluid, in its own frame"
        for field, words, unit in (
            (LINEAR, f"linear damping, {twist}", lambda i, j: units.law(i, (j,))),
            (QUADRATIC, "damping quadratic in its own twist relative to the fluid, in its own frame",
             lambda i, j: units.law(i, (j, j))),
            (CONTAINED, "added mass whose products its derivatives contain", units.added_mass),
        ):  # fmt: skip
            if damper.field(field.name) is not None:
                path = f"{name}.damping.{field.name}"
                yield from matrix(path, field, member(value, field.name), unit, f"{name}: {words}")

    def members(self, stand: Stand, field: Field, value: Sequence[object]) -> Iterator[Member]:
        """Hydrodynamic derivatives, with their bodies and factors."""
        laws = ((body.name, body.law(Damping)) for body in stand.bodies)
        derivatives = [(name, term) for name, law in laws if law is not None for term in law.terms]
        for k, ((name, term), row) in enumerate(zip(derivatives, value, strict=True)):
            factors = " ".join(factor.text for factor in term.of)
            text = f"{name}: hydrodynamic derivative, {WRENCH_LETTERS[term.wrench]} += value {factors}"
            unit = units.law(term.wrench, tuple(f.component for f in term.of))
            yield Member(f"derivative[{k + 1}]", unit, text, float(member(row, "value")))

    def add_functions(self, lib: FunctionSet) -> None:
        """The damping of one body."""
        terms = self.count(lib.layout.structure)
        linear, quadratic, contained = (
            lib.layout.damper.field(f.name) is not None for f in (LINEAR, QUADRATIC, CONTAINED)
        )

        @lib.kernel(equation="(7)")
        def damp(
            table: Record = lib.table, damper: Record = lib.damper, V: Reals = OWN_TWIST, P: Reals = WRENCH
        ) -> None:
            """Adds the damping of one body to its wrench, both in the body's own frame."""
            if terms or quadratic:
                x = reals(12)  # u v w p q r and their magnitudes
                x[0:6] = V
                for k in SIX:
                    x[k + 6] = abs(V[k])
            if linear:
                for i in range(6):
                    P[i] -= dot(V, damper.linear[i])
            if quadratic:
                for i in range(6):
                    for j in range(6):
                        P[i] -= damper.quadratic[i][j] * (x[j] * x[j + 6])
            if terms:
                for term in self.elements(lib, table, damper, "t"):
                    P[term.wrench] += term.value * x[term.first] * x[term.second]
            if contained:
                Z = reals(6)  # momentum of the added mass
                for i in range(6):
                    Z[i] = dot(V, damper.contained[i])
                for k, a, b in CYCLES:
                    P[k] += V[3 + a] * Z[b] - V[3 + b] * Z[a]
                    P[3 + k] += V[a] * Z[b] - V[b] * Z[a]
                    P[3 + k] += V[3 + a] * Z[3 + b] - V[3 + b] * Z[3 + a]


LAW = DampingProgram()
