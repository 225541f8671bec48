"""inverse (12): flywheel accelerations for a wanted motion of the carrier, with diagnostics.

W y = r of `demand` by singular values: least |r - W y| first, then least weighted norm of phi'' = D^-1 y within the
limits (`allocate`). Singular values, rank and what they say are those of the stand, whatever the weights.
"""

from __future__ import annotations

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import check_abilities, check_friction
from mahovik.core.lower.flywheels import named_turns, turns_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Const,
    Convert,
    Expr,
    Not,
    Operand,
    Place,
    Status,
    integer,
    or_,
    real,
    select,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind

POSITIVE = ("NEAR_SINGULAR", "DAMPED", "LIMITED", "UNREACHABLE", "RANK_DEFICIENT", "EXCESSIVE")


def check_flywheels(lib: Library, body: Body, p: Place) -> None:
    """Check the options of each flywheel: limit, motor, friction."""
    with body.loop("s", lib.layout.count) as s:
        lib.guard(body, Not(or_(p.limit[s] > 0, p.limit[s] <= 0)), "NOT_FINITE")
        lib.guard(body, p.limit[s] <= 0, "BAD_ARGUMENT")
        check_abilities(lib, body, p, s)
        check_friction(lib, body, p, s)


def inverse(lib: Library) -> Function:
    """phi'' for a wanted V*, with diagnostics."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted derivative of the components of V")
    options = Argument(
        "options",
        layout.inverse_options,
        purpose="weights, limits, damping; default_options holds those of the stand file",
    )
    wrench = lib.wrench_arguments()
    out = Argument("out", layout.inverse_result, (), "out", purpose="phi_ddot and its quality")
    o, p = out.place, options.place
    body = Body()
    check_demand(lib, body, table, x, V_dot, p, ("near_singular", "damping"), wrench)
    check_flywheels(lib, body, p)
    work = body.local("work", (), layout.inverse_work)
    answer = body.local("answer", (layout.count,), comment="phi''")
    limited = body.local("limited", (layout.count,), Kind.INT)
    residual = body.local("residual", (6,))
    inputs = [w.place for w in wrench]
    turns = turns_of(lib, body, x.place)
    lib.check(body, "demand", table.place, x.place, *turns, V_dot.place, *inputs, work)
    wanted = body.local("wanted")
    body.set(wanted, real(0))
    with body.loop("i", 6) as i:
        body.add(wanted, work.r[i] * work.r[i])
    body.call(lib["orthogonalise"], work)
    sort(body, work)
    flags = body.local("flags", (), Kind.INT)
    rank = body.local("rank", (), Kind.INT)
    damped = body.local("damping")
    body.set(flags, integer(0))
    choose_rank(lib, body, p, work, rank, damped, flags)
    body.call(lib["allocate"], work, p, rank, answer, limited)
    with body.loop("s", layout.count) as s, body.when(limited[s] > 0):
        body.set(flags, flag(flags, "LIMITED"))
    with body.when(rank < min(6, int(layout.count))):
        body.set(flags, flag(flags, "RANK_DEFICIENT"))
    moved = body.local("moved", (6,), comment="V* that results: V_dot + K^-1 residual")
    _residual(lib, body, answer, residual, work, wanted, flags, V_dot.place, moved)
    check_answer(lib, body, answer, layout.count)
    check_answer(lib, body, residual, 6)
    lacking = body.local("lacking", (), Kind.INT)
    named = {"table": table.place, "x": x.place, "V_dot": moved, "phi_ddot": answer, "options": p, "flags": lacking}
    named |= named_turns(turns) | {w.name: w.place for w in wrench}
    body.call(lib["excessive"], *lib.arguments_of("excessive", **named))
    body.set(flags, flags | lacking)
    with body.loop("s", layout.count) as s:
        body.set(o.phi_ddot[s], answer[s])
        body.set(o.limited[s], limited[s])
    with body.loop("i", 6) as i:
        body.set(o.residual[i], residual[i])
    hardest(lib, body, o.hardest, work, rank, work.G)
    body.set(o.rank, rank)
    body.set(o.damped_by, damped)
    with body.loop("i", min(6, int(layout.count))) as i:
        body.set(o.sigma[i], work.sigma[i])
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        "inverse",
        "Flywheel accelerations for a wanted motion of the carrier: I phi'' = F - K V* - M V - J phi'. "
        "Least residual in the norm of K^-1, then least weighted norm of phi''. What a flywheel at its limit "
        "cannot give is shared among the others.",
        (table, x, V_dot, options, *wrench, out),
        body.statements,
        equation="(12)",
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", *POSITIVE),
        notes=("Positive statuses are bits and may be combined.", ANSWER_NOTE),
        public=True,
    )


def inverse_alone(lib: Library) -> Function:
    """`inverse` of a stand without flywheels: no phi'', and all of the demand is left over."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted derivative of the components of V")
    wrench = lib.wrench_arguments()
    out = Argument("out", layout.inverse_result, (), "out", purpose="the wrench that is missing")
    o = out.place
    body = Body()
    check_inputs(lib, body, table, x, (), wrench)
    lib.check(body, "within", V_dot.place, 6, lib.limits["MAX_ACCELERATION"].expression)
    work = body.local("work", (), layout.inverse_work)
    lib.check(body, "demand", table.place, x.place, V_dot.place, *(w.place for w in wrench), work)
    square = body.local("square")
    body.set(square, real(0))
    with body.loop("i", 6) as i:
        body.add(square, work.r[i] * work.r[i])
    wanted = body.let("wanted", square > 0)
    with body.when(Not(wanted)):
        body.note("nothing is demanded: any direction is as hard as another")
        body.set(work.r[5], real(1))
        body.set(square, real(1))
    length = body.let("length", lib["sqrt"](square))
    with body.loop("i", 6) as i:
        body.set(o.residual[i], work.b[i])
        body.set(o.hardest[i], real(0))
        with body.loop("k", i + 1) as k:
            body.add(o.hardest[i], work.G[i][k] * (work.r[k] / length))
    body.set(o.rank, integer(0))
    body.set(o.damped_by, real(0))
    with body.when(wanted):
        body.ret(Status("UNREACHABLE"))
    return body.checked_function(
        "inverse",
        "The wrench that a wanted motion of the carrier needs and no flywheel gives: F - K V* - M V.",
        (table, x, V_dot, *wrench, out),
        equation="(12)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "UNREACHABLE"),
        notes=("UNREACHABLE unless this wrench is zero.",),
        public=True,
    )


