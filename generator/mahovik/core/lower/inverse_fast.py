"""inverse_fast (12): the same answer by normal equations, without diagnostics, for fast loops.

W y = r of `demand`, Omega the weights. With six flywheels and more y = Omega^-1 W^T z, (W Omega^-1 W^T) z = r; with
fewer (W^T W) y = W^T r, where weights have no say.
"""

from __future__ import annotations

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import SPIN_UP_NOTE, spin_up_excess
from mahovik.core.lower.flywheels import AT_NOTES
from mahovik.core.lower.forward import STATE_STATUSES, all_turns
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Convert, Not, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def inverse_fast(lib: Library, at: bool = False) -> Function:
    """phi'' for a wanted V* by the normal equations: for fast loops away from singularity.

    `at`: inverse_fast_at, of given sines and cosines of the phases.
    """
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted derivative of the components of V")
    options = Argument("options", layout.inverse_options, purpose="weights and damping; `near` and `limit` are ignored")
    given, wrench = lib.given_turns() if at else (), lib.wrench_arguments()
    phi_ddot = Argument("phi_ddot", Kind.REAL, (layout.count,), "out", "rad/s2", "flywheel accelerations")
    p = options.place
    wide = int(layout.count) >= 6
    size = 6 if wide else int(layout.count)
    body = Body()
    check_demand(lib, body, table, x, V_dot, p, ("damping",), wrench, given)
    work = body.local("work", (), layout.inverse_work)
    inputs = [w.place for w in wrench]
    turns = all_turns(lib, body, x.place, given)
    lib.check(body, "demand", table.place, x.place, *turns, V_dot.place, *inputs, work)
    body.note(
        "normal equations: W Omega^-1 W^T z = r, y = Omega^-1 W^T z" if wide else "normal equations: W^T W y = W^T r"
    )
    gram = body.local("gram", (size, size))
    z = body.local("z", (size,))
    trace = body.local("trace")
    body.set(trace, real(0))
    if wide:
        body.note("I has had its use: W Omega^-1 takes its place")
        with body.loop("s", layout.count) as s:
            give = body.let("give", 1 / p.weight[s])
            with body.loop("i", 6) as i:
                body.set(work.I[i][s], work.W[i][s] * give)
    with body.loop("i", size) as i:
        with body.loop("j", i + 1) as j:
            total = body.local("total")
            body.set(total, real(0))
            with body.loop("k", layout.count if wide else 6) as k:
                one, two = (work.I[i][k], work.W[j][k]) if wide else (work.W[k][i], work.W[k][j])
                body.add(total, one * two)
            body.set(gram[i][j], total)
        body.add(trace, gram[i][i])
        if wide:
            body.set(z[i], work.r[i])
        else:
            side = body.local("side")
            body.set(side, real(0))
            with body.loop("k", 6) as k:
                body.add(side, work.W[k][i] * work.r[k])
            body.set(z[i], side)
    share = body.let("lambda2", p.damping * p.damping * trace, "square of the damping")
    _solve_gram(lib, body, gram, z, share, size)
    answer = body.local("answer", (layout.count,))
    with body.loop("s", layout.count) as s:
        y = body.local("y")
        body.set(y, real(0) if wide else z[s])
        if wide:
            with body.loop("k", 6) as k:
                body.add(y, work.I[k][s] * z[k])
        body.set(answer[s], y * work.scale[s])
    check_answer(lib, body, answer, layout.count)
    flags = spin_up_excess(lib, body, (table.place, x.place, p), answer)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], answer[s])
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        "inverse_fast_at" if at else "inverse_fast",
        "Flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal equations.",
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
            *(AT_NOTES if at else ()),
        ),
        public=True,
    )


def _solve_gram(lib: Library, body: Body, gram: Place, z: Place, share: Place, size: int) -> None:
    """z = (gram + share E)^-1 z by gram + share E = L D L^T, in place, without a square root.

    Of gram the lower triangle is given; then L D is on and below the diagonal, L^T above it. Pivots divide: where they
    are tiny their inverses overflow, their quotients do not.
    """
    with body.loop("j", size) as j:
        pivot = body.local("pivot")
        body.set(pivot, gram[j][j] + share)
        least = body.let("least", lib.thresholds.gram_pivot * pivot, "a pivot below this is rounding error")
        rest = body.local("rest")
        body.set(rest, z[j])
        with body.loop("k", j) as k:
            body.add(pivot, -(gram[j][k] * gram[k][j]))
            body.add(rest, -(gram[k][j] * z[k]))
        body.set(z[j], rest)
        lib.guard(body, Not(pivot > least), "NOT_POSITIVE_DEFINITE")
        body.set(gram[j][j], pivot)
        with body.loop("i", size, start=j + 1) as i:
            below = body.local("below")
            body.set(below, gram[i][j])
            with body.loop("k", j) as k:
                body.add(below, -(gram[i][k] * gram[k][j]))
            body.set(gram[i][j], below)
            body.set(gram[j][i], below / pivot)
    with body.loop("t", size) as t:
        i_ = body.let("i", integer(size - 1) - t)
        rest = body.local("rest")
        body.set(rest, z[i_] / gram[i_][i_])
        with body.loop("k", size, start=i_ + 1) as k:
            body.add(rest, -(gram[i_][k] * z[k]))
        body.set(z[i_], rest)
