"""torque_for_TASK: drive torques for chosen components of the carrier's motion, within what the motors have.

With the free flywheels eliminated, K_c V_dot = F_c - I (tau - tau_0)/Theta_ff: the equation of `demand` with
K_c = K - sum I I^T/Theta_ff in the place of K, and y/Theta_ff^1/2 in that of phi_ddot, tau = tau_0 + Theta_ff^1/2 y. So
`project_TASK` makes of X = C^-1 I Theta_ff^-1/2 and x = C^-1 (F_c - K_c d), K_c = C C^T, the rows that are demanded.
tau_0 gives flywheels their preferred accelerations on a carrier with V_dot = 0.

W y = r is solved within bounds on the torques: least error, then torques nearest to tau_0. Where the demand is out of
reach and its direction is to be kept, the largest share of it that is not (`largest_share`).
"""

from __future__ import annotations

from typing import Any

from mahovik.contract.quantities import short
from mahovik.core import routines
from mahovik.core.derive import SYMMETRIC
from mahovik.core.lower.checks import check_number
from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand, less, right_side, substitute
from mahovik.core.lower.excess import at_most, bit, check_motor, refuse
from mahovik.core.lower.flywheels import along, common_terms, couple_flywheel, turns_of
from mahovik.core.lower.forward import STATE_STATUSES, drift_of
from mahovik.core.lower.inverse import options_argument, wanted_argument
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import invert_symmetric, start_blocks
from mahovik.core.lower.task import FREE_NOTE, Rows, miss, project_rows, turning_part
from mahovik.core.program.expression import Place, Status
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    OK,
    Reals,
    argument,
    block,
    inline,
    ints,
    reals,
    record,
    status_of,
)
from mahovik.core.program.vector import Matrix, symmetric


def base_of(task: Rows) -> str:
    """Name of the function that has the equation of a task in drive torques."""
    return "torque_demand_turning" if task.turning else "torque_demand"


def add_torque(lib: Library, task: Rows) -> None:
    """Adds `torque_for_TASK`, and what tasks share: least squares and shares within bounds by their number of rows."""
    count, at, rows = lib.layout.count, lib.thresholds, len(task)
    if base_of(task) not in lib:
        add_torque_demand(lib, task.turning)
    if f"largest_share_{rows}" not in lib:
        lib.add(routines.bounded_least_squares(rows, count, at.bounded))
        lib.add(routines.largest_share(rows, count, at.share_pivot, at.unreachable))
    add_torque_for(lib, task)


def add_torque_demand(lib: Library, turning: bool) -> None:
    """X, x and C; of the turning part alone, with v_dot eliminated, where only turning is demanded."""
    layout, N = lib.layout, lib.layout.count
    what = "the turning part of the motion" if turning else "the motion"

    @lib.kernel(
        "torque_demand_turning" if turning else "torque_demand",
        purpose=f"How {what} depends on the drive torques, scaled, at V_dot = 0.",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )
    def torque_demand(
        table: Any = lib.table,
        x: Any = lib.x,
        sine: Any = lib.sine,
        cosine: Any = lib.cosine,
        preferred: Reals = argument("accelerations of the flywheels", N, unit="rad/s2"),
        locked: Any = lib.locked_argument(),
        wrench: Any = lib.wrench,
        work: Any = argument("W holds X, r holds x, G holds C; and scale", struct=layout.inverse_work, direction="out"),
        tau_0: Reals = argument("torques that give these on a carrier with V_dot = 0", N, direction="out", unit="N m"),
    ) -> Status:
        """How the motion depends on the drive torques."""
        seen, F, _ = right_side(lib, table, x, (sine, cosine), wrench, "F_c")
        K = record(layout.schur)  # mass matrix with free flywheels eliminated
        start_blocks(lib, table, seen.sums, K)
        common = common_terms(lib, seen.V, seen.g)
        drive = record(layout.coupling)
        drift = None if seen.stream is None else drift_of(x, seen.stream)
        for s in range(N):
            couple_flywheel(lib, table, s, seen, common, drive)
            rate = at_rest(preferred[s], table.flywheel[s], drive.I, drift)
            spin = table.flywheel[s].spin
            if seen.own is None:
                tau_0[s] = spin * rate + drive.bias
            else:
                tau_0[s] = spin * rate + (drive.bias - seen.own[s * 6 + 3])
            work.scale[s] = table.flywheel[s].spin_root_inv
            if locked[s] == 0:
                lib["eliminate"](drive.I, table.flywheel[s].spin_inv, rate, K, F)
            # a locked flywheel takes no part
            for i in range(6):
                work.I[i][s] = drive.I[i] if locked[s] == 0 else 0.0
        if turning:
            # v_dot is eliminated; a stream moves v_dot alone
            inverse = reals(6)  # A^-1
            invert_symmetric(lib, K.A, inverse)
            U: Reals = (symmetric(inverse) @ K.B.T).flat  # A^-1 B^T
            S: Reals = K.D - (K.B.square @ U.square).six  # D - B A^-1 B^T
            turning_part(lib, F, S, work, lambda six: six[3:] - U.T @ six[:3])
            lib["scale_turning"](table, work)
        else:
            still = reals(6)  # V_dot = 0
            still[:] = [0] * 6
            if drift is not None:
                still[0:3] = drift
            work.G[:] = Matrix([[element(K, i, j) for j in range(6)] for i in range(6)])
            for i in range(6):
                work.b[i] = less(F[i], work.G[i], still)
                work.r[i] = work.b[i]
            lib["factor"](work)
            for s in range(N):
                for i in range(6):
                    work.W[i][s] = work.I[i][s] * work.scale[s]
            substitute(lib, work, 6)
        return OK


