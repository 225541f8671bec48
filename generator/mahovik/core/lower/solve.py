"""Momentum form of (8), and its solution: a 3x3 solve, for the translational block of K is constant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from mahovik.core.formula.derived import carrier as derived
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def parts_of_twist(V: Place) -> dict[str, list[Place]]:
    """v and omega of a twist, by the names of the derivation."""
    six = list(V)
    return {"v": six[:3], "omega": six[3:]}


def carrier_binding(lib: Library, table: Place, sums: Place) -> dict[str, Any]:
    """Constants and sums by the names of the derivation."""
    binding: dict[str, Any] = {f.name: sums.member(f.name) for f in lib.layout.sums.fields}
    binding["m"] = table.mass
    if lib.layout.added_mass:
        binding |= {"A": table.A, "A_inv": table.A_inv, "G": table.G}
    else:
        binding["m_inverse"] = table.mass_inverse
    return binding


def momentum_screw(lib: Library) -> Function:
    """Z = K V + sum I phi'."""
    table = lib.table_argument()
    sums = Argument("sum", lib.layout.sums)
    V = Argument("V", Kind.REAL, (6,))
    Z = Argument("Z", Kind.REAL, (6,), "out")
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place) | parts_of_twist(V.place)
    assign(body, list(Z.place), derived.momentum(lib.layout.added_mass), binding)
    return body.function(
        "momentum_screw", "Momentum screw Z = K V + sum I phi' of the sums.", (table, sums, V, Z), equation="(2)"
    )


def subtract_rates(lib: Library) -> Function:
    """F becomes F - Phi Z - K_dot V - (a_rel, g_rel), with Z = K V + sum I phi'."""
    table = lib.table_argument()
    sums = Argument("sum", lib.layout.sums)
    V = Argument("V", Kind.REAL, (6,))
    F = Argument("F", Kind.REAL, (6,), "inout", "N, N m", "in: wrench (7); out: right-hand side of (8)")
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place) | parts_of_twist(V.place)
    body.note("momentum screw Z = K V + sum I phi'")
    momentum = derived.momentum(lib.layout.added_mass)
    Z = [body.let(f"Z{k + 1}", translate(value, binding)) for k, value in enumerate(momentum)]
    binding |= {"p": Z[:3], "h": Z[3:], "F": F.place}
    assign(body, list(F.place), derived.remainder(), binding)
    return body.function(
        "subtract_rates",
        "Turns F into the right-hand side of (8): F - Phi Z - K* V - the flywheels' terms",
        (table, sums, V, F),
        equation="(2), (4), (5)",
    )


def _factors3(lib: Library, body: Body, m: Place) -> dict[str, Expr]:
    """L D L^T of a symmetric 3x3 matrix that is guarded to be positive: local variables by the names of factors3."""
    least = real(lib.layout.precision.smallest)
    lib.guard(body, Not(m[0] >= least), "NOT_POSITIVE_DEFINITE")
    r1 = body.let("r1", 1 / m[0])
    l21 = body.let("l21", m[3] * r1)
    l31 = body.let("l31", m[4] * r1)
    d2 = body.let("d2", m[1] - l21 * m[3])
    lib.guard(body, Not(d2 >= least), "NOT_POSITIVE_DEFINITE")
    r2 = body.let("r2", 1 / d2)
    rest = body.let("p32", m[5] - l31 * m[3])
    l32 = body.let("l32", rest * r2)
    d3 = body.let("d3", m[2] - l31 * m[4] - l32 * rest)
    lib.guard(body, Not(d3 >= least), "NOT_POSITIVE_DEFINITE")
    return {"r1": r1, "r2": r2, "d3": d3, "l21": l21, "l31": l31, "l32": l32}


def _solved3(body: Body, f: Mapping[str, Expr], x: Place) -> tuple[Expr, Expr, Expr]:
    """S y = x by the factors of S."""
    body.note("L z = b, then L^T y = D^-1 z")
    z2 = body.let("z2", x[1] - f["l21"] * x[0])
    y3 = body.let("y3", (x[2] - f["l31"] * x[0] - f["l32"] * z2) / f["d3"])
    y2 = body.let("y2", z2 * f["r2"] - f["l32"] * y3)
    return x[0] * f["r1"] - f["l21"] * y2 - f["l31"] * y3, y2, y3


def factor3(lib: Library) -> Function:
    """L D L^T of a symmetric positive definite 3x3 matrix: nothing is cubed, so that no size of stand overflows."""
    S = Argument("S", Kind.REAL, (6,), purpose="11 22 33 12 13 23")
    out = Argument("L", lib.layout.factors3, (), "out")
    body = Body()
    for name, value in _factors3(lib, body, S.place).items():
        body.set(out.place.member(name), value)
    function = body.checked_function(
        "factor3",
        "Factors a symmetric positive definite 3x3 matrix: S = L D L^T.",
        (S, out),
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )
    return replace(function, short=not lib.layout.added_mass)  # with added mass, compilers copy it unasked


