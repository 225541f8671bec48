"""inverse (12) of a held carrier, for wanted rates of its m freedoms, with diagnostics; `inverse_fast` beside it.

S^T I phi'' = S^T (F - K V_r* - M V_r - J phi') with V* = S u*, by the singular values of G^-1 S^T I Theta_ff^-1/2,
G G^T = S^T K S. The steps are those of `inverse`.
"""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.formula.derived import accumulate as derived_rows
from mahovik.core.lower import allocate, excess
from mahovik.core.lower.demand import ANSWER_NOTE, begin_demand, check_answer, check_demand
from mahovik.core.lower.flywheels import columns_of, let_turn, named_turns, places_of, turns_of
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.freedoms import columns, place_of
from mahovik.core.lower.hold import write_twist
from mahovik.core.lower.inverse import POSITIVE, check_flywheels, choose_rank, flag, hardest, sort
from mahovik.core.lower.inverse_fast import inverse_fast
from mahovik.core.lower.library import Library
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert, Expr, Not, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.program.vector import dot
from mahovik.core.routines.jacobi import name_for_rows


def add_inverse(lib: Library) -> None:
    """Adds `inverse` and `inverse_fast` of a held carrier that has freedoms and flywheels."""
    layout, rows = lib.layout, lib.layout.freedoms
    lib.add(routines.orthogonalise(layout.inverse_work, layout.count, lib["sqrt"], layout.precision.name, rows))
    lib.add(_demand(lib))
    lib.add(allocate.solve_gram(lib, rows))
    lib.add(allocate.allocate(lib, rows))
    lib.add(excess.motor_lacks(lib))
    lib.add(excess.excessive(lib))
    lib.add(_inverse(lib))
    lib.add(inverse_fast(lib))


