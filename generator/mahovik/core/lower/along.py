"""(8) along the freedoms without six rows, for freedoms whose brackets are freedoms: P u* = S^T F - P* u - ...

S is constant in E1, so S^T K S and S^T I_s have the harmonics of K and I_s, projected once by `prepare`:
  P(phi) u* = S^T F - P* u - d/dt (S^T I_s phi') - S^T Phi(V) Z,  V = S u,
the last term by the m momenta S^T Z = P u + S^T sum I_s phi'. It is zero for one freedom.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import hold as derived
from mahovik.core.formula.derived import omitting
from mahovik.core.lower.flywheels import Turns, let_turn, let_weights, named_turns, places_of
from mahovik.core.lower.freedoms import columns, dot, element, momenta_needed, place_of, speeds, turning_force
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign, translate
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Place, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def add_all(lib: Library) -> None:
    """Adds the sums along the freedoms, and the right-hand side."""
    lib.add(sum_along(lib))
    lib.add(sum_along(lib, steady=True))
    lib.add(right_side(lib))


def sum_along(lib: Library, steady: bool = False) -> Function:
    """Sums over all bodies, projected to the freedoms; `steady`: at constant speeds."""
    layout, m = lib.layout, lib.layout.freedoms
    table, turns = lib.table_argument(), lib.turn_arguments()
    phi_dot = Argument("phi_dot", Kind.REAL, (layout.count,), unit="rad/s")
    phi_ddot = () if steady else (Argument("phi_ddot", Kind.REAL, (layout.count,), unit="rad/s2"),)
    whole = Argument("whole", layout.sums, (), "inout", purpose="its first moment mu is set")
    mu = whole.place.mu
    sums = Argument("sum", layout.along_sums, (), "out")
    weights: tuple[str, ...] = ("c2", "s2", "dc", "ds", "dc2", "ds2", "ddc", "dds")
    parts, body, momenta = derived_rows.sums(), Body(), momenta_needed(layout.ways)
    if layout.weight:
        body.copy_array(mu, table.place.first_moment)
    body.copy_array(sums.place.P, table.place.P_0)
    for name in ("P_dot", "g", *(("h",) if momenta else ())):
        for each in sums.place.member(name):
            body.set(each, real(0))
    with body.loop("k", layout.count) as k:
        given: dict[str, Expr] = dict(let_turn(body, places_of(turns), k, ""))
        given["phi_dot"] = body.let("w", phi_dot.place[k])
        for acceleration in phi_ddot:
            given["phi_ddot"] = body.let("a", acceleration.place[k])
        row = table.place.flywheel[k]
        bound: dict[str, Any] = dict(let_weights(body, given, weights))
        if layout.weight:
            body.note("first moment")
            columns_of_mu = {"mu_c": row.mu_c, "mu_s": row.mu_s}
            assign(body, list(mu), parts.mu, bound | columns_of_mu, add=True)
        body.note("mass matrix along the freedoms and its rate")
        for i in range(place_of(m, 0)):
            here = bound | {f"J_{n}": [row.member(f"P_{n}")[i]] for n in ("c", "s", "2c", "2s")}
            body.add(sums.place.P[i], translate(parts.J[0], here))
            body.add(sums.place.P_dot[i], translate(parts.J_dot[0], here))
        body.note("I phi' along the freedoms, and its rate" if momenta else "rate of I phi' along the freedoms")
        for i in range(m):
            here = bound | {f"t_{n}": [row.member(f"I_{n}")[i]] for n in ("0", "c", "s")}
            if momenta:
                body.add(sums.place.h[i], translate(parts.h_rel[0], here))
            rate = omitting(parts.g_rel[0], "phi_ddot") if steady else parts.g_rel[0]
            body.add(sums.place.g[i], translate(rate, here))
    return body.function(
        "sum_steady_along" if steady else "sum_along",
        "Mass matrix of all bodies along the freedoms, and the flywheels' terms; w = phi'"
        + (" is constant." if steady else ", a = phi''."),
        (table, *turns, phi_dot, *phi_ddot, whole, sums),
        equation="(2), (5), (6)",
    )


def right_side(lib: Library) -> Function:
    """The right-hand side along the freedoms, of the wrench (7)."""
    layout, m, ways = lib.layout, lib.layout.freedoms, lib.layout.ways
    table, sums = lib.table_argument(), Argument("sum", layout.along_sums)
    V = Argument("V", Kind.REAL, (6,), purpose="twist of the carrier, S u")
    F = Argument("F", Kind.REAL, (6,), unit="N, N m", purpose="wrench (7)")
    y = Argument("y", Kind.REAL, (m,), "out", "SI")
    body = Body()
    found = columns(ways, table.place)
    u = body.local("u", (m,), comment="speeds of the freedoms")
    for k, speed in enumerate(speeds(ways, found, V.place)):
        body.set(u[k], speed)
    momentum: dict[str, Expr] = {}
    for way in momenta_needed(ways):
        k = ways.index(way)
        total: Expr = sums.place.h[k]
        for j in range(m):
            total = total + element(sums.place.P, k, j) * u[j]
        momentum[way] = body.let(f"momentum_{way}", total)
    for k, force in enumerate(turning_force(ways, u, momentum)):
        rest: Expr = dot(found[k], list(F.place)) - sums.place.g[k]
        for j in range(m):
            rest = rest - element(sums.place.P_dot, k, j) * u[j]
        body.set(y.place[k], rest if force is None else rest + force)
    return body.function(
        "right_side",
        "Right-hand side of (8) along the freedoms: S^T (F - Phi Z - K* V) - the flywheels' terms",
        (table, sums, V, F, y),
        equation="(2), (4), (5)",
    )


def project_harmonic(lib: Library) -> Function:
    """S^T K S of one harmonic."""
    table = lib.table_argument()
    mu = Argument("mu", Kind.REAL, (3,), unit="kg m")
    J = Argument("J", Kind.REAL, (6,), unit="kg m2")
    P = Argument("P", Kind.REAL, (place_of(lib.layout.freedoms, 0),), "out", "SI", "lower triangle, row by row")
    body, found = Body(), columns(lib.layout.ways, table.place)
    moved = body.local("moved", (6,), comment="the harmonic times a column of S")
    for j in range(len(found)):
        six = [table.place.S[i][j] for i in range(6)]
        assign(body, list(moved), derived.harmonic_times(), {"mu": mu.place, "J": J.place, "twist": six})
        for i in range(j, len(found)):
            body.set(P.place[place_of(i, j)], dot(found[i], list(moved)))
    return body.function("project_harmonic", "S^T K S of one harmonic of a flywheel.", (table, mu, J, P))


def prepare_row(lib: Library, body: Body, table: Place, row: Place) -> None:
    """The columns of a row along the freedoms, of its others."""
    body.note("along the freedoms: S^T K S and S^T I")
    none = body.local("none", (3,), comment="no first moment has harmonics of the double phase")
    for each in none:
        body.set(each, real(0))
    for name, mu in (("c", row.mu_c), ("s", row.mu_s), ("2c", none), ("2s", none)):
        body.call(lib["project_harmonic"], table, mu, row.member(f"J_{name}"), row.member(f"P_{name}"))
    # the force part of I_s is mu' = mu_s c - mu_c s
    forces: dict[str, Sequence[Expr]] = {
        "0": list(none),
        "c": list(row.mu_s),
        "s": [-each for each in row.mu_c],
    }
    for name, force in forces.items():
        for k, column in enumerate(columns(lib.layout.ways, table)):
            body.set(row.member(f"I_{name}")[k], dot(column, [*force, *row.member(f"t_{name}")]))


def prepare_constant(lib: Library, body: Body, table: Place) -> None:
    """S^T K S of what no phase changes, into P_0 of the table."""
    body.note("mass matrix along the freedoms, constant part")
    sums = body.local("constant", (), lib.layout.sums, "first moment and inertia alone")
    body.copy_array(sums.mu, table.first_moment)
    body.copy_array(sums.J, table.inertia)
    body.call(lib["project_mass"], table, sums, table.P_0)


def sum_up_along(
    lib: Library, body: Body, table: Place, x: Place, turns: Turns, phi_ddot: Place | None, whole: Place
) -> Place:
    """The sums along the freedoms; without phi_ddot at constant speeds. `whole` gets the moment for the weight."""
    sums = body.local("along", (), lib.layout.along_sums, "sums along the freedoms")
    named: dict[str, Any] = {"table": table, "phi_dot": x.phi_dot, "phi_ddot": phi_ddot, "whole": whole, "sum": sums}
    named |= named_turns(turns)
    name = "sum_along" if phi_ddot is not None else "sum_steady_along"
    body.call(lib[name], *lib.arguments_of(name, **named))
    return sums
