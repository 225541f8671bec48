"""inverse_TASK: flywheel accelerations for chosen components of the carrier's motion, with diagnostics.

The same steps as of `inverse`, on the rows of the task that are demanded; what no row names is found by (8).
"""

from __future__ import annotations

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import check_abilities, check_friction
from mahovik.core.lower.flywheels import named_turns, turns_of
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.inverse import POSITIVE, choose_rank, flag, hardest, sort
from mahovik.core.lower.library import Library
from mahovik.core.lower.task.demand import base_demand, demanded_rows
from mahovik.core.lower.task.rows import Rows
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert, Not, Place, and_, integer, or_, real, select
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.jacobi import name_for_rows

FREE_NOTE = "A row is free where its flag in the options is 0; its demand must be a number nevertheless."


def task_arguments(lib: Library, rows: Rows) -> tuple[Argument, ...]:
    """table, x, demand, options, run-time wrenches."""
    names = ", ".join(f"{row.of}.{row.component}" if row.of else row.component for row in rows.task.rows)
    return (
        lib.table_argument(),
        lib.state_argument(),
        Argument("demand", Kind.REAL, (len(rows),), unit="m/s2, rad/s2", purpose=f"wanted: {names}"),
        Argument(
            "options",
            lib.layout.inverse_options,
            purpose="weights, limits, damping, rows; default_options holds those of the stand file",
        ),
        *lib.wrench_arguments(),
    )


def inverse_task(lib: Library, rows: Rows) -> Function:
    """phi'' for the demand of a task, with diagnostics."""
    layout, m, name = lib.layout, len(rows), rows.task.name
    arguments = task_arguments(lib, rows)
    table, x, demand, options, *wrench = arguments
    out = Argument("out", layout.task_result(rows.task), (), "out", purpose="phi_ddot, the motion and its quality")
    o, p = out.place, options.place
    use = p.member(f"use_{name}")
    place = {a.name: a.place for a in arguments}
    body = Body()
    check_demand(lib, body, table, x, demand, p, ("near_singular", "damping"), tuple(wrench))
    with body.loop("s", layout.count) as s:
        lib.guard(body, Not(or_(p.limit[s] > 0, p.limit[s] <= 0)), "NOT_FINITE")
        lib.guard(body, p.limit[s] <= 0, "BAD_ARGUMENT")
        check_abilities(lib, body, p, s)
        check_friction(lib, body, p, s)
    work = body.local("work", (), layout.inverse_work)
    L = body.local("L", (m, m), comment="factor of the norm of the demand")
    answer = body.local("answer", (layout.count,), comment="phi''")
    limited = body.local("limited", (layout.count,), Kind.INT)
    turns = turns_of(lib, body, x.place)
    base_demand(lib, body, rows, place, turns, work)
    project = f"project_{name}"
    body.call(lib[project], *lib.arguments_of(project, **place, use=use, work=work, L=L))
    demanded = demanded_rows(body, use)
    wanted = body.local("wanted")
    body.set(wanted, real(0))
    with body.loop("i", m) as i:
        body.add(wanted, work.r[i] * work.r[i])
    body.call(lib[name_for_rows("orthogonalise", m)], work)
    sort(body, work, m)
    asked = body.local("asked", (m,), comment="the demand in these rows, before damping")
    with body.loop("i", m) as i:
        body.set(asked[i], work.r[i])
    flags = body.local("flags", (), Kind.INT)
    rank = body.local("rank", (), Kind.INT)
    damped = body.local("damping")
    body.set(flags, integer(0))
    choose_rank(lib, body, p, work, rank, damped, flags, m)
    body.call(lib[name_for_rows("allocate", m)], work, p, rank, answer, limited)
    with body.loop("s", layout.count) as s, body.when(limited[s] > 0):
        body.set(flags, flag(flags, "LIMITED"))
    with body.when(and_(rank < demanded, rank < integer(int(layout.count)))):
        body.set(flags, flag(flags, "RANK_DEFICIENT"))
    _unreachable(lib, body, work, asked, answer, wanted, flags, m)
    check_answer(lib, body, answer, layout.count)
    moved = body.local("moved", (6,), comment="V* that results, by (8)")
    named = {"table": table.place, "x": x.place, "phi_ddot": answer, "V_dot": moved}
    named |= named_turns(turns) | {w.name: w.place for w in wrench}
    lib.check(body, "accelerate", *lib.arguments_of("accelerate", **named))
    residual = rows.residual(body, place, moved, use)
    check_answer(lib, body, moved, 6)
    check_answer(lib, body, residual, m)
    lacking = body.local("lacking", (), Kind.INT)
    body.call(lib["excessive"], *lib.arguments_of("excessive", **named, options=p, flags=lacking))
    body.set(flags, flags | lacking)
    with body.loop("s", layout.count) as s:
        body.set(o.phi_ddot[s], answer[s])
        body.set(o.limited[s], limited[s])
    with body.loop("i", 6) as i:
        body.set(o.V_dot[i], moved[i])
    last = body.let("last", select(demanded > 0, demanded - 1, integer(0)))
    hardest(lib, body, o.hardest, work, rank, L, last, m)
    with body.loop("i", m) as i:
        body.set(o.residual[i], residual[i])
    body.set(o.rank, rank)
    body.set(o.damped_by, damped)
    with body.loop("i", min(m, int(layout.count))) as i:
        body.set(o.sigma[i], work.sigma[i])
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        f"inverse_{name}",
        f"Flywheel accelerations for the task {name}: what no row names is free, found by the dynamics. "
        "Least error in the norm of (S K^-1 S^T)^-1, then least weighted norm of phi''.",
        (*arguments, out),
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", *POSITIVE),
        notes=("Positive statuses are bits and may be combined.", FREE_NOTE, ANSWER_NOTE),
        public=True,
    )


def _unreachable(
    lib: Library, body: Body, work: Place, asked: Place, answer: Place, wanted: Place, flags: Place, m: int
) -> None:
    """UNREACHABLE, by what is left of the demand in the orthogonal rows."""
    left = body.local("left")
    body.set(left, real(0))
    with body.loop("i", m) as i:
        rest = body.local("rest")
        body.set(rest, asked[i])
        with body.loop("s", lib.layout.count) as s:
            body.add(rest, -(work.W[i][s] * (answer[s] / work.scale[s])))
        body.add(left, rest * rest)
    tolerance = lib.thresholds.unreachable
    with body.when(left > tolerance * tolerance * wanted):
        body.set(flags, flag(flags, "UNREACHABLE"))
