"""inverse_fast (12): the same answer by normal equations, without diagnostics, for fast loops.

W y = r of `demand`, Omega the weights. With six flywheels and more y = Omega^-1 W^T z, (W Omega^-1 W^T) z = r; with
fewer (W^T W) y = W^T r, where weights have no say.
"""

from __future__ import annotations

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.flywheels import AT_NOTES
from mahovik.core.lower.forward import STATE_STATUSES, all_turns
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body, call
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Not, Place, integer, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def inverse_fast(lib: Library, at: bool = False) -> Function:
    """phi'' for a wanted V* by the normal equations: for fast loops away from singularity.

    `at`: inverse_fast_at, of given sines and cosines of the phases.
    """
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    V_dot = Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose="wanted derivative of the components of V")
    options = Argument("options", layout.inverse_options, purpose="weights and damping; `near` and limits are ignored")
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
        weighed = body.local("weighed", (layout.count,), comment="a row of W Omega^-1")
    with body.loop("i", size) as i:
        if wide:
            with body.loop("s", layout.count) as s:
                body.set(weighed[s], work.W[i][s] / p.weight[s])
        with body.loop("j", i + 1) as j:
            body.set(gram[i][j], real(0))
            with body.loop("k", layout.count if wide else 6) as k:
                one, two = (weighed[k], work.W[j][k]) if wide else (work.W[k][i], work.W[k][j])
                body.add(gram[i][j], one * two)
        body.add(trace, gram[i][i])
        if wide:
            body.set(z[i], work.r[i])
        else:
            body.set(z[i], real(0))
            with body.loop("k", 6) as k:
                body.add(z[i], work.W[k][i] * work.r[k])
    share = body.let("lambda2", p.damping * p.damping * trace, "square of the damping")
    with body.loop("i", size) as i:
        body.add(gram[i][i], share)
    _solve_gram(lib, body, gram, z, size)
    answer = body.local("answer", (layout.count,))
    with body.loop("s", layout.count) as s:
        y = body.local("y")
        body.set(y, real(0) if wide else z[s])
        if wide:
            with body.loop("k", 6) as k:
                body.add(y, work.W[k][s] * z[k])
            body.set(y, y / p.weight[s])
        body.set(answer[s], y * work.scale[s])
    check_answer(lib, body, answer, layout.count)
    with body.loop("s", layout.count) as s:
        body.set(phi_ddot.place[s], answer[s])
    return body.checked(
        "inverse_fast_at" if at else "inverse_fast",
        "Flywheel accelerations for a wanted motion of the carrier, without diagnostics: normal equations.",
        (table, x, *given, V_dot, options, *wrench, phi_ddot),
        equation="(12)",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT"),
        notes=(
            "Squares the condition number: as accurate as inverse if singular values differ by a factor of at most "
            "some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.",
            "Damping is relative to the norm of W.",
            ANSWER_NOTE,
            *(AT_NOTES if at else ()),
        ),
        public=True,
    )


def _solve_gram(lib: Library, body: Body, gram: Place, z: Place, size: int) -> None:
    """z = gram^-1 z by a Cholesky factor in the lower triangle, in place."""
    with body.loop("j", size) as j:
        least = body.let("least", lib.thresholds.gram_pivot * gram[j][j], "a pivot below this is rounding error")
        with body.loop("k", j) as k:
            body.add(gram[j][j], -(gram[j][k] * gram[j][k]))
        lib.guard(body, Not(gram[j][j] > least), "NOT_POSITIVE_DEFINITE")
        body.set(gram[j][j], call(lib["sqrt"], gram[j][j]))
        with body.loop("i", size, start=j + 1) as i:
            with body.loop("k", j) as k:
                body.add(gram[i][j], -(gram[i][k] * gram[j][k]))
            body.set(gram[i][j], gram[i][j] / gram[j][j])
    with body.loop("i", size) as i:
        with body.loop("k", i) as k:
            body.add(z[i], -(gram[i][k] * z[k]))
        body.set(z[i], z[i] / gram[i][i])
    with body.loop("t", size) as t:
        i_ = body.let("i", integer(size - 1) - t)
        with body.loop("k", size, start=i_ + 1) as k:
            body.add(z[i_], -(gram[k][i_] * z[k]))
        body.set(z[i_], z[i_] / gram[i_][i_])