def flag(flags: Place, name: str) -> Expr:
    """flags with the bit of a status."""
    return flags | Const(STATUS_VALUES[name], Kind.INT, name)


def sort(body: Body, work: Place, rows: int = 6) -> None:
    """Descending singular values: the order of the rows, by exchanging neighbours a fixed number of times."""
    body.note("sort the singular values in descending order, by exchanging neighbours")
    with body.loop("pass", rows - 1), body.loop("i", rows - 1) as i, body.when(work.sigma[i] < work.sigma[i + 1]):
        for member in ("sigma", "r"):
            values = work.member(member)
            kept = body.let(f"kept_{member}", values[i])
            body.set(values[i], values[i + 1])
            body.set(values[i + 1], kept)
        for member, length, by_column in (("W", work.W.shape[1], False), ("U", rows, True)):
            m = work.member(member)
            with body.loop("j", length) as j:
                one, two = (m[j][i], m[j][i + 1]) if by_column else (m[i][j], m[i + 1][j])
                kept = body.let("kept", one)
                body.set(one, two)
                body.set(two, kept)


def choose_rank(
    lib: Library, body: Body, p: Place, work: Place, rank: Place, damped: Place, flags: Place, rows: int = 6
) -> None:
    """Choose the rows used, and damp near-singular ones: r sigma^2 / (sigma^2 + lambda^2).

    The only row of a held carrier has the largest singular value, and `near_singular` is at most 1: never damped.
    """
    first = work.sigma[0]
    body.set(rank, integer(0))
    body.set(damped, real(0))
    if rows == 1 and lib.layout.held:
        with body.when(first > 0):
            body.set(rank, integer(1))
        return
    with body.loop("i", rows) as i, body.when(work.sigma[i] > lib.thresholds.rank * first):
        body.set(rank, rank + 1)
        ratio = body.let("ratio", work.sigma[i] / first)
        with body.when(ratio < p.near_singular):
            body.set(flags, flag(flags, "NEAR_SINGULAR"))
            with body.when(p.damping > 0):
                body.set(flags, flag(flags, "DAMPED"))
                share = body.let("lambda", p.damping * first * (1 - ratio / p.near_singular))
                square = body.let("square", work.sigma[i] * work.sigma[i])
                body.set(work.r[i], work.r[i] * (square / (square + share * share)))
                body.set(damped, select(share > damped, share, damped))


