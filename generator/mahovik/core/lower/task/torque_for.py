"""torque_for_TASK: drive torques for chosen components of the carrier's motion, within what the motors have.

W y = r of `torque_demand` and `project_TASK` within bounds on the torques: least error, then torques nearest to those
that give the preferred accelerations. Where the demand is out of reach and its direction is to be kept, the largest
share of it that is not (`largest_share`).
"""

from __future__ import annotations

from mahovik.contract.status import STATUS_VALUES
from mahovik.core.lower.demand import ANSWER_NOTE, check_answer, check_demand
from mahovik.core.lower.excess import check_abilities
from mahovik.core.lower.flywheels import named_turns, turns_of
from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.inverse import flag
from mahovik.core.lower.library import Library
from mahovik.core.lower.task.inverse import FREE_NOTE, task_arguments
from mahovik.core.lower.task.rows import Rows
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Const,
    Convert,
    Expr,
    Not,
    Place,
    and_,
    equal,
    integer,
    magnitude,
    or_,
    real,
    select,
    unequal,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def torque_for_task(lib: Library, rows: Rows) -> Function:
    """tau for the demand of a task, within the motors' torque, speed and power."""
    layout, m, name = lib.layout, len(rows), rows.task.name
    N = layout.count
    given = task_arguments(lib, rows)
    table, x, demand, options, *wrench = given
    locked = lib.locked_argument()
    arguments = (table, x, demand, options, locked, *wrench)
    out = Argument("out", layout.torque_for_result(rows.task), (), "out", purpose="tau, the motion and its quality")
    o, p = out.place, options.place
    use = p.member(f"use_{name}")
    place = {a.name: a.place for a in arguments}
    body = Body()
    check_demand(lib, body, table, x, demand, p, ("damping",), tuple(wrench))
    _check_options(lib, body, p)
    preferred = body.local("preferred", (N,), comment="accelerations towards the wanted speeds")
    _prefer(body, x.place, p, preferred)
    work = body.local("work", (), layout.inverse_work)
    L = body.local("L", (m, m), comment="factor of the norm of the demand")
    tau_0 = body.local("tau_0", (N,), comment="torques of the preferred accelerations")
    turns = turns_of(lib, body, x.place)
    named = place | named_turns(turns) | {"preferred": preferred, "work": work, "tau_0": tau_0}
    base = "torque_demand_turning" if rows.turning else "torque_demand"
    lib.check(body, base, *lib.arguments_of(base, **named))
    project = f"project_{name}"
    body.call(lib[project], *lib.arguments_of(project, **place, use=use, work=work, L=L))
    W = body.local("W", (m * int(N),), comment="rows, one after the other")
    r = body.local("r", (m,))
    with body.loop("i", m) as i:
        body.set(r[i], work.r[i])
        with body.loop("s", N) as s:
            body.set(W[i * int(N) + s], work.W[i][s])
    least, most = body.local("least", (N,), comment="bounds of tau"), body.local("most", (N,))
    low, high = body.local("low", (N,), comment="bounds of y"), body.local("high", (N,))
    _bounds(lib, body, x.place, p, locked.place, (least, most))
    with body.loop("s", N) as s:
        body.set(low[s], (least[s] - tau_0[s]) * work.scale[s])
        body.set(high[s], (most[s] - tau_0[s]) * work.scale[s])
        with body.when(unequal(locked.place[s], integer(0))):
            body.set(low[s], real(0))
            body.set(high[s], real(0))
    y, held = body.local("y", (N,)), body.local("held", (N,), Kind.INT)
    flags, share = body.local("flags", (), Kind.INT), body.local("share")
    body.set(share, real(1))
    body.call(lib[f"bounded_least_squares_{m}"], W, r, low, high, p.weight, y, held)
    beyond = _beyond(lib, body, W, r, y)
    unreachable = Const(STATUS_VALUES["UNREACHABLE"], Kind.INT, "UNREACHABLE")
    body.set(flags, select(beyond, unreachable, integer(0)))
    with body.when(flags > 0), body.when(unequal(p.keep_direction, integer(0))):
        _keep_direction(lib, body, (W, r, low, high, p.weight, y, held), L, demand.place, use, share)
    tau = body.local("tau", (N,))
    with body.loop("s", N) as s:
        found = body.let("found", tau_0[s] + y[s] / work.scale[s])
        body.set(tau[s], select(found > most[s], most[s], select(found < least[s], least[s], found)))
        with body.when(held[s] > 0):
            body.set(tau[s], most[s])
        with body.when(held[s] < 0):
            body.set(tau[s], least[s])
        with body.when(unequal(locked.place[s], integer(0))):
            body.set(tau[s], real(0))
            body.set(held[s], integer(0))
        with body.when(unequal(held[s], integer(0))):
            body.set(flags, flag(flags, "LIMITED"))
    moved, spins = body.local("moved", (6,), comment="V* that results"), body.local("spins", (N,))
    named = place | named_turns(turns) | {"tau": tau, "V_dot": moved, "phi_ddot": spins}
    lib.check(body, "solve_coupled", *lib.arguments_of("solve_coupled", **named))
    residual = rows.residual(body, place, moved, use)
    check_answer(lib, body, tau, N)
    check_answer(lib, body, spins, N)
    check_answer(lib, body, moved, 6)
    check_answer(lib, body, residual, m)
    with body.loop("s", N) as s:
        body.set(o.tau[s], tau[s])
        body.set(o.phi_ddot[s], spins[s])
        body.set(o.limited[s], select(equal(held[s], integer(0)), integer(0), integer(1)))
    with body.loop("i", 6) as i:
        body.set(o.V_dot[i], moved[i])
    with body.loop("i", m) as i:
        body.set(o.residual[i], residual[i])
    body.set(o.share, share)
    body.ret(Convert(flags, Kind.STATUS))
    return Function(
        f"torque_for_{name}",
        f"Drive torques for the task {name}, within what the motors have. Least error in the norm of "
        "(S K_c^-1 S^T)^-1, K_c = K - sum I I^T / Theta_ff of the free flywheels; then torques nearest to those of the "
        "preferred accelerations.",
        (*arguments, out),
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "LIMITED", "UNREACHABLE"),
        notes=(
            "With keep_direction a demand out of reach is made smaller, not turned: share is the part that is met.",
            "A flywheel whose lock or failure is known goes into `locked`: the others do its part.",
            f"Directions in which torques move the carrier {lib.thresholds.bounded**0.5:.0e} times less than in the "
            "strongest are given up in part.",
            "Positive statuses are bits and may be combined.",
            FREE_NOTE,
            ANSWER_NOTE,
        ),
        public=True,
    )