def _demand(lib: Library) -> Function:
    """Everything of (12) along the freedoms at a state: G, S^T I, b, W, r."""
    layout, m, body = lib.layout, lib.layout.freedoms, Body()
    begun = begin_demand(lib, body)
    table, w, seen, moving, F = begun.table, begun.work, begun.seen, begun.moving, begun.F
    missing = body.local("missing", (6,), comment="K V* - F: what flywheels and hold must give")
    body.call(lib["react"], table, seen.sums, moving, F, missing)
    found = columns(layout.ways, table)
    for k in range(m):
        body.set(w.b[k], -dot(found[k], list(missing)))
        body.set(w.r[k], w.b[k])
    P = body.local("P", (place_of(m, 0),), comment="S^T K S")
    body.call(lib["project_mass"], table, seen.sums, P)
    _factor(lib, body, P, w)
    with body.loop("s", layout.count) as s:
        turn = let_turn(body, seen.turns, s)
        row = table.flywheel[s]
        scale = body.let("scale", table.flywheel[s].spin_root_inv)
        body.set(w.scale[s], scale)
        coupling = body.local("coupling", (6,), comment="column of I")
        assign(body, list(coupling), derived_rows.columns().I, turn | columns_of(row))
        for k in range(m):
            body.set(w.I[k][s], dot(found[k], list(coupling)))
            rest: Expr = w.I[k][s] * scale
            for j in range(k):
                rest = rest - w.G[k][j] * w.W[j][s]
            body.set(w.W[k][s], rest / w.G[k][k])
    for k in range(m):
        rest = w.r[k]
        for j in range(k):
            rest = rest - w.G[k][j] * w.r[j]
        body.set(w.r[k], rest / w.G[k][k])
    return body.checked_function(
        "demand",
        "Matrix and right-hand side of (12) along the freedoms: S^T I, S^T b, and both scaled to W, r.",
        begun.arguments,
        equation="(12)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _factor(lib: Library, body: Body, P: Place, w: Place) -> None:
    """P = G G^T."""
    m, G = lib.layout.freedoms, w.G
    for j in range(m):
        pivot: Expr = P[place_of(j, j)]
        for k in range(j):
            pivot = pivot - G[j][k] * G[j][k]
        left = body.let(f"pivot{j + 1}", pivot)
        lib.guard(body, Not(left > 0), "NOT_POSITIVE_DEFINITE")
        body.set(G[j][j], lib["sqrt"](left))
        for i in range(j + 1, m):
            rest: Expr = P[place_of(i, j)]
            for k in range(j):
                rest = rest - G[i][k] * G[j][k]
            body.set(G[i][j], rest / G[j][j])


def _inverse(lib: Library) -> Function:
    """phi'' for wanted rates of the freedoms, with diagnostics."""
    layout, m = lib.layout, lib.layout.freedoms
    least = min(m, int(layout.count))
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted, S u_dot")
    purpose = "weights, limits, damping; default_options holds those of the stand file"
    options = Argument("options", layout.inverse_options, purpose=purpose)
    wrench = lib.wrench_arguments()
    out = Argument("out", layout.inverse_result, (), "out", purpose="phi_ddot and its quality")
    o, p = out.place, options.place
    body = Body()
    check_demand(lib, body, table, x, V_dot, p, ("near_singular", "damping"), wrench)
    check_flywheels(lib, body, p)
    work = body.local("work", (), layout.inverse_work)
    answer = body.local("answer", (layout.count,), comment="phi''")
    limited = body.local("limited", (layout.count,), Kind.INT)
    turns = turns_of(lib, body, x.place)
    lib.check(body, "demand", table.place, x.place, *turns, V_dot.place, *places_of(wrench), work)
    wanted = body.local("wanted")
    body.set(wanted, real(0))
    for k in range(m):
        body.add(wanted, work.r[k] * work.r[k])
    body.call(lib[name_for_rows("orthogonalise", m)], work)
    sort(body, work, m)
    flags, rank = body.local("flags", (), Kind.INT), body.local("rank", (), Kind.INT)
    damped = body.local("damping")
    body.set(flags, integer(0))
    choose_rank(lib, body, p, work, rank, damped, flags, m)
    body.call(lib[name_for_rows("allocate", m)], work, p, rank, answer, limited)
    with body.loop("s", layout.count) as s, body.when(limited[s] > 0):
        body.set(flags, flag(flags, "LIMITED"))
    with body.when(rank < least):
        body.set(flags, flag(flags, "RANK_DEFICIENT"))
    residual = _residual(lib, body, answer, work, wanted, flags)
    check_answer(lib, body, answer, layout.count)
    check_answer(lib, body, residual, m)
    moved = body.local("moved", (6,), comment="V* that results, by (8)")
    named = {"table": table.place, "x": x.place, "V_dot": moved, "phi_ddot": answer}
    named |= named_turns(turns) | {w.name: w.place for w in wrench}
    rates = {"u_dot": body.local("rates", (m,))}
    lib.check(body, "accelerate", *lib.arguments_of("accelerate", **named, **rates))
    write_twist.put_into(body, lib, table.place, list(rates.values()), moved)
    lacking = body.local("lacking", (), Kind.INT)
    body.call(lib["excessive"], *lib.arguments_of("excessive", **named, options=p, flags=lacking))
    body.set(flags, flags | lacking)
    with body.loop("s", layout.count) as s:
        body.set(o.phi_ddot[s], answer[s])
        body.set(o.limited[s], limited[s])
    body.copy_array(o.residual, residual)
    hardest(lib, body, o.hardest, work, rank, work.G, m - 1, m)
    body.set(o.rank, rank)
    body.set(o.damped_by, damped)
    for k in range(least):
        body.set(o.sigma[k], work.sigma[k])
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        "inverse",
        "Flywheel accelerations for wanted rates of the freedoms: S^T I phi'' = S^T (F - K V* - M V - J phi'). "
        "Least residual in the norm of (S^T K S)^-1, then least weighted norm of phi''. What a flywheel at its limit "
        "cannot give is shared among the others.",
        (table, x, V_dot, options, *wrench, out),
        body.statements,
        equation="(12)",
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", *POSITIVE),
        notes=("Positive statuses are bits and may be combined.", ANSWER_NOTE),
        public=True,
    )


def _residual(lib: Library, body: Body, phi_ddot: Place, work: Place, wanted: Place, flags: Place) -> Place:
    """b - S^T I phi'' (m), and UNREACHABLE by its scaled size against the demand."""
    m = lib.layout.freedoms
    residual = body.local("residual", (m,))
    z = body.local("z", (m,), comment="G^-1 residual")
    left = body.local("left")
    body.set(left, real(0))
    for i in range(m):
        body.set(residual[i], work.b[i])
        with body.loop("s", lib.layout.count) as s:
            body.add(residual[i], -(work.I[i][s] * phi_ddot[s]))
        rest: Expr = residual[i]
        for k in range(i):
            rest = rest - work.G[i][k] * z[k]
        body.set(z[i], rest / work.G[i][i])
        body.add(left, z[i] * z[i])
    tolerance = lib.thresholds.unreachable
    with body.when(left > tolerance * tolerance * wanted):
        body.set(flags, flag(flags, "UNREACHABLE"))
    return residual