def at_rest(preferred: Any, row: Any, column: Any, drift: Any) -> Any:
    """phi_ddot at V_r_dot = 0 under the torque that makes it `preferred` at V_dot = 0."""
    return preferred if drift is None else preferred + along(column, [*drift, 0, 0, 0]) * row.spin_inv


def element(K: Place, i: int, j: int) -> Place:
    """Element (i, j) of a symmetric matrix by blocks."""
    row, column = max(i, j), min(i, j)
    if row >= 3 > column:
        return K.B[3 * (row - 3) + column]
    return (K.A if row < 3 else K.D)[SYMMETRIC.index((column % 3, row % 3))]


@inline
def check_options(lib: Any, options: Any) -> Any:
    """Refuses options of motors and wanted speeds that are no numbers, negative or out of range."""
    for s in range(lib.layout.count):
        check_motor(lib, options, s)
        refuse([options.motor_power[s]], options.motor_power[s] < 0)
    lib["within"](options.target_speed, lib.layout.count, lib.limit("MAX_SPEED"))
    for number in (options.target_rate, options.avoid_speed):
        with block():
            check_number(lib, number, lib.limit("MAX_SPEED"))
    if options.target_rate < 0 or options.avoid_speed < 0:
        return BAD_ARGUMENT


@inline
def prefer(x: Any, options: Any, preferred: Reals) -> None:
    """target_rate times what is missing to the wanted speed; inside the avoided speeds, to their end."""
    for s in range(len(preferred)):
        speed = x.phi_dot[s]
        target: float = options.target_speed[s]
        if abs(target) < options.avoid_speed:
            # a wanted speed that is to be avoided: the end of its side, or of the side where the flywheel is
            side = speed if target <= 0 and target >= 0 else target
            target = -options.avoid_speed if side < 0 else options.avoid_speed
        preferred[s] = options.target_rate * (target - speed)


@inline
def bound(lib: Any, x: Any, options: Any, least: Reals, most: Reals) -> None:
    """Torques that each motor has at its speed: driving, less with speed and by its power; braking, all of it."""
    for s in range(lib.layout.count):
        speed = x.phi_dot[s]
        size = abs(speed)
        whole = (
            options.motor_torque[s] if options.motor_torque[s] < lib.limit("MAX_WRENCH") else lib.limit("MAX_WRENCH")
        )
        has = at_most(lib, options, s, speed, whole)
        part = 1 - size / options.motor_speed[s]
        driving: float = has * part if part > 0 else 0.0
        if driving * size > options.motor_power[s]:
            driving = options.motor_power[s] / size
        most[s] = driving if speed > 0 else has
        least[s] = -driving if speed < 0 else -has


