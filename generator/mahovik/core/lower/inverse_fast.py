"""inverse_fast (12): the same answer by normal equations, without diagnostics, for fast loops.

W y = r of `demand`, Omega the weights: six rows, or one for each freedom of a held carrier. With as many flywheels and
more y = Omega^-1 W^T z, (W Omega^-1 W^T) z = r; with fewer (W^T W) y = W^T r, where weights have no say.
"""

from __future__ import annotations

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import SPIN_UP_NOTE, spin_up_excess
from mahovik.core.lower.forward import STATE_STATUSES, all_turns
from mahovik.core.lower.library import Library
from mahovik.core.lower.normal_equations import Scaling, tall_answer, wide_answer
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def inverse_fast(lib: Library) -> Function:
    """phi'' for a wanted V*, of a held carrier S u*, by the normal equations: for fast loops away from singularity."""
    layout = lib.layout
    rows = layout.freedoms if layout.held else 6
    table, x = lib.table_argument(), lib.state_argument()
    wanted = "wanted, S u_dot" if layout.held else "wanted derivative of the components of V"
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose=wanted)
    options = Argument(
        "options", layout.inverse_options, purpose="weights and damping; `near_singular` and `limit` are ignored"
    )
    given, wrench = lib.given_turns(), lib.wrench_arguments()
    phi_ddot = Argument("phi_ddot", Kind.REAL, (layout.count,), "out", "rad/s2", "flywheel accelerations")
    p = options.place
    body = Body()
    check_demand(lib, body, table, x, V_dot, p, ("damping",), wrench, given)
    work = body.local("work", (), layout.inverse_work)
    inputs = [w.place for w in wrench]
    turns = all_turns(lib, body, x.place, given)
    lib.check(body, "demand", table.place, x.place, *turns, V_dot.place, *inputs, work)
    answer = body.local("answer", (layout.count,))
    if int(layout.count) >= rows:
        by = Scaling(lambda s: 1 / p.weight[s], lambda s: work.scale[s])
        wide_answer(lib, body, work, p, rows, answer, by)
    else:
        tall_answer(lib, body, work, p, rows, answer)
    check_answer(lib, body, answer, layout.count)
    flags = spin_up_excess(lib, body, (table.place, x.place, p), answer)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], answer[s])
    body.ret(Convert(flags, Kind.STATUS))
    motion = "wanted rates of the freedoms" if layout.held else "a wanted motion of the carrier"
    return Function(
        "inverse_fast",
        f"Flywheel accelerations for {motion}, without diagnostics: normal equations.",
        (table, x, *given, V_dot, options, *wrench, phi_ddot),
        body.statements,
        equation="(12)",
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "EXCESSIVE"),
        notes=(
            "Squares the condition number: as accurate as inverse if singular values differ by a factor of at most "
            "some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.",
            "Damping is relative to the norm of W.",
            SPIN_UP_NOTE,
            ANSWER_NOTE,
        ),
        public=True,
    )
