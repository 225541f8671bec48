"""inverse (12): flywheel accelerations for a wanted motion, with diagnostics: of a free carrier, a held one or a task.

W y = r of `demand`, or of a task, by singular values: least |r - W y| first, then least weighted norm of phi_ddot
= D^-1 y within the limits (`allocate`). Singular values and rank are those of the stand, whatever the weights.

inverse_fast gives the same answer by normal equations, Omega the weights. With as many flywheels as demanded rows and
more y = Omega^-1 W^T z, (W Omega^-1 W^T) z = r; with fewer (W^T W) y = W^T r, where weights have no say.
"""

from __future__ import annotations

from typing import Any

from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import SPIN_UP_NOTE, bit, check_flywheels, spin_up_excess
from mahovik.core.lower.flywheels import turns_of
from mahovik.core.lower.forward import STATE_STATUSES, all_turns, check_inputs
from mahovik.core.lower.hold import write_twist
from mahovik.core.lower.library import Library
from mahovik.core.lower.task import FREE_NOTE, Rows, base_demand, demanded_rows, miss, project_rows, turn_all
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Status
from mahovik.core.program.kernel import (
    OK,
    Reals,
    Result,
    argument,
    inline,
    ints,
    let,
    reals,
    record,
    status_of,
)
from mahovik.core.program.types import Kind
from mahovik.core.routines import ldl
from mahovik.core.routines.jacobi import name_for_rows

POSITIVE = ("NEAR_SINGULAR", "DAMPED", "LIMITED", "UNREACHABLE", "RANK_DEFICIENT", "EXCESSIVE")

SHARING = " What a flywheel at its limit cannot give is shared among the others."
PURPOSE = (
    "Flywheel accelerations for a wanted motion of the carrier: I phi_ddot = F - K {V}_dot - M {V} - J phi_dot. "
    "Least residual in the norm of K^-1, then least weighted norm of phi_ddot." + SHARING
)
PURPOSE_HELD = (
    "Flywheel accelerations for wanted rates of the freedoms: "
    "S^T I phi_ddot = S^T (F - K {V}_dot - M {V} - J phi_dot). "
    "Least residual in the norm of (S^T K S)^-1, then least weighted norm of phi_ddot." + SHARING
)
PURPOSE_OF_TASK = (
    "Flywheel accelerations for the task {}: what no row names is free, found by the dynamics. "
    "Least error in the norm of (S K^-1 S^T)^-1, then least weighted norm of phi_ddot."
)


def wanted_argument(lib: Library, task: Rows | None) -> Argument:
    """The demand: V_dot, or that of a task."""
    if task:
        return Argument("demand", Kind.REAL, (len(task),), unit="m/s2, rad/s2", purpose=f"wanted: {task.words}")
    purpose = "wanted, S u_dot" if lib.layout.held else "wanted derivative of the components of V"
    return Argument("V_dot", Kind.REAL, (6,), unit="m/s2, rad/s2", purpose=purpose)


def options_argument(lib: Library, task: Rows | None) -> Argument:
    """How a demand is distributed."""
    of = "weights, limits, damping, rows" if task else "weights, limits, damping"
    purpose = f"{of}; default_options holds those of the stand file"
    return Argument("options", lib.layout.inverse_options, purpose=purpose)


@inline
def accelerate(lib: Any, table: Any, x: Any, turns: Any, phi_ddot: Reals, wrench: Any, V_dot: Any) -> None:
    """V_dot that results of phi_ddot, by (8)."""
    rates = None
    if lib.layout.held:
        rates = reals(lib.layout.freedoms)
    lib["accelerate"](table, x, *turns, phi_ddot, wrench, V_dot, rates)
    if lib.layout.held:
        write_twist(lib, table, [rates], V_dot)


@inline
def scale(work: Any, rows: int) -> Any:
    """The largest element of W, by which W and r are divided.

    All rows of a hold or a task may be tiny, as those of unbalanced wheels in line with their only freedom: no square
    of them underflows. Rows of a free carrier have a spin inertia.
    """
    # divide by the largest element: no square of tiny rows underflows
    unit: float = 0.0
    for i in range(rows):
        for s in range(work.W.shape[1]):
            size = abs(work.W[i][s])
            unit = size if size > unit else unit
    if not unit > 0:
        unit = 1
    inverse_unit = 1 / unit
    for i in range(rows):
        work.r[i] = work.r[i] * inverse_unit
        for s in range(work.W.shape[1]):
            work.W[i][s] = work.W[i][s] * inverse_unit
    return unit


