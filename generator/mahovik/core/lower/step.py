"""step: the whole state a time step on, by Runge-Kutta of fourth order or by the midpoint rule."""

from __future__ import annotations

from collections.abc import Sequence

from mahovik.core.formula.derived import motion as derived
from mahovik.core.lower.drive import check_drive
from mahovik.core.lower.flywheels import turns_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body, call
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, Status, and_, as_expr, equal, integer, or_, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def add_all(lib: Library) -> None:
    """Adds the step functions: by torques, and by given accelerations of the flywheels."""
    lib.add(_advance(lib))
    lib.add(_finish(lib))
    if lib.layout.flywheels:
        lib.add(_rate(lib, torques=True))
        lib.add(_step(lib, torques=True))
    lib.add(_rate(lib, torques=False))
    lib.add(_step(lib, torques=False))


def _drive_arguments(lib: Library, torques: bool) -> tuple[Argument, ...]:
    """What drives the flywheels during a step, held constant, and the run-time wrenches."""
    count = lib.layout.count
    if not torques:
        return (*lib.phi_ddot_arguments(), *lib.wrench_arguments())
    return (
        Argument("tau", Kind.REAL, (count,), unit="N m", purpose="drive torques, mount on flywheel"),
        lib.locked_argument(),
        *lib.wrench_arguments(),
    )