def solve3(lib: Library) -> Function:
    """S y = b by the factors of S."""
    factor = Argument("L", lib.layout.factors3)
    b = Argument("b", Kind.REAL, (3,))
    y = Argument("y", Kind.REAL, (3,), "out", purpose="must not overlap b")
    body = Body()
    factors = {f.name: factor.place.member(f.name) for f in lib.layout.factors3.fields}
    for target, value in zip(y.place, _solved3(body, factors, b.place), strict=True):
        body.set(target, value)
    return replace(body.function("solve3", "Solves S y = b by S = L D L^T.", (factor, b, y)), short=True)


def factor_carrier(lib: Library) -> Function:
    """K with its translational block eliminated by its constant inverse: a 3x3 matrix is left, factored."""
    table = lib.table_argument()
    sums = Argument("sum", lib.layout.sums)
    out = Argument("K", lib.layout.carrier_factor, (), "out")
    added = lib.layout.added_mass
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place)
    if added:
        B = body.local("B", (9,), comment="<mu> + Lambda_21: lower left block of K")
        assign(body, list(B), derived.coupling_block(True), binding)
        binding |= {"B": B, "U": out.place.U}
        assign(body, list(out.place.U), derived.schur_coupling(True), binding)
    else:
        assign(body, list(out.place.rho), derived.centre_offset(), binding)
        binding["rho"] = out.place.rho
    S = body.local("S", (6,), comment="J - B A^-1 B^T" if added else "inertia about the mass centre")
    assign(body, list(S), derived.reduced_inertia(added), binding)
    lib.check(body, "factor3", S, out.place.L)
    return body.checked_function(
        "factor_carrier",
        "Factors K: its translational block is constant, so that a 3x3 matrix is left.",
        (table, sums, out),
        equation="(8)",
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )


def solve_carrier(lib: Library) -> Function:
    """K y = (f, n) by the factors of K."""
    table = lib.table_argument()
    factor = Argument("K", lib.layout.carrier_factor)
    F = Argument("F", Kind.REAL, (6,), "in", "N, N m")
    y = Argument("y", Kind.REAL, (6,), "out", "m/s2, rad/s2", "must not overlap F")
    added = lib.layout.added_mass
    body = Body()
    six = list(F.place)
    n = body.local("moment", (3,), comment="about the mass centre" if not added else "n - B A^-1 f")
    omega_dot = body.local("omega_dot", (3,))
    binding: dict[str, Any] = {"f": six[:3], "n": six[3:], "omega_dot": omega_dot}
    if added:
        binding |= {"A_inv": table.place.A_inv, "U": factor.place.U}
    else:
        binding |= {"m_inverse": table.place.mass_inverse, "rho": factor.place.rho}
    assign(body, list(n), derived.reduced_moment(added), binding)
    body.call(lib["solve3"], factor.place.L, n, omega_dot)
    out = list(y.place)
    assign(body, out[:3], derived.linear_part(added), binding)
    for target, value in zip(out[3:], omega_dot, strict=True):
        body.set(target, value)
    return body.function("solve_carrier", "Solves K y = F by the factors of K.", (table, factor, F, y), equation="(8)")


def solve_carrier_once(lib: Library) -> Function:
    """K y = (f, n) of a stand without added mass, where K is needed once: no factor goes through memory.

    Factors that are written and read at once take longer than their arithmetic. `y` is written last.
    """
    table = lib.table_argument()
    sums = Argument("sum", lib.layout.sums)
    F = Argument("F", Kind.REAL, (6,), "in", "N, N m")
    y = Argument("y", Kind.REAL, (6,), "out", "m/s2, rad/s2", "must not overlap F")
    six = list(F.place)
    body = Body()
    binding = carrier_binding(lib, table.place, sums.place) | {"f": six[:3], "n": six[3:]}
    rho = body.local("rho", (3,), comment="mass centre from O1, in E1")
    assign(body, list(rho), derived.centre_offset(), binding)
    binding["rho"] = rho
    S = body.local("S", (6,), comment="inertia about the mass centre")
    assign(body, list(S), derived.reduced_inertia(False), binding)
    factors = _factors3(lib, body, S)
    moment = body.local("moment", (3,), comment="about the mass centre")
    assign(body, list(moment), derived.reduced_moment(False), binding)
    y1, y2, y3 = _solved3(body, factors, moment)
    binding["omega_dot"] = [body.let("y1", y1), y2, y3]
    linear = [body.let(f"v{i + 1}_dot", translate(v, binding)) for i, v in enumerate(derived.linear_part(False))]
    for target, value in zip(y.place, (*linear, *binding["omega_dot"]), strict=True):
        body.set(target, value)
    return body.checked_function(
        "solve_carrier_once",
        "Solves K y = F where no other right-hand side follows: factors of K as factor_carrier finds them.",
        (table, sums, F, y),
        equation="(8)",
        statuses=("OK", "NOT_POSITIVE_DEFINITE"),
    )