@inline
def sort(work: Any, rows: int) -> None:
    """Descending singular values: the order of the rows, by exchanging neighbours a fixed number of times."""
    # sort the singular values in descending order, by exchanging neighbours
    for pass_ in range(rows - 1):
        for i in range(rows - 1):
            if work.sigma[i] < work.sigma[i + 1]:
                for name in ("sigma", "r"):
                    kept = let(f"kept_{name}", work.member(name)[i])
                    work.member(name)[i] = work.member(name)[i + 1]
                    work.member(name)[i + 1] = kept
                for j in range(work.W.shape[1]):
                    kept = let("kept", work.W[i][j])
                    work.W[i][j] = work.W[i + 1][j]
                    work.W[i + 1][j] = kept
                for j in range(rows):
                    kept = let("kept", work.U[j][i])
                    work.U[j][i] = work.U[j][i + 1]
                    work.U[j][i + 1] = kept


@inline
def choose_rank(lib: Any, options: Any, work: Any, rank: Result, damping: Result, flags: Result, rows: int) -> None:
    """Choose the rows used, and damp near-singular ones: r sigma^2 / (sigma^2 + lambda^2).

    The only row of a held carrier has the largest singular value, and `near_singular` is at most 1: never damped.
    """
    rank.value = 0
    damping.value = 0
    if rows == 1 and lib.layout.held:
        if work.sigma[0] > 0:
            rank.value = 1
    else:
        for i in range(rows):
            if work.sigma[i] > lib.thresholds.rank * work.sigma[0]:
                rank.value = rank.value + 1
                ratio = work.sigma[i] / work.sigma[0]
                if ratio < options.near_singular:
                    flags.value = flags.value | bit("NEAR_SINGULAR")
                    if options.damping > 0:
                        flags.value = flags.value | bit("DAMPED")
                        lambda_ = options.damping * work.sigma[0] * (1 - ratio / options.near_singular)
                        square = work.sigma[i] * work.sigma[i]
                        work.r[i] = work.r[i] * (square / (square + lambda_ * lambda_))
                        damping.value = lambda_ if lambda_ > damping.value else damping.value


@inline
def hardest(lib: Any, work: Any, rank: int, last: int, out: Reals) -> None:
    """The part of the demand in rows left out, or the row `last` of the least singular value, by the factor G.

    By that of K it is a wrench, by that of a task components of its demand.
    """
    rows = len(out)
    # unreachable: the demand's part in the rows left out; if no row is left out, the last row
    part = reals(rows)
    for i in range(rows):
        part[i] = 0.0 if i < rank else work.r[i]
    largest: float = 0.0
    for i in range(rows):
        size = abs(part[i])
        largest = size if size > largest else largest
    if not largest > 0:
        part[last] = 1
        largest = 1
    square: float = 0.0
    for i in range(rows):
        part[i] = part[i] / largest
        square += part[i] * part[i]
    length = lib["sqrt"](square)
    u = reals(rows)  # U part: a unit vector in the norm of K^-1; its wrench is G u
    for k in range(rows):
        u[k] = 0
        for i in range(rows):
            u[k] += work.U[k][i] * part[i]
        u[k] = u[k] / length
    for i in range(rows):
        out[i] = 0
        for k in range(i + 1):
            out[i] += work.G[i][k] * u[k]


