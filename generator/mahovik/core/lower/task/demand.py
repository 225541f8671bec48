"""The equation of a task, scaled: W y = r, y = Theta_ff^1/2 phi'', shared by its two functions.

With K = G G^T, X = G^-1 I D^-1 and x = G^-1 (b - K d), as `demand` has them for V* = 0, and Y = G^-1 S^T = Q R, the
norm is S K^-1 S^T = L L^T with L = R^T, and W = L^-1 S K^-1 I D^-1 = Q^T X, r = Q^T x + L^-1 (s - a): no inverse of K.
If only turning is demanded, the last three rows of all are enough, and their G is the factor of the inertia about the
mass centre (with added mass: of what eliminating v* leaves of it).
"""

from __future__ import annotations

from typing import Any

from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.formula.derived import carrier as derived
from mahovik.core.lower.flywheels import columns_of, let_turn, places_of
from mahovik.core.lower.forward import STATE_STATUSES, external_wrench, scene, sum_up
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import carrier_binding
from mahovik.core.lower.symbolic import assign
from mahovik.core.lower.task.rows import Rows
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, integer, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def demand_turning(lib: Library) -> Function:
    """U^-1 (moments of I), U^-1 (moment of b), U and D of the inertia U D U^T that is left when v* is eliminated."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    turns, wrench = lib.turn_arguments(), lib.wrench_arguments()
    work = Argument(
        "work", layout.inverse_work, (), "out", purpose="of G, W, r, sigma the first three rows are written"
    )
    w = work.place
    body = Body()
    seen = scene(lib, body, table.place, x.place, turns=places_of(turns))
    sum_up(lib, body, table.place, x.place, seen, None)
    F = body.local("F", (6,), comment="wrench (7); then b = F - M V_r - J phi'")
    external_wrench(lib, body, table.place, x.place, seen, wrench, F)
    body.call(lib["subtract_rates"], table.place, seen.sums, seen.V, F)
    binding = _reduce(body, carrier_binding(lib, table.place, seen.sums), layout.added_mass)
    S = body.local("S", (6,), comment="inertia left when v* is eliminated: about the mass centre")
    assign(body, list(S), derived.reduced_inertia(layout.added_mass), binding)
    factor3(lib, body, S, w)
    moment = body.local("moment", (3,), comment="of b, then of each column of I, when v* is eliminated")
    six = list(F)
    assign(body, list(moment), derived.reduced_moment(layout.added_mass), binding | {"f": six[:3], "n": six[3:]})
    substitute3(body, w.G, list(moment), list(w.r)[:3], "r")
    column = body.local("column", (6,), comment="I_s")
    with body.loop("s", layout.count) as s:
        row = table.place.flywheel[s]
        assign(body, list(column), derived_rows.columns().I, let_turn(body, seen.turns, s) | columns_of(row))
        six = list(column)
        assign(body, list(moment), derived.reduced_moment(layout.added_mass), binding | {"f": six[:3], "n": six[3:]})
        substitute3(body, w.G, list(moment), [w.W[i][s] for i in range(3)], "W")
    return body.checked_function(
        "demand_turning",
        "The turning part of (12) at omega* = 0: moments of I and of the right-hand side, by the inertia's factor U.",
        (table, x, *turns, *wrench, work),
        equation="(12)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _reduce(body: Body, binding: dict[str, Any], added: bool) -> dict[str, Any]:
    """The binding with what eliminating v* takes: B and U = A^-1 B^T with added mass, else rho."""
    if not added:
        rho = body.local("rho", (3,), comment="mass centre from O1, in E1")
        assign(body, list(rho), derived.centre_offset(), binding)
        return binding | {"rho": rho}
    B = body.local("B", (9,), comment="<mu> + Lambda_21: lower left block of K")
    U = body.local("U", (9,), comment="A^-1 B^T")
    assign(body, list(B), derived.coupling_block(True), binding)
    assign(body, list(U), derived.schur_coupling(True), binding | {"B": B})
    return binding | {"B": B, "U": U}


def factor3(lib: Library, body: Body, S: Place, w: Place) -> None:
    """S (11 22 33 12 13 23) = U D U^T, U unit lower triangular: U below the diagonal of G, D on it, D^-1 in sigma."""
    G, inverse = w.G, w.sigma

    def pivot(i: int, value: Expr) -> None:
        body.set(G[i][i], value)
        lib.guard(body, Not(G[i][i] > 0), "NOT_POSITIVE_DEFINITE")
        body.set(inverse[i], 1 / G[i][i])

    pivot(0, S[0])
    body.set(G[1][0], S[3] * inverse[0])
    body.set(G[2][0], S[4] * inverse[0])
    pivot(1, S[1] - G[1][0] * S[3])
    rest = body.let("rest", S[5] - G[2][0] * S[3])
    body.set(G[2][1], rest * inverse[1])
    pivot(2, S[2] - G[2][0] * S[4] - G[2][1] * rest)


def substitute3(body: Body, G: Place, given: list[Place], out: list[Place], name: str) -> None:
    """out = U^-1 given, three numbers."""
    second = body.let(f"{name}_2", given[1] - G[1][0] * given[0])
    body.set(out[0], given[0])
    body.set(out[1], second)
    body.set(out[2], given[2] - G[2][0] * given[0] - G[2][1] * second)


def scale_turning(lib: Library) -> Function:
    """The norms into what `demand_turning` gives: G = U D^1/2, W = D^-1/2 U^-1 (moments of I) Theta_ff^-1/2."""
    layout = lib.layout
    table = lib.table_argument()
    work = Argument("work", layout.inverse_work, (), "inout")
    w = work.place
    body = Body()
    with body.loop("s", layout.count) as s:
        body.set(w.scale[s], table.place.flywheel[s].spin_root_inv)
    with body.loop("i", 3) as i:
        root = body.let("root", lib["sqrt"](w.G[i][i]))
        body.set(w.G[i][i], root)
        with body.loop("k", 3, start=i + 1) as k:
            body.set(w.G[k][i], w.G[k][i] * root)
        body.set(w.r[i], w.r[i] / root)
        with body.loop("s", layout.count) as s:
            body.set(w.W[i][s], w.W[i][s] / root * w.scale[s])
    return body.function(
        "scale_turning",
        "Scales what demand_turning gives by the norms of inertia and spin inertias.",
        (table, work),
    )


def base_demand(
    lib: Library, body: Body, rows: Rows, place: dict[str, Place], turns: tuple[Place, ...], work: Place,
    *, scaled: bool = True
) -> None:  # fmt: skip
    """X, x and G of the rows that the task takes, into the work. `place`: of the arguments by name.

    `scaled`: also of turning, else as `demand_turning` gives them.
    """
    inputs = [place["wrench"]] if "wrench" in place else []
    if rows.turning:
        named = {"table": place["table"], "x": place["x"], "work": work} | dict(
            zip(("sine", "cosine"), turns, strict=True)
        )
        named |= {"wrench": place["wrench"]} if inputs else {}
        lib.check(body, "demand_turning", *lib.arguments_of("demand_turning", **named))
        if scaled:
            body.call(lib["scale_turning"], place["table"], work)
        return
    still = body.local("still", (6,), comment="V* = 0")
    for element in still:
        body.set(element, real(0))
    lib.check(body, "demand", place["table"], place["x"], *turns, still, *inputs, work)


def project(lib: Library, rows: Rows) -> Function:
    """W and r of the rows of a task that are demanded, from X and x."""
    layout, count, size = lib.layout, len(rows), rows.size
    table, x = lib.table_argument(), lib.state_argument()
    demand = Argument("demand", Kind.REAL, (count,), unit="m/s2, rad/s2", purpose="one a row")
    use = Argument("use", Kind.INT, (count,), purpose="0: the row is free")
    work = Argument("work", layout.inverse_work, (), "inout", purpose="in: X, x as W, r, and G; out: W, r")
    L = Argument("L", Kind.REAL, (count, count), "out", purpose="lower triangle, L L^T = S K^-1 S^T")
    w, l = work.place, L.place
    body = Body()
    Y = body.local("Y", (count, size), comment="rows: columns of G^-1 S^T, then of Q")
    known = body.local("known", (count,), comment="s - a, then L^-1 (s - a)")
    for number, value in enumerate(rows.known_terms(body, table.place, x.place.V)):
        body.set(known[number], value - demand.place[number])
    rows.fill(body, table.place, Y)
    with body.loop("j", count) as j:
        body.note("forward substitution; then orthogonal to the rows before, twice, so that no digit is lost")
        with body.loop("i", size) as i:
            rest = body.local("rest")
            body.set(rest, select(use.place[j] > 0, Y[j][i], real(0)))
            with body.loop("k", i) as k:
                body.add(rest, -(w.G[i][k] * Y[j][k]))
            body.set(Y[j][i], rest / w.G[i][i])
        with body.loop("i", j) as i:
            body.set(l[j][i], real(0))
        with body.loop("pass", 2), body.loop("i", j) as i:
            along = body.local("along")
            body.set(along, real(0))
            with body.loop("k", size) as k:
                body.add(along, Y[i][k] * Y[j][k])
            with body.loop("k", size) as k:
                body.add(Y[j][k], -(along * Y[i][k]))
            body.add(l[j][i], along)
        square = body.local("square")
        body.set(square, real(0))
        with body.loop("k", size) as k:
            body.add(square, Y[j][k] * Y[j][k])
        length = body.let("length", lib["sqrt"](square))
        body.set(l[j][j], select(length > 0, length, real(1)), "a free row demands nothing")
        with body.loop("k", size) as k:
            body.set(Y[j][k], Y[j][k] / l[j][j])
        left = body.local("left", comment="of L known = s - a")
        body.set(left, select(use.place[j] > 0, known[j], real(0)))
        with body.loop("i", j) as i:
            body.add(left, -(l[j][i] * known[i]))
        body.set(known[j], left / l[j][j])
    kept = body.local("kept", (size,))
    body.note("W = Q^T X, r = Q^T x + L^-1 (s - a)")
    with body.loop("s", layout.count) as s:
        with body.loop("i", size) as i:
            body.set(kept[i], w.W[i][s])
        with body.loop("j", count) as j:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("i", size) as i:
                body.add(total, Y[j][i] * kept[i])
            body.set(w.W[j][s], total)
    with body.loop("i", size) as i:
        body.set(kept[i], w.r[i])
    with body.loop("j", count) as j:
        total = body.local("total")
        body.set(total, known[j])
        with body.loop("i", size) as i:
            body.add(total, Y[j][i] * kept[i])
        body.set(w.r[j], total)
    return body.function(
        f"project_{rows.task.name}",
        f"Matrix and right-hand side of the rows of the task {rows.task.name} that are demanded, scaled.",
        (table, x, demand, use, work, L),
    )


def demanded_rows(body: Body, use: Place) -> Place:
    """Number of rows that are not free."""
    found = body.local("demanded", (), Kind.INT, comment="rows that are not free")
    body.set(found, integer(0))
    with body.loop("j", len(use)) as j, body.when(use[j] > 0):
        body.set(found, found + 1)
    return found
