"""The coupled equations with free flywheels eliminated: K - sum I I^T / Theta_ff, and its solution by blocks."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.derive.order import SYMMETRIC
from mahovik.core.formula.derived import carrier as derived_carrier
from mahovik.core.lower import lanes
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def _products(column: Sequence[Expr], scaled: Sequence[Expr], rate: Expr) -> dict[str, list[Expr]]:
    """I I^T / Theta_ff by blocks, and I rate."""
    return {
        "A": [column[a] * scaled[b] for a, b in SYMMETRIC],
        "B": [column[3 + a] * scaled[b] for a in range(3) for b in range(3)],
        "D": [column[3 + a] * scaled[3 + b] for a, b in SYMMETRIC],
        "F": [element * rate for element in column],
    }


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
    for name, values in _products(list(column.place), list(scaled), rate.place).items():
        for target, value in zip(F.place if name == "F" else schur.place.member(name), values, strict=True):
            body.add(target, -value)
    return body.function(
        "eliminate",
        "Eliminates one free flywheel: K - I I^T / Theta_ff, F - I rate.",
        (column, inverse, rate, schur, F),
    )


def eliminate_block(lib: Library) -> Function:
    """Terms that eliminating a block of flywheels takes from K and F, lane by lane."""
    drive, first = Argument("drive", lib.layout.lane_coupling), lanes.first_argument()
    inverse = lanes.room_argument(lib, "inverse", "1 / Theta_ff; 0 where a lock holds", unit="1/(kg m2)")
    rate = lanes.room_argument(lib, "rate", "accelerations at V* = 0", unit="rad/s2")
    parts = Argument("lane", lib.layout.lane_schur, (), "inout")
    body = Body()
    with body.loop("k", lib.layout.lane_count) as k:
        column = lanes.lane(drive.place.I, k)
        w = body.let("w", inverse.place[first.place + k])
        a = body.let("a", rate.place[first.place + k])
        body.note("I / Theta_ff")
        scaled = [body.let(f"n{i + 1}", column[i] * w) for i in range(6)]
        for name, values in _products(column, scaled, a).items():
            for target, value in zip(lanes.lane(parts.place.member(name), k), values, strict=True):
                body.add(target, value)
    return body.function(
        "eliminate_block",
        "Adds up what eliminating a block of flywheels takes away: I I^T / Theta_ff, I rate, lane by lane.",
        (drive, first, inverse, rate, parts),
    )


def take_lanes(lib: Library) -> Function:
    """K and F less the sums of the lanes."""
    parts = Argument("lane", lib.layout.lane_schur)
    schur = Argument("K", lib.layout.schur, (), "inout")
    F = Argument("F", Kind.REAL, (6,), "inout")
    body = Body()
    fields = lib.layout.lane_schur.fields
    totals = {f.name: lanes.halves(body, f"half_{f.name}", parts.place.member(f.name)) for f in fields}
    for name, total in totals.items():
        target = F.place if name == "F" else schur.place.member(name)
        with body.loop("i", len(total)) as i:
            body.add(target[i], -lanes.tree(list(total[i])))
    purpose = "Takes the sums of the lanes, added in a fixed tree, from K and F."
    return body.function("take_lanes", purpose, (parts, schur, F))


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
    lib.begin(body)
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