def _residual(
    lib: Library, body: Body, phi_ddot: Place, residual: Place, work: Place, wanted: Place, flags: Place,
    V_dot: Place, moved: Place
) -> None:  # fmt: skip
    """b - I phi'', its scaled size against the demand, and the motion that results."""
    left = body.local("left")
    z = body.local("z", (6,), comment="G^-1 residual")
    body.set(left, real(0))
    with body.loop("i", 6) as i:
        body.set(residual[i], work.b[i])
        with body.loop("s", lib.layout.count) as s:
            body.add(residual[i], -(work.I[i][s] * phi_ddot[s]))
    with body.loop("i", 6) as i:
        body.set(z[i], residual[i])
        with body.loop("k", i) as k:
            body.add(z[i], -(work.G[i][k] * z[k]))
        body.set(z[i], z[i] / work.G[i][i])
        body.add(left, z[i] * z[i])
    tolerance = lib.thresholds.unreachable
    with body.when(left > tolerance * tolerance * wanted):
        body.set(flags, flag(flags, "UNREACHABLE"))
    with body.loop("t", 6) as t:
        i_ = body.let("i", integer(5) - t)
        with body.loop("k", 6, start=i_ + 1) as k:
            body.add(z[i_], -(work.G[k][i_] * z[k]))
        body.set(z[i_], z[i_] / work.G[i_][i_])
        body.set(moved[i_], V_dot[i_] + z[i_])


def hardest(
    lib: Library, body: Body, out: Place, work: Place, rank: Place, factor: Place, last: Operand = 5, rows: int = 6
) -> None:
    """The part of the demand in rows left out, or the row `last` of the least singular value, by a factor of its norm.

    By that of K it is a wrench, by that of G of a task components of its demand.
    """
    body.note("unreachable: the demand's part in the rows left out; if no row is left out, the last row")
    part = body.local("part", (rows,))
    with body.loop("i", rows) as i:
        body.set(part[i], select(i < rank, real(0), work.r[i]))
    largest = body.local("largest")
    body.set(largest, real(0))
    with body.loop("i", rows) as i:
        size = body.let("size", select(part[i] < 0, -part[i], part[i]))
        body.set(largest, select(size > largest, size, largest))
    with body.when(Not(largest > 0)):
        body.set(part[last], real(1))
        body.set(largest, real(1))
    square = body.local("square")
    body.set(square, real(0))
    with body.loop("i", rows) as i:
        body.set(part[i], part[i] / largest)
        body.add(square, part[i] * part[i])
    length = body.let("length", lib["sqrt"](square))
    u = body.local("u", (rows,), comment="U part: a unit vector in the norm of K^-1; its wrench is G u")
    with body.loop("k", rows) as k:
        body.set(u[k], real(0))
        with body.loop("i", rows) as i:
            body.add(u[k], work.U[k][i] * part[i])
        body.set(u[k], u[k] / length)
    with body.loop("i", rows) as i:
        body.set(out[i], real(0))
        with body.loop("k", i + 1) as k:
            body.add(out[i], factor[i][k] * u[k])
