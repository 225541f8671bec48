"""inverse_fast_TASK: the same answer by normal equations, without diagnostics, for fast loops.

With at least as many flywheels as demanded rows y = Omega^-1 W^T z, (W Omega^-1 W^T) z = r, Omega the weights; with
fewer (W^T W) y = W^T r, where weights have no say.
"""

from __future__ import annotations

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import SPIN_UP_NOTE, spin_up_excess
from mahovik.core.lower.forward import STATE_STATUSES, all_turns
from mahovik.core.lower.library import Library
from mahovik.core.lower.normal_equations import Scaling, tall_answer, wide_answer
from mahovik.core.lower.task.demand import base_demand, demanded_rows
from mahovik.core.lower.task.inverse import FREE_NOTE, task_arguments
from mahovik.core.lower.task.rows import Rows
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert, Expr, Place
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def inverse_fast_task(lib: Library, rows: Rows) -> Function:
    """phi'' for the demand of a task by normal equations."""
    layout, m, name = lib.layout, len(rows), rows.task.name
    table, x, demand, options, *wrench = arguments = task_arguments(lib, rows)
    given = lib.given_turns()
    phi_ddot = Argument("phi_ddot", Kind.REAL, (layout.count,), "out", "rad/s2", "flywheel accelerations")
    p = options.place
    use = p.member(f"use_{name}")
    place = {a.name: a.place for a in arguments}
    body = Body()
    check_demand(lib, body, table, x, demand, p, ("damping",), tuple(wrench), given)
    work = body.local("work", (), layout.inverse_work)
    turns = all_turns(lib, body, x.place, given)
    direct = rows.whole_turning and int(layout.count) >= 3
    base_demand(lib, body, rows, place, turns, work, scaled=not direct)
    demanded = demanded_rows(body, use)
    answer = body.local("answer", (layout.count,))

    def choose() -> None:
        if direct:
            body.call(lib["scale_turning"], table.place, work)
        L = body.local("L", (m, m), comment="factor of the norm of the demand")
        body.call(lib[f"project_{name}"], *lib.arguments_of(f"project_{name}", **place, use=use, work=work, L=L))
        if m > int(layout.count):
            with body.when(demanded > int(layout.count)):
                tall_answer(lib, body, work, p, m, answer)
            with body.otherwise():
                wide_answer(lib, body, work, p, m, answer, scaled, use)
        else:
            wide_answer(lib, body, work, p, m, answer, scaled, use)

    scaled = Scaling(lambda s: 1 / p.weight[s], lambda s: work.scale[s])
    if direct:
        with body.when(demanded > 2):
            _turn(body, rows, place, work)
            own = Scaling(lambda s: table.place.flywheel[s].spin_inv / p.weight[s], None, work.G, work.sigma)
            wide_answer(lib, body, work, p, 3, answer, own)
        with body.otherwise():
            choose()
    else:
        choose()
    check_answer(lib, body, answer, layout.count)
    flags = spin_up_excess(lib, body, (table.place, x.place, p), answer)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], answer[s])
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        f"inverse_fast_{name}",
        f"Flywheel accelerations for the task {name}, without diagnostics: normal equations.",
        (table, x, *given, demand, options, *wrench, phi_ddot),
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "EXCESSIVE"),
        notes=(
            f"Squares the condition number: as accurate as inverse_{name} if singular values differ by a factor of at "
            "most some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.",
            "Damping is relative to the norm of W.",
            SPIN_UP_NOTE,
            FREE_NOTE,
            ANSWER_NOTE,
        ),
        public=True,
    )


def _turn(body: Body, rows: Rows, place: dict[str, Place], work: Place) -> None:
    """r = U^-1 moment - D U^T omega* where all of omega* is demanded: the error's norm is the inertia, W stays."""
    body.note("all of omega* is demanded: r = U^-1 (moment - inertia omega*)")
    wanted = [
        body.let(f"turn_{i + 1}", value) for i, value in enumerate(rows.turning_demand(place["table"], place["demand"]))
    ]
    for i in range(3):
        term: Expr = wanted[i]
        for k in range(i + 1, 3):
            term = term + work.G[k][i] * wanted[k]
        body.set(work.r[i], work.r[i] - work.G[i][i] * term)
