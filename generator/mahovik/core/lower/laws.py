"""Damping of one body, and how a wrench in E1 is added up."""

from __future__ import annotations

from mahovik.core.formula.derived import wrench as derived
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Place, magnitude
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def damp(lib: Library) -> Function:
    """Damping of one body in its own frame, added to a wrench."""
    layout = lib.layout
    damper = Argument("damper", layout.damper)
    V = Argument("V", Kind.REAL, (6,), purpose="twist relative to the fluid, in the body's frame")
    P = Argument("P", Kind.REAL, (6,), "inout", "N, N m", "wrench that is added to")
    table = lib.table_argument()
    body = Body()
    factors: Place | None = None
    if layout.terms or layout.quadratic_damping:
        factors = body.local("x", (12,), comment="u v w p q r and their magnitudes")
        for k in range(6):
            body.set(factors[k], V.place[k])
        for k in range(6):
            body.set(factors[k + 6], magnitude(V.place[k]))
    if layout.linear_damping:
        with body.loop("i", 6) as i:
            row = derived.row_times("linear", "V")
            body.add(P.place[i], -translate(row, {"linear": damper.place.linear[i], "V": V.place}))
    if layout.quadratic_damping:
        assert factors is not None
        with body.loop("i", 6) as i, body.loop("j", 6) as j:
            drag = damper.place.quadratic[i][j] * (factors[j] * factors[j + 6])
            body.add(P.place[i], -drag)
    if layout.terms:
        assert factors is not None
        first, last = damper.place.first_term, damper.place.last_term
        with body.loop("t", last, start=first, most=layout.terms) as t:
            term = table.place.term[t]
            body.add(P.place[term.wrench], term.value * factors[term.first] * factors[term.second])
    return Function(
        "damp",
        "Adds the damping of one body to its wrench, both in the body's own frame.",
        (table, damper, V, P),
        body.statements,
        equation="(7)",
    )


def add_force(body: Body, target: list[Place], origin: Place, force: list[Place], moment: list[Place] | None) -> None:
    """F += T (force; moment): a wrench at `origin`, in axes of E1."""
    for t, f in zip(target[:3], force, strict=True):
        body.add(t, f)
    formula = derived.moment_of_force() if moment is None else derived.moved_moment()
    binding = {"O": origin, "f": force, "n": moment}
    assign(body, target[3:], formula, binding, add=True)