def _rate(lib: Library, torques: bool) -> Function:
    """Rates of all members of a state."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    drive = _drive_arguments(lib, torques)
    rate = Argument("rate", layout.state, (), "out", purpose="rates of the members of the state")
    body = Body()
    lib.begin(body)
    C = body.local("C", (9,), comment="attitude")
    inputs = [*turns_of(lib, body, x.place), *(a.place for a in drive)]
    out = rate.place
    if torques:
        lib.check(body, "solve_coupled", table.place, x.place, *inputs, out.V, out.phi_dot)
    else:
        lib.check(body, "accelerate", table.place, x.place, *inputs, out.V)
    body.call(lib["rotation"], x.place.attitude, C)
    bound = parts_of_twist(x.place.V) | {"C": C, "q": x.place.attitude}
    assign(body, list(out.position), derived.position_rate(), bound)
    assign(body, list(out.attitude), derived.quaternion_rate(), bound)
    if layout.flywheels:
        with body.loop("s", layout.count) as s:
            body.set(out.phi[s], x.place.phi_dot[s])
            if not torques:
                body.set(out.phi_dot[s], drive[0].place[s])
    body.ret(Status("OK"))
    return Function(
        "rate" if torques or not layout.flywheels else "rate_driven",
        "Rates of the state under " + ("drive torques." if torques else "given flywheel accelerations."),
        (table, x, *drive, rate),
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _members(lib: Library) -> Sequence[tuple[str, Expr]]:
    """Members of a state with their lengths."""
    return [(f.name, as_expr(f.shape[0], Kind.INT)) for f in lib.layout.state.fields]


def _advance(lib: Library) -> Function:
    """to = x + h rate, phases within half a turn."""
    x = lib.state_argument()
    rate = Argument("rate", lib.layout.state)
    h = Argument("h", Kind.REAL, unit="s")
    to = Argument("to", lib.layout.state, (), "out", purpose="must not be x or rate")
    body = Body()
    for name, count in _members(lib):
        with body.loop("i", count) as i:
            start: Expr = x.place.member(name)[i]
            if name == "phi":  # so that the phases of a stage, and their sum at the end, keep their digits
                start = call(lib["wrapped"], start)
            body.set(to.place.member(name)[i], start + h.place * rate.place.member(name)[i])
    return Function(
        "advance",
        "to = x + h rate, phases from within half a turn.",
        (x, rate, h, to),
        body.statements,
    )


def _finish(lib: Library) -> Function:
    """Unit length for the quaternion, phases within half a turn; and is the state still in its ranges?"""
    x = Argument("x", lib.layout.state, (), "inout")
    body = Body()
    lib.begin(body)
    q = x.place.attitude
    square = body.let("square", q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    lib.guard(body, Not(and_(square > real(0.5), square < real(2))), "RANGE")
    inverse = body.let("inverse", 1 / call(lib["sqrt"], square))
    for i in range(4):
        body.set(q[i], q[i] * inverse)
    lib.check(body, "check_state", x.place)
    if lib.layout.flywheels:
        with body.loop("s", lib.layout.count) as s:
            body.set(x.place.phi[s], call(lib["wrapped"], x.place.phi[s]))
    body.ret(Status("OK"))
    return Function(
        "finish",
        "Quaternion to unit length, phases to half a turn; RANGE where the state has left its ranges.",
        (x,),
        body.statements,
        returns=Kind.STATUS,
        statuses=STATE_STATUSES,
    )


def _step(lib: Library, torques: bool) -> Function:
    """One step of RK4 or of the midpoint rule."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    drive = _drive_arguments(lib, torques)
    dt = Argument("dt", Kind.REAL, unit="s", purpose="time step, greater than 0")
    order = Argument("order", Kind.INT, purpose="4: Runge-Kutta, four evaluations; 2: midpoint rule, two")
    out = Argument("next", layout.state, (), "out", purpose="state after the step; may be x itself")
    name = "rate" if torques or not layout.flywheels else "rate_driven"
    body = Body()
    if torques:
        check_drive(lib, body, (table, x, *drive))
    else:
        check_inputs(lib, body, table, x, drive[: 1 if layout.flywheels else 0], lib_wrench(drive))
    h = dt.place
    given = body.local("given", (1,))
    body.set(given[0], h)
    lib.check(body, "within", given, 1, lib.limits["MAX_STEP"].expression)
    lib.guard(body, Not(h > 0), "BAD_ARGUMENT")
    known = or_(equal(order.place, integer(4)), equal(order.place, integer(2)))
    lib.guard(body, Not(known), "BAD_ARGUMENT")
    inputs = [a.place for a in drive]
    k = body.local("k", (), layout.state, "rates of a stage")
    y = body.local("y", (), layout.state, "state of a stage; then the new state")
    lib.check(body, name, table.place, x.place, *inputs, k)
    half = body.let("half", real(0.5) * h)
    with body.when(equal(order.place, integer(2))):
        body.call(lib["advance"], x.place, k, half, y)
        lib.check(body, name, table.place, y, *inputs, k)
        body.call(lib["advance"], x.place, k, h, y)
    with body.otherwise():
        total = body.local("total", (), layout.state, "k1 + 2 k2 + 2 k3 + k4")
        body.copy(total, k)
        for weight, length in ((2, half), (2, half), (1, h)):
            body.call(lib["advance"], x.place, k, length, y)
            lib.check(body, name, table.place, y, *inputs, k)
            _accumulate(lib, body, total, k, weight)
        sixth = body.let("sixth", h / 6)
        body.call(lib["advance"], x.place, total, sixth, y)
    lib.check(body, "finish", y)
    body.copy(out.place, y)
    body.ret(Status("OK"))
    what = "drive torques" if torques else "given flywheel accelerations"
    return Function(
        "step" if torques or not layout.flywheels else "step_driven",
        f"State a time step later, under {what} and wrenches held constant.",
        (table, x, *drive, dt, order, out),
        body.statements,
        returns=Kind.STATUS,
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT"),
        notes=("RANGE also where the new state would leave its ranges.",),
        public=True,
    )


def lib_wrench(drive: tuple[Argument, ...]) -> tuple[Argument, ...]:
    """The run-time wrenches among the arguments."""
    return tuple(a for a in drive if a.name == "wrench")


def _accumulate(lib: Library, body: Body, total: Place, k: Place, weight: int) -> None:
    for name, count in _members(lib):
        with body.loop("i", count) as i:
            value: Expr = k.member(name)[i]
            body.add(total.member(name)[i], real(weight) * value if weight != 1 else value)
