"""The coupled equations with free flywheels eliminated: K - sum I I^T / Theta_ff, and its solution by blocks of 3x3."""

from __future__ import annotations

from itertools import product

from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.formula.derived import carrier as derived_carrier
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def eliminate(lib: Library) -> Function:
    """One free flywheel eliminated from the coupled equations."""
    column = Argument("column", Kind.REAL, (6,), purpose="of I")
    inverse = Argument("spin_inv", Kind.REAL, unit="1/(kg m2)")
    rate = Argument("rate", Kind.REAL, unit="rad/s2", purpose="its acceleration at V* = 0")
    schur = Argument("K", lib.layout.schur, (), "inout")
    F = Argument("F", Kind.REAL, (6,), "inout")
    body = Body()
    scaled = body.local("scaled", (6,), comment="I / Theta_ff")
    for k in range(6):
        body.set(scaled[k], column.place[k] * inverse.place)
    I, K = column.place, schur.place
    for target, (a, b) in zip(K.A, SYMMETRIC, strict=True):
        body.add(target, -(I[a] * scaled[b]))
    for target, (a, b) in zip(K.B, product(range(3), repeat=2), strict=True):
        body.add(target, -(I[3 + a] * scaled[b]))
    for target, (a, b) in zip(K.D, SYMMETRIC, strict=True):
        body.add(target, -(I[3 + a] * scaled[3 + b]))
    for target, element in zip(F.place, I, strict=True):
        body.add(target, -(element * rate.place))
    return body.function(
        "eliminate",
        "Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate.",
        (column, inverse, rate, schur, F),
    )


def invert_block(lib: Library, body: Body, K: Place, inverse: Place) -> None:
    """A^-1 (6: 11 22 33 12 13 23) of a mass matrix by blocks; NOT_POSITIVE_DEFINITE where it is singular."""
    adjugate, determinant = derived_carrier.inverse_of_symmetric()
    names = ("11", "22", "33", "12", "13", "23")
    cofactor: list[Expr] = [body.let(f"c{n}", translate(e, {"A": K.A})) for n, e in zip(names, adjugate, strict=True)]
    d = body.let("det", translate(determinant, {"A": K.A, "cofactor": cofactor}))
    whole = and_(d >= lib.layout.precision.smallest, d <= lib.limits["LARGEST"].expression)
    lib.guard(body, Not(and_(and_(K.A[0] > 0, cofactor[2] > 0), whole)), "NOT_POSITIVE_DEFINITE")
    r = body.let("r", 1 / d)
    for k in range(6):
        body.set(inverse[k], cofactor[k] * r)


def factor_schur(lib: Library) -> Function:
    """K factored by blocks of 3x3."""
    schur = Argument("K", lib.layout.schur)
    out = Argument("factor", lib.layout.schur_factor, (), "out")
    body = Body()
    K, f = schur.place, out.place
    invert_block(lib, body, K, f.A_inv)
    S = body.local("S", (6,), comment="D - B A^-1 B^T")
    binding = {"A_inv": f.A_inv, "B": K.B, "U": f.U, "J": K.D}
    assign(body, list(f.U), derived_carrier.schur_coupling(True), binding)
    assign(body, list(S), derived_carrier.reduced_inertia(True), binding)
    lib.check(body, "factor3", S, f.L)
    return body.checked_function(
        "factor_schur",
        "Factors [A B^T; B D], symmetric positive definite, by blocks of 3x3.",
        (schur, out),
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def solve_schur(lib: Library) -> Function:
    """6x6 solve by the factors."""
    factor = Argument("factor", lib.layout.schur_factor)
    F = Argument("F", Kind.REAL, (6,))
    y = Argument("y", Kind.REAL, (6,), "out", purpose="must not overlap F")
    f = factor.place
    body = Body()
    n = body.local("moment", (3,), comment="n - B A^-1 f")
    omega_dot = body.local("omega_dot", (3,))
    six = list(F.place)
    binding = {"A_inv": f.A_inv, "U": f.U, "f": six[:3], "n": six[3:], "omega_dot": omega_dot}
    assign(body, list(n), derived_carrier.reduced_moment(True), binding)
    body.call(lib["solve3"], f.L, n, omega_dot)
    out = list(y.place)
    assign(body, out[:3], derived_carrier.linear_part(True), binding)
    for target, value in zip(out[3:], omega_dot, strict=True):
        body.set(target, value)
    return body.function("solve_schur", "Solves [A B^T; B D] y = F by the factors.", (factor, F, y))


def start_schur(lib: Library, body: Body, table: Place, sums: Place, K: Place) -> None:
    """K of (2) by blocks."""
    if lib.layout.added_mass:
        body.copy_array(K.A, table.A)
        binding = {"mu": sums.mu, "G": table.G}
    else:
        for k in range(6):
            body.set(K.A[k], table.mass if k < 3 else real(0))
        binding = {"mu": sums.mu}
    assign(body, list(K.B), derived_carrier.coupling_block(lib.layout.added_mass), binding)
    body.copy_array(K.D, sums.J)