def add_inverse(lib: Library, task: Rows | None = None) -> None:
    """phi_ddot for a wanted V_dot of a free or held carrier, or for the demand of a task, with diagnostics."""
    layout, N, held = lib.layout, lib.layout.count, lib.layout.held
    m = len(task) if task else layout.inverse_rows
    along = bool(task) or held  # (8) gives the motion that results
    orthogonalise, allocate = lib[name_for_rows("orthogonalise", m)], lib[name_for_rows("allocate", m)]
    result = layout.task_result(task.task) if task else layout.inverse_result
    result_purpose = "phi_ddot, the motion and its quality" if task else "phi_ddot and its quality"

    @lib.kernel(
        f"inverse_{task.name}" if task else "inverse",
        equation="" if task else "(12)",
        purpose=PURPOSE_OF_TASK.format(task.name)
        if task
        else (PURPOSE_HELD if held else PURPOSE).format(V=layout.twist),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", *POSITIVE),
        notes=("Positive statuses are bits and may be combined.", *([FREE_NOTE] if task else []), ANSWER_NOTE),
        public=True,
    )
    def inverse(
        table: Any = lib.table,
        x: Any = lib.x,
        demand: Any = wanted_argument(lib, task),
        options: Any = options_argument(lib, task),
        wrench: Any = lib.wrench,
        out: Any = argument(result_purpose, struct=result, direction="out"),
    ) -> Status:
        """Flywheel accelerations for a wanted motion."""
        check_demand(lib, table, x, demand, options, wrench, (), ("near_singular", "damping"))
        check_flywheels(lib, options)
        work = record(layout.inverse_work)
        answer = reals(N)  # phi_ddot
        limited = ints(N)
        residual = reals(m)
        turns = turns_of(lib, x)
        if task:
            base_demand(lib, task, table, x, turns, wrench, work)
            project_rows(lib, task, table, x, demand, options, work)
        else:
            lib["demand"](table, x, *turns, demand, wrench, work)
        if task:
            demanded = demanded_rows(task.use(options))
        else:
            demanded = m
        wanted: float = 0.0
        for i in range(m):
            wanted += work.r[i] * work.r[i]
        if along:
            unit = scale(work, m)
        orthogonalise(work)
        sort(work, m)
        if task:
            asked = reals(m)  # the demand in these rows, before damping
            for i in range(m):
                asked[i] = work.r[i]
        rank = ints()
        damping = reals()
        flags: int = 0
        choose_rank(lib, options, work, rank, damping, flags, m)
        allocate(work, options, rank, answer, limited)
        for s in range(N):
            if limited[s] > 0:
                flags = flags | bit("LIMITED")
        if rank < demanded and rank < int(N) if task else rank < min(m, int(N)):
            flags = flags | bit("RANK_DEFICIENT")
        if along:
            moved = reals(6)  # V_dot that results, by (8)
        else:
            moved = reals(6)  # V_dot that results: V_dot + K^-1 residual
        left = reals()
        if task:
            left = 0
            for i in range(m):
                rest: float = asked[i]
                for s in range(N):
                    rest -= work.W[i][s] * (answer[s] / work.scale[s])
                rest = rest * unit
                left += rest * rest
        else:
            z = reals(m)  # G^-1 residual
            left = 0
            for i in range(m):
                residual[i] = work.b[i]
                for s in range(N):
                    residual[i] -= work.I[i][s] * answer[s]
            for i in range(m):
                z[i] = residual[i]
                for k in range(i):
                    z[i] -= work.G[i][k] * z[k]
                z[i] = z[i] / work.G[i][i]
                left += z[i] * z[i]
        if left > lib.thresholds.reached_square * wanted:
            flags = flags | bit("UNREACHABLE")
        if not along:
            for t in range(6):
                i = 5 - t
                for k in range(i + 1, 6):
                    z[i] -= work.G[k][i] * z[k]
                z[i] = z[i] / work.G[i][i]
                moved[i] = demand[i] + z[i]
        check_answer(lib, answer, N)
        if not task:
            check_answer(lib, residual, m)
        if along:
            accelerate(lib, table, x, turns, answer, wrench, moved)
            check_answer(lib, moved, 6)
        if task:
            miss(task, table, x, demand, task.use(options), moved, residual)
            check_answer(lib, residual, m)
        lacking = ints()
        lib["excessive"](table, x, *turns, moved, answer, options, wrench, lacking)
        flags = flags | lacking
        for s in range(N):
            out.phi_ddot[s] = answer[s]
            out.limited[s] = limited[s]
        if task:
            for i in range(6):
                out.V_dot[i] = moved[i]
        for i in range(m):
            out.residual[i] = residual[i]
        hardest(lib, work, rank, (demanded - 1 if demanded > 0 else 0) if task else m - 1, out.hardest)
        out.rank = rank
        out.damped_by = damping * unit if along else damping
        for i in range(min(m, int(N))):
            out.sigma[i] = work.sigma[i] * unit if along else work.sigma[i]
        return status_of(flags)


def add_inverse_alone(lib: Library) -> None:
    """`inverse` of a stand without flywheels: no phi_ddot, and all of the demand is left over."""
    layout = lib.layout

    @lib.kernel(
        equation="(12)",
        purpose="The wrench that a wanted motion of the carrier needs and no flywheel gives: "
        f"F - K {layout.twist}_dot - M {layout.twist}.",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "UNREACHABLE"),
        notes=("UNREACHABLE unless this wrench is zero.",),
        public=True,
    )
    def inverse(
        table: Any = lib.table,
        x: Any = lib.x,
        V_dot: Any = wanted_argument(lib, None),
        wrench: Any = lib.wrench,
        out: Any = argument("the wrench that is missing", struct=layout.inverse_result, direction="out"),
    ) -> Status:
        """The wrench that is missing."""
        check_inputs(lib, table, x, None, wrench)
        lib["within"](V_dot, 6, lib.limit("MAX_ACCELERATION"))
        work = record(layout.inverse_work)
        lib["demand"](table, x, None, None, V_dot, wrench, work)
        largest: float = 0.0
        for i in range(6):
            largest = abs(work.r[i]) if abs(work.r[i]) > largest else largest
        wanted = largest > 0
        if not wanted:
            # nothing is demanded: any direction is as hard as another
            work.r[5] = 1
            largest = 1
        square: float = 0.0
        for i in range(6):
            work.r[i] = work.r[i] / largest  # no square underflows
            square += work.r[i] * work.r[i]
        length = lib["sqrt"](square)
        for i in range(6):
            out.residual[i] = work.b[i]
            out.hardest[i] = 0
            for k in range(i + 1):
                out.hardest[i] += work.G[i][k] * (work.r[k] / length)
        out.rank = 0
        out.damped_by = 0
        if wanted:
            return Status("UNREACHABLE")
        return OK


# -- inverse_fast: the same answer by normal equations, without diagnostics, for fast loops ----------------------------


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
