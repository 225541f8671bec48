"""step: the whole state one time step later, by Runge-Kutta of fourth order or by the midpoint rule.

The sum of a state and a small increment loses up to half a unit in the last place of the state: in float all of an
increment below 3e-8 of it. What a sum of two numbers loses is a number itself, which six additions give exactly, the
TwoSum of Knuth. It goes into the carry, if a caller has one, and from there into the increment of the next step.
"""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.formula.derived import motion as derived
from mahovik.core.lower import hold
from mahovik.core.lower.drive import check_drive
from mahovik.core.lower.flywheels import named_turns, turns_of
from mahovik.core.lower.forward import STATE_STATUSES, check_inputs
from mahovik.core.lower.library import Library
from mahovik.core.lower.solve import parts_of_twist
from mahovik.core.lower.symbolic import assign
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Expr,
    Given,
    Not,
    Operand,
    Place,
    and_,
    as_expr,
    equal,
    integer,
    or_,
    real,
    select,
)  # fmt: skip
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.real_constants import PI, nearest
from mahovik.core.routines.wrap import turn_parts, turns_of_angle


def add_all(lib: Library) -> None:
    """Adds the step functions: by torques, and by given accelerations of the flywheels; and `wrap`."""
    lib.add(_advance(lib))
    lib.add(_finish(lib))
    lib.add(_carry_over(lib))
    for torques in (True, False) if lib.layout.flywheels else (False,):
        lib.add(_rate(lib, torques))
        lib.add(_stages(lib, torques))
        lib.add(_step(lib, torques))
    if lib.layout.flywheels:
        lib.add(_wrap(lib))


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
    rate = Argument("rate", layout.state, (), "out", purpose="time derivatives of the members of the state")
    body = Body()
    C = body.local("C", (9,), comment="attitude")
    turns = turns_of(lib, body, x.place)
    out = rate.place
    others = [body.local(a.name, a.shape) for a in hold.results(lib)]
    given = {"table": table.place, "x": x.place, "V_dot": out.V, **named_turns(turns)}
    given |= {a.name: a.place for a in drive}
    given |= {a.name: found for a, found in zip(hold.results(lib), others, strict=True)}
    if torques:
        given["phi_ddot"] = out.phi_dot
    motion = "solve_coupled" if torques else "accelerate"
    lib.check(body, motion, *lib.arguments_of(motion, **given))
    if layout.held and not torques:
        hold.write_twist.put_into(body, lib, table.place, others, out.V)
    body.call(lib["rotation"], x.place.attitude, C)
    bound = parts_of_twist(x.place.V) | {"C": C, "q": x.place.attitude}
    assign(body, list(out.position), derived.position_rate(), bound)
    assign(body, list(out.attitude), derived.quaternion_rate(), bound)
    if layout.flywheels:
        with body.loop("s", layout.count) as s:
            body.set(out.phi[s], x.place.phi_dot[s])
            if not torques:
                body.set(out.phi_dot[s], drive[0].place[s])
    return body.checked_function(
        _form_name(lib, "rate", torques),
        "Time derivatives of the state under " + ("drive torques." if torques else "given flywheel accelerations."),
        (table, x, *drive, rate),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _numbers(lib: Library) -> Iterator[tuple[str, Expr, int]]:
    """Members of a state with their lengths, and where each begins among all numbers of a state."""
    first = 0
    for f in lib.layout.state.fields:
        yield f.name, as_expr(f.shape[0], Kind.INT), first
        first += int(f.shape[0])


def _advance(lib: Library) -> Function:
    """to = x + h rate, phases within half a turn."""
    x = lib.state_argument()
    rate = Argument("rate", lib.layout.state)
    h = Argument("h", Kind.REAL, unit="s")
    to = Argument("to", lib.layout.state, (), "out", purpose="must not be x or rate")
    body = Body()
    for name, count, _ in _numbers(lib):
        with body.loop("i", count) as i:
            start: Expr = x.place.member(name)[i]
            if name == "phi":  # so that the phases of a stage, and their sum at the end, keep their digits
                start = lib["wrapped"](start)
            body.set(to.place.member(name)[i], start + h.place * rate.place.member(name)[i])
    return body.function(
        "advance", "Sets to = x + h rate, after wrapping the phases to within half a turn.", (x, rate, h, to)
    )


def _finish(lib: Library) -> Function:
    """Unit length for the quaternion, phases within half a turn; and is the state still in its ranges?"""
    x = Argument("x", lib.layout.state, (), "inout")
    body = Body()
    q = x.place.attitude
    square = body.let("square", q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    lib.guard(body, Not(and_(square > real(0.5), square < real(2))), "RANGE")
    inverse = body.let("inverse", 1 / lib["sqrt"](square))
    for i in range(4):
        body.set(q[i], q[i] * inverse)
    _check_again(lib, body, x.place)
    if lib.layout.flywheels:
        with body.loop("s", lib.layout.count) as s:
            body.set(x.place.phi[s], lib["wrapped"](x.place.phi[s]))
    return body.checked_function(
        "finish",
        "Normalizes the quaternion and wraps the phases to [-pi, pi]; RANGE if the state is out of range.",
        (x,),
        statuses=STATE_STATUSES,
    )


def _sum(body: Body, a: Expr, b: Expr, name: str) -> tuple[Place, Expr]:
    """a + b rounded, and what rounding took from it."""
    total = body.let(name, a + b)
    part = body.let(f"{name}_b", total - a)
    return total, (a - (total - part)) + (b - part)


def _carry_over(lib: Library) -> Function:
    """`advance` and `finish`, and of a held carrier `keep_pivot`, by sums whose rounding the carry keeps."""
    table, x = lib.table_argument(), lib.state_argument()
    rate = Argument("rate", lib.layout.state)
    h = Argument("h", Kind.REAL, unit="s")
    carry = Argument("carry", lib.layout.carry, (), "inout")
    to = Argument("to", lib.layout.state, (), "out", purpose="must not be x or rate")
    precision, first = lib.layout.precision, {name: first for name, _, first in _numbers(lib)}
    body = Body()
    kept = body.local("kept", (), lib.layout.carry, "the new carry")
    body.copy(kept, carry.place)
    lost = kept.rounding
    for name, count, begin in _numbers(lib):
        with body.loop("i", count) as i:
            start: Expr = x.place.member(name)[i]
            if name == "phi":
                start = body.let("start", lib["wrapped"](start))
            here = lost[i + begin if begin else i]
            step = body.let("step", h.place * rate.place.member(name)[i] + here)
            total, rest = _sum(body, start, step, "sum")
            if name == "phi":  # less its whole turns; the product with the first part of 2 pi is exact
                k = body.let("k", turns_of_angle(precision, total), "turns")
                one, two, three = turn_parts(precision)
                left = body.let("left", total - k * real(one))
                within, more = _sum(body, left, -(k * real(two)), "within")
                rest, total = rest + (more - k * real(three)), within
            body.set(here, rest)
            body.set(to.place.member(name)[i], total)
    q = to.place.attitude
    square = body.let("square", q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    lib.guard(body, Not(and_(square > real(0.5), square < real(2))), "RANGE")
    body.note("1/|q| - 1, without the digits that the difference would lose")
    excess = body.let("excess", (1 - square) / (lib["sqrt"](square) + square))
    with body.loop("i", 4) as i:
        here = lost[i + first["attitude"]]
        total, rest = _sum(body, q[i], body.let("step", q[i] * excess + here), "sum")
        body.set(here, rest)
        body.set(q[i], total)
    _check_again(lib, body, to.place)
    if lib.layout.held:
        _carry_pivot(lib, body, table.place, x.place, to.place, carry.place.rounding, lost, first["position"])
    body.copy(carry.place, kept)
    return body.checked_function(
        "carry_over",
        "Sets to = x + h rate with phases in [-pi, pi] and a quaternion of unit length, and keeps in the carry what "
        "rounding takes from the sums; RANGE if the state is out of range.",
        (table, x, rate, h, carry, to),
        statuses=STATE_STATUSES,
    )


def _carry_pivot(
    lib: Library, body: Body, table: Place, x: Place, y: Place, before: Place, after: Place, first: int
) -> None:
    """Takes from a step, and from its carry, what moved the pivot where the hold does not let it go.

    How far the pivot went is a difference of near numbers, which rounding hardly changes, and it goes into a sum that
    is compensated: what the steps add up to stays at the pivot, however many they are.
    """
    C, arm, reached = hold.pivot_arms.put_into(body, lib, table, x, y)
    way = body.local("way", (3,), comment="how the pivot went, in E0")
    for i in range(3):
        moved = (y.position[i] - x.position[i]) + (reached[i] - arm[i])
        body.set(way[i], moved + (after[first + i] - before[first + i]))
    slid = hold.allowed_way.put_into(body, lib, table, C, way)
    for i in range(3):
        with body.block():
            part = body.let("part", after[first + i] - (way[i] - slid[i]))
            total, rest = _sum(body, y.position[i], part, "sum")
            body.set(after[first + i], rest)
            body.set(y.position[i], total)


def _check_again(lib: Library, body: Body, x: Place) -> None:
    """Check of a state in a step, by a function that the step needs anyway: speeds are looked at twice."""
    if "check_motion" in lib and not lib.layout.stream and not lib.layout.inputs:
        lib.check(body, "check_motion", x, x.phi_dot, lib.limits["MAX_SPEED"].expression)
    else:
        lib.check(body, "check_state", x)


def _stages(lib: Library, torques: bool) -> Function:
    """The evaluations of one step: the weighted sum of the rates, which times h or h/6 is the increment."""
    layout = lib.layout
    table, x = lib.table_argument(), lib.state_argument()
    drive = _drive_arguments(lib, torques)
    h = Argument("h", Kind.REAL, unit="s")
    order = Argument("order", Kind.INT, purpose="2 or 4")
    stage = Argument("y", layout.state, (), "out", purpose="scratch: states of the stages")
    total = Argument("total", layout.state, (), "out", purpose="order 4: k1 + 2 k2 + 2 k3 + k4; order 2: k2")
    body = Body()
    y, sum_ = stage.place, total.place
    k = body.local("k", (), layout.state, "time derivatives at a stage")
    rate = _form_name(lib, "rate", torques)

    def rate_at(at: Place, out: Place) -> list[Operand]:
        return lib.arguments_of(rate, table=table.place, x=at, rate=out, **{a.name: a.place for a in drive})

    lib.check(body, rate, *rate_at(x.place, k))
    half = body.let("half", real(0.5) * h.place)
    with body.when(equal(order.place, integer(2))):
        body.call(lib["advance"], x.place, k, half, y)
        lib.check_as(body, "RANGE", rate, *rate_at(y, sum_))
    with body.otherwise():
        body.copy(sum_, k)
        for weight, length in ((2, half), (2, half), (1, h.place)):
            body.call(lib["advance"], x.place, k, length, y)
            lib.check_as(body, "RANGE", rate, *rate_at(y, k))
            _accumulate(lib, body, sum_, k, weight)
    return body.checked_function(
        _form_name(lib, "stages", torques),
        "Evaluations of one step: the sum of the rates at its stages. A stage without an answer is RANGE.",
        (table, x, *drive, h, order, stage, total),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE"),
    )


def _form_name(lib: Library, name: str, torques: bool) -> str:
    """Name of the form of a function for torques, or for given accelerations; one of both without flywheels."""
    return name if torques or not lib.layout.flywheels else f"{name}_driven"


def _check_step(lib: Library, body: Body, arguments: tuple[Argument, ...], torques: bool) -> None:
    """Checks of the arguments of a step."""
    by_name = {a.name: a for a in arguments}
    if torques:
        check_drive(lib, body, arguments)
    else:
        accelerations = tuple(a for a in arguments if a.name == "phi_ddot")
        wrench = tuple(a for a in arguments if a.name == "wrench")
        check_inputs(lib, body, by_name["table"], by_name["x"], accelerations, wrench)
    dt, order = by_name["dt"].place, by_name["order"].place
    lib.check_number(body, dt, lib.limits["MAX_STEP"].expression)
    lib.guard(body, Not(dt > 0), "BAD_ARGUMENT")
    lib.guard(body, Not(or_(equal(order, integer(4)), equal(order, integer(2)))), "BAD_ARGUMENT")


def _step_arguments(lib: Library, torques: bool) -> tuple[Argument, ...]:
    """table, x, what drives the flywheels, dt, order."""
    return (
        lib.table_argument(),
        lib.state_argument(),
        *_drive_arguments(lib, torques),
        Argument("dt", Kind.REAL, unit="s", purpose="time step, greater than 0"),
        Argument("order", Kind.INT, purpose="4: Runge-Kutta, four evaluations; 2: midpoint rule, two"),
    )


def _notes(lib: Library) -> tuple[str, ...]:
    """Notes on step and step_driven for the header."""
    notes = (
        "RANGE also if a stage of the step or the new state is out of range.",
        "COARSE: dt times the fastest of |phi_dot| and |omega| is above MAX_TURN_4 rad (order 2: MAX_TURN_2). At this "
        "bound the vibration of an unbalance is wrong by 3e-4 of its size after a turn, one of twice the speed "
        "(asymmetry) by 4e-3 (order 2: 1e-3). Errors grow with dt^4 (dt^2), beyond twice the bound faster.",
        "A carry belongs to its state: where another state is set, set the carry to zero.",
    )
    if lib.layout.precision.name == "double":
        return notes
    return (
        *notes,
        "Of an increment all is lost that is below 6e-8 of the number it goes to: for short steps, slow motions and "
        "places far from the origin pass a carry.",
    )


def _fastest(lib: Library, body: Body, x: Place) -> Place:
    """Square of the fastest turning of carrier and flywheels, (rad/s)^2."""
    omega = x.V
    found = body.local("fastest", comment="square of the fastest turning, (rad/s)^2")
    body.set(found, omega[3] * omega[3] + omega[4] * omega[4] + omega[5] * omega[5])
    if lib.layout.flywheels:
        with body.loop("s", lib.layout.count) as s:
            square = body.let("square", x.phi_dot[s] * x.phi_dot[s])
            body.set(found, select(square > found, square, found))
    return found


def _step(lib: Library, torques: bool) -> Function:
    """One step of RK4 or of the midpoint rule."""
    purpose = "of the step before; at first all zero; null: what rounding takes is lost"
    carry = Argument("carry", lib.layout.carry, (), "inout", purpose=purpose, optional="missing")
    out = Argument("next", lib.layout.state, (), "out", purpose="state after the step; may be x itself")
    arguments = _step_arguments(lib, torques)
    place = {a.name: a.place for a in arguments}
    table, x, dt, order = (place[name] for name in ("table", "x", "dt", "order"))
    body = Body()
    _check_step(lib, body, arguments, torques)
    numbers = carry.place.rounding
    with body.when(Given(carry.place)):
        lib.check(body, "within", numbers, len(numbers), lib.limits["MAX_ROUNDING"].expression)
    y = body.local("y", (), lib.layout.state, "state of a stage; then the new state")
    total = body.local("total", (), lib.layout.state, "sum of the rates at the stages")
    stages = _form_name(lib, "stages", torques)
    lib.check(body, stages, *lib.arguments_of(stages, **place, y=y, total=total, h=dt))
    over = body.let("over", select(equal(order, integer(2)), dt, dt / 6), "times the sum: the increment")
    turning = _fastest(lib, body, x)
    named = {"table": table, "x": x, "rate": total, "h": over, "carry": carry.place, "to": y}
    with body.when(Given(carry.place)):
        lib.check_as(body, "RANGE", "carry_over", *lib.arguments_of("carry_over", **named))
    with body.otherwise():
        body.call(lib["advance"], x, total, over, y)
        lib.check_as(body, "RANGE", "finish", y)
        if lib.layout.held:
            body.call(lib["keep_pivot"], table, x, y)
    body.copy(out.place, y)
    limits = (lib.limits[name].expression for name in ("MAX_TURN_2", "MAX_TURN_4"))
    most = body.let("most", select(equal(order, integer(2)), *limits), "rad")
    lib.guard(body, dt * dt * turning > most * most, "COARSE")
    what = "drive torques" if torques else "given flywheel accelerations"
    return body.checked_function(
        _form_name(lib, "step", torques),
        f"State after one time step; {what} and wrenches are held constant.",
        (*arguments, carry, out),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "COARSE"),
        notes=_notes(lib),
        public=True,
    )


def _accumulate(lib: Library, body: Body, total: Place, k: Place, weight: int) -> None:
    for name, count, _ in _numbers(lib):
        with body.loop("i", count) as i:
            value: Expr = k.member(name)[i]
            body.add(total.member(name)[i], real(weight) * value if weight != 1 else value)


def _wrap(lib: Library) -> Function:
    """The angle wrapped to [-pi, pi], with a status."""
    precision = lib.layout.precision
    phi = Argument("phi", Kind.REAL, unit="rad", purpose="any angle within MAX_PHASE")
    out = Argument("wrapped", Kind.REAL, (), "out", "rad", "the same angle in [-pi, pi]")
    pi = real(nearest(PI, precision))
    body = Body()
    lib.check_number(body, phi.place, lib.limits["MAX_PHASE"].expression)
    k = body.local("k", comment="nearest number of turns; may be off by one next to an odd multiple of pi")
    angle = body.local("angle")
    body.set(k, turns_of_angle(precision, phi.place))
    body.set(angle, lib["unwound"](phi.place, k))
    with body.when(or_(angle > pi, angle < -pi)):
        body.set(angle, lib["unwound"](phi.place, select(angle > pi, k + 1, k - 1)))
    body.set(out.place, select(angle > pi, pi, select(angle < -pi, -pi, angle)))
    error = {"double": "5e-16", "float": "3e-7"}[precision.name]
    return body.checked_function(
        "wrap",
        "The angle wrapped to [-pi, pi] (pi rounded to the nearest real).",
        (phi, out),
        notes=(f"Error below {error} rad, modulo one turn.",),
        public=True,
    )
