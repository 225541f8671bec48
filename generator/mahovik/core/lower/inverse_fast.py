"""inverse_fast (12): the same answer by normal equations, without diagnostics, for fast loops.

W y = r of `demand` or of a task, Omega the weights. With as many flywheels as demanded rows and more
y = Omega^-1 W^T z, (W Omega^-1 W^T) z = r; with fewer (W^T W) y = W^T r, where weights have no say.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import SPIN_UP_NOTE, spin_up_excess
from mahovik.core.lower.forward import STATE_STATUSES, all_turns
from mahovik.core.lower.inverse import wanted_argument
from mahovik.core.lower.library import Library
from mahovik.core.lower.task import FREE_NOTE, Rows, base_demand, demanded_rows, project_rows, turn_all
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import (
    Reals,
    argument,
    inline,
    reals,
    record,
    status_of,
)
from mahovik.core.routines import ldl


@inline
def solve_definite(lib: Any, gram: Reals, z: Reals) -> None:
    """z = gram^-1 z, in place; the function returns where gram is not positive definite."""
    ldl.factor(gram, len(z), lambda pivot: lib.thresholds.gram_pivot * pivot, True, z)
    ldl.substitute_back(gram, z, len(z))


@inline
def wide_answer(
    lib: Any, work: Any, options: Any, rows: int, answer: Reals, use: Any = None, table: Any = None
) -> None:
    """phi_ddot = D^-1 Omega^-1 W^T z, (W Omega^-1 W^T + lambda^2 E) z = r: not more rows than flywheels.

    A row that is free, by `use`, is zero and its z is 0. With `table` W and r lack the norms of spin inertias, of the
    table, and of rows, G. W Omega^-1 takes the place of I, which is not read again.
    """
    # normal equations: W Omega^-1 W^T z = r, y = Omega^-1 W^T z; `I` now holds W Omega^-1
    for s in range(lib.layout.count):
        give = table.flywheel[s].spin_inv / options.weight[s] if table is not None else 1 / options.weight[s]
        for i in range(rows):
            work.I[i][s] = work.W[i][s] * give
    gram = reals(rows, rows)
    z = reals(rows)
    trace: float = 0.0
    for i in range(rows):
        for j in range(i + 1):
            total: float = 0.0
            for s in range(lib.layout.count):
                total += work.I[i][s] * work.W[j][s]
            gram[i][j] = total
        trace += gram[i][i] * work.sigma[i] if table is not None else gram[i][i]
        z[i] = work.r[i]
    lambda2 = options.damping * options.damping * trace  # square of the damping
    for i in range(rows):
        gram[i][i] += (lambda2 * work.G[i][i] if table is not None else lambda2) if use is None or use[i] > 0 else 1.0
    solve_definite(lib, gram, z)
    for s in range(lib.layout.count):
        y: float = 0.0
        for i in range(rows):
            y += work.I[i][s] * z[i]
        answer[s] = y if table is not None else y * work.scale[s]


@inline
def tall_answer(lib: Any, work: Any, options: Any, rows: int, answer: Reals) -> None:
    """phi_ddot = D^-1 y, (W^T W + lambda^2 E) y = W^T r: more rows than flywheels."""
    # normal equations: W^T W y = W^T r
    gram = reals(lib.layout.count, lib.layout.count)
    z = reals(lib.layout.count)
    trace: float = 0.0
    for s in range(lib.layout.count):
        for t in range(s + 1):
            total: float = 0.0
            for i in range(rows):
                total += work.W[i][s] * work.W[i][t]
            gram[s][t] = total
        trace += gram[s][s]
        side: float = 0.0
        for i in range(rows):
            side += work.W[i][s] * work.r[i]
        z[s] = side
    lambda2 = options.damping * options.damping * trace  # square of the damping
    for s in range(lib.layout.count):
        gram[s][s] += lambda2
    solve_definite(lib, gram, z)
    for s in range(lib.layout.count):
        answer[s] = z[s] * work.scale[s]


def add_inverse_fast(lib: Library, task: Rows | None = None) -> None:
    """phi_ddot for a wanted V_dot of a free or held carrier, or a task, by normal equations: away from singularity."""
    layout, N, held = lib.layout, lib.layout.count, lib.layout.held
    rows = len(task) if task else layout.inverse_rows
    name = f"inverse_fast_{task.name}" if task else "inverse_fast"
    accurate = f"inverse_{task.name}" if task else "inverse"
    motion = (
        f"the task {task.name}"
        if task
        else "wanted rates of the freedoms"
        if held
        else "a wanted motion of the carrier"
    )
    purpose = (
        "weights, limits, damping, rows; default_options holds those of the stand file"
        if task
        else ("weights and damping; `near_singular` and `limit` are ignored")
    )
    direct = task is not None and task.whole_turning and int(N) >= 3
    sine, cosine = lib.turn_arguments() or (None, None)

    @lib.kernel(
        name,
        equation="" if task else "(12)",
        purpose=f"Flywheel accelerations for {motion}, without diagnostics: normal equations.",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "EXCESSIVE"),
        notes=(
            f"Squares the condition number: as accurate as {accurate} if singular values differ by a factor of at most "
            "some thousand; returns NOT_POSITIVE_DEFINITE if they differ by more and damping is 0.",
            f"`damping` is in units of the root of the sum of squares of sigma, which {accurate} gives.",
            SPIN_UP_NOTE,
            *([FREE_NOTE] if task else []),
            ANSWER_NOTE,
        ),
        public=True,
    )
    def inverse_fast(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = sine,
        cosine: Any = cosine,
        demand: Any = wanted_argument(lib, task),
        options: Any = Argument("options", layout.inverse_options, purpose=purpose),
        wrench: Any = lib.wrench,
        phi_ddot: Reals = argument("flywheel accelerations", N, direction="out", unit="rad/s2"),
    ) -> Status:
        """Flywheel accelerations for a wanted motion, without diagnostics."""
        turns = () if sine is None else (sine, cosine)
        check_demand(lib, table, x, demand, options, wrench, turns, ("damping",))
        work = record(layout.inverse_work)
        turned = all_turns(lib, x, turns)
        if task:
            base_demand(lib, task, table, x, turned, wrench, work, not direct)
        else:
            lib["demand"](table, x, *turned, demand, wrench, work)
        if task:
            demanded = demanded_rows(task.use(options))
        else:
            demanded = rows
        answer = reals(N)
        if task and direct:
            if demanded > 2:
                turn_all(task, table, demand, work)
                wide_answer(lib, work, options, 3, answer, table=table)
            else:
                lib["scale_turning"](table, work)
                project_rows(lib, task, table, x, demand, options, work)
                wide_answer(lib, work, options, rows, answer, task.use(options))
        else:
            if task:
                project_rows(lib, task, table, x, demand, options, work)
            if rows > int(N) and demanded > int(N):
                tall_answer(lib, work, options, rows, answer)
            else:
                wide_answer(lib, work, options, rows, answer, task.use(options) if task else None)
        check_answer(lib, answer, N)
        flags = spin_up_excess(lib, table, x, options, answer)
        for s in range(N):
            phi_ddot[s] = answer[s]
        return status_of(flags)