def add_torque_for(lib: Library, task: Rows) -> None:
    """tau for the demand of a task, within the motors' torque, speed and power."""
    layout, N, m = lib.layout, lib.layout.count, len(task)
    n, base = int(N), base_of(task)
    least_squares, largest_share = lib[f"bounded_least_squares_{m}"], lib[f"largest_share_{m}"]

    @lib.kernel(
        f"torque_for_{task.name}",
        purpose=f"Drive torques for the task {task.name}, within what the motors have. Least error in the norm of "
        "(S K_c^-1 S^T)^-1, K_c = K - sum I I^T / Theta_ff of the free flywheels; then torques nearest to those of the "
        "preferred accelerations.",
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "LIMITED", "UNREACHABLE"),
        notes=(
            "With keep_direction a demand out of reach is made smaller, not turned: share is the part that is met.",
            "A flywheel whose lock or failure is known goes into `locked`: the others do its part.",
            f"Directions in which torques move the carrier {short(lib.thresholds.bounded**0.5)} times less than in the "
            "strongest are given up in part.",
            "Positive statuses are bits and may be combined.",
            FREE_NOTE,
            ANSWER_NOTE,
        ),
        public=True,
    )
    def torque_for(
        table: Any = lib.table,
        x: Any = lib.x,
        demand: Any = wanted_argument(lib, task),
        options: Any = options_argument(lib, task),
        locked: Any = lib.locked_argument(),
        wrench: Any = lib.wrench,
        out: Any = argument(
            "tau, the motion and its quality", struct=layout.torque_for_result(task.task), direction="out"
        ),
    ) -> Status:
        """Drive torques for a task."""
        check_demand(lib, table, x, demand, options, wrench, (), ("damping",))
        check_options(lib, options)
        preferred = reals(N)  # accelerations towards the wanted speeds
        prefer(x, options, preferred)
        work = record(layout.inverse_work)
        tau_0 = reals(N)  # torques of the preferred accelerations
        turns = turns_of(lib, x)
        lib[base](table, x, *turns, preferred, locked, wrench, work, tau_0)
        project_rows(lib, task, table, x, demand, options, work)
        W = reals(m * n)  # rows, one after the other
        r = reals(m)
        for i in range(m):
            r[i] = work.r[i]
            for s in range(N):
                W[i * n + s] = work.W[i][s]
        least = reals(N)  # bounds of tau
        most = reals(N)
        low = reals(N)  # bounds of y
        high = reals(N)
        bound(lib, x, options, least, most)
        for s in range(N):
            low[s] = (least[s] - tau_0[s]) * work.scale[s]
            high[s] = (most[s] - tau_0[s]) * work.scale[s]
            if locked[s] != 0:
                low[s] = 0
                high[s] = 0
        y = reals(N)
        held = ints(N)
        share: float = 1.0
        least_squares(W, r, low, high, options.weight, y, held)
        left: float = 0.0
        wanted: float = 0.0
        for i in range(m):
            rest: float = r[i]
            for s in range(N):
                rest -= W[i * n + s] * y[s]
            left += rest * rest
            wanted += r[i] * r[i]
        flags: int = bit("UNREACHABLE") if left > lib.thresholds.reached_square * wanted else 0
        if flags > 0:
            if options.keep_direction != 0:
                start = reals(m)
                towards = reals(m)
                # r = start + towards: that of demand 0, and -L^-1 demand
                for i in range(m):
                    towards[i] = -demand[i] if task.use(options)[i] > 0 else 0.0
                    for k in range(i):
                        towards[i] -= work.G[i][k] * towards[k]
                    towards[i] = towards[i] / work.G[i][i]
                    start[i] = r[i] - towards[i]
                share = largest_share(W, low, high, start, towards, y)
                if share < 0:
                    # not even demand 0 is within reach: its least error
                    share = 0
                    least_squares(W, start, low, high, options.weight, y, held)
                else:
                    for s in range(N):
                        held[s] = 1 if y[s] >= high[s] else -1 if y[s] <= low[s] else 0
        tau = reals(N)
        for s in range(N):
            torque = tau_0[s] + y[s] / work.scale[s]
            tau[s] = most[s] if torque > most[s] else least[s] if torque < least[s] else torque
            if held[s] > 0:
                tau[s] = most[s]
            if held[s] < 0:
                tau[s] = least[s]
            if locked[s] != 0:
                tau[s] = 0
                held[s] = 0
            if held[s] != 0:
                flags = flags | bit("LIMITED")
        moved = reals(6)  # V_dot that results
        spins = reals(N)
        lib["solve_coupled"](table, x, *turns, tau, locked, wrench, moved, spins, None)
        residual = reals(m)
        miss(task, table, x, demand, task.use(options), moved, residual)
        check_answer(lib, tau, N)
        check_answer(lib, spins, N)
        check_answer(lib, moved, 6)
        check_answer(lib, residual, m)
        for s in range(N):
            out.tau[s] = tau[s]
            out.phi_ddot[s] = spins[s]
            out.limited[s] = 0 if held[s] == 0 else 1
        for i in range(6):
            out.V_dot[i] = moved[i]
        for i in range(m):
            out.residual[i] = residual[i]
        out.share = share
        return status_of(flags)