def _check_options(lib: Library, body: Body, p: Place) -> None:
    """Refuses options of motors and wanted speeds that are no numbers, negative or out of range."""
    speed = lib.limits["MAX_SPEED"].expression
    with body.loop("s", lib.layout.count) as s:
        check_abilities(lib, body, p, s)
        power = p.motor_power[s]
        lib.guard(body, Not(or_(power > 0, power <= 0)), "NOT_FINITE")
        lib.guard(body, power < 0, "BAD_ARGUMENT")
    lib.check(body, "within", p.target_speed, lib.layout.count, speed)
    for number in (p.target_rate, p.avoid_speed):
        with body.block():
            lib.check_number(body, number, speed)
    lib.guard(body, or_(p.target_rate < 0, p.avoid_speed < 0), "BAD_ARGUMENT")


def _prefer(body: Body, x: Place, p: Place, preferred: Place) -> None:
    """target_rate times what is missing to the wanted speed; inside the avoided speeds, to their end."""
    with body.loop("s", len(preferred)) as s:
        speed = body.let("speed", x.phi_dot[s])
        target = body.local("target")
        body.set(target, p.target_speed[s])
        with body.when(magnitude(target) < p.avoid_speed):
            body.note("a wanted speed that is to be avoided: the end of its side, or of the side where the flywheel is")
            side = body.let("side", select(equal_to_zero(target), speed, target))
            body.set(target, select(side < 0, -p.avoid_speed, p.avoid_speed))
        body.set(preferred[s], p.target_rate * (target - speed))


def equal_to_zero(value: Expr) -> Expr:
    """Whether a real is zero."""
    return and_(value <= 0, value >= 0)


def _bounds(lib: Library, body: Body, x: Place, p: Place, locked: Place, bounds: tuple[Place, Place]) -> None:
    """Torques that each motor has at its speed: driving, less with speed and by its power; braking, all of it."""
    least, most = bounds
    cap = lib.limits["MAX_WRENCH"].expression
    with body.loop("s", lib.layout.count) as s:
        speed = body.let("speed", x.phi_dot[s])
        size = body.let("size", magnitude(speed))
        whole = body.let("whole", select(p.motor_torque[s] < cap, p.motor_torque[s], cap))
        part = body.let("part", 1 - size / p.motor_speed[s])
        driving = body.local("driving")
        body.set(driving, select(part > 0, whole * part, real(0)))
        with body.when(driving * size > p.motor_power[s]):
            body.set(driving, p.motor_power[s] / size)
        body.set(most[s], select(speed > 0, driving, whole))
        body.set(least[s], select(speed < 0, -driving, -whole))


def _beyond(lib: Library, body: Body, W: Place, r: Place, y: Place) -> Expr:
    """Whether W y = r is not met."""
    left, wanted = body.local("left"), body.local("wanted")
    body.set(left, real(0))
    body.set(wanted, real(0))
    with body.loop("i", len(r)) as i:
        rest = body.local("rest")
        body.set(rest, r[i])
        with body.loop("s", len(y)) as s:
            body.add(rest, -(W[i * len(y) + s] * y[s]))
        body.add(left, rest * rest)
        body.add(wanted, r[i] * r[i])
    tolerance = lib.thresholds.unreachable
    return left > tolerance * tolerance * wanted


def _keep_direction(
    lib: Library, body: Body, system: tuple[Place, ...], L: Place, demand: Place, use: Place, share: Place
) -> None:
    """The largest share of the demand, and y for it; least error of demand 0 where not even that can be met."""
    W, r, low, high, weight, y, held = system
    m = len(r)
    start, towards = body.local("start", (m,)), body.local("towards", (m,))
    body.note("r = start + towards: that of demand 0, and -L^-1 demand")
    with body.loop("i", m) as i:
        body.set(towards[i], select(use[i] > 0, -demand[i], real(0)))
        with body.loop("k", i) as k:
            body.add(towards[i], -(L[i][k] * towards[k]))
        body.set(towards[i], towards[i] / L[i][i])
        body.set(start[i], r[i] - towards[i])
    body.set(share, lib[f"largest_share_{m}"](W, low, high, start, towards, y))
    with body.when(share < 0):
        body.set(share, real(0))
        body.call(lib[f"bounded_least_squares_{m}"], W, start, low, high, weight, y, held)
    with body.otherwise(), body.loop("s", len(y)) as s:
        body.set(held[s], select(y[s] >= high[s], integer(1), select(y[s] <= low[s], integer(-1), integer(0))))
