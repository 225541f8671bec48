"""step_carried: a step that keeps what rounding takes from the state, and adds it in the next step.

The sum of a state and a small increment loses up to half a unit in the last place of the state: in float all of an
increment below 3e-8 of it. What a sum of two numbers loses is a number itself, which six additions give exactly, the
TwoSum of Knuth. It goes into a carry, and from there into the increment of the next step.
"""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.core.lower.forward import STATE_STATUSES
from mahovik.core.lower.hold import allowed_way, pivot_arms
from mahovik.core.lower.library import Library
from mahovik.core.lower.step import (
    check_again,
    check_step,
    fastest,
    finish_step,
    form_name,
    increment,
    next_argument,
    step_arguments,
)
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import Expr, Not, Place, and_, as_expr, real
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.wrap import turn_parts, turns_of_angle


def add_all(lib: Library) -> None:
    """Adds the step functions with a carry: by torques, and by given accelerations of the flywheels."""
    lib.add(_advance(lib))
    lib.add(_finish(lib))
    if lib.layout.held:
        lib.add(_keep_pivot(lib))
    for torques in (True, False) if lib.layout.flywheels else (False,):
        lib.add(_step(lib, torques))


def _carry(lib: Library) -> Argument:
    return Argument("carry", lib.layout.carry, (), "inout", purpose="of the step before; at first all zero")


def _numbers(lib: Library) -> Iterator[tuple[str, Expr, int]]:
    """Members of a state with their lengths, and where each begins among all numbers of a state."""
    first = 0
    for f in lib.layout.state.fields:
        yield f.name, as_expr(f.shape[0], Kind.INT), first
        first += int(f.shape[0])


def _sum(body: Body, a: Expr, b: Expr, name: str) -> tuple[Place, Expr]:
    """a + b rounded, and what rounding took from it."""
    total = body.let(name, a + b)
    part = body.let(f"{name}_b", total - a)
    return total, (a - (total - part)) + (b - part)


def _advance(lib: Library) -> Function:
    """to = x + (h rate + rounding), and the new rounding."""
    x = lib.state_argument()
    rate = Argument("rate", lib.layout.state)
    h = Argument("h", Kind.REAL, unit="s")
    carry = Argument("carry", lib.layout.carry, (), "inout")
    to = Argument("to", lib.layout.state, (), "out", purpose="must not be x or rate")
    precision = lib.layout.precision
    body = Body()
    for name, count, first in _numbers(lib):
        with body.loop("i", count) as i:
            start: Expr = x.place.member(name)[i]
            if name == "phi":
                start = body.let("start", lib["wrapped"](start))
            kept = carry.place.rounding[i + first if first else i]
            step = body.let("step", h.place * rate.place.member(name)[i] + kept)
            total, lost = _sum(body, start, step, "sum")
            if name == "phi":  # less its whole turns; the product with the first part of 2 pi is exact
                k = body.let("k", turns_of_angle(precision, total), "turns")
                one, two, three = turn_parts(precision)
                left = body.let("left", total - k * real(one))
                within, more = _sum(body, left, -(k * real(two)), "within")
                body.set(kept, lost + (more - k * real(three)))
                total = within
            else:
                body.set(kept, lost)
            body.set(to.place.member(name)[i], total)
    return body.function(
        "advance_carried",
        "Sets to = x + h rate with phases in [-pi, pi], and keeps in the carry what rounding takes from the sums.",
        (x, rate, h, carry, to),
    )


def _finish(lib: Library) -> Function:
    """Normalises the quaternion, keeping what rounding takes in the carry; refuses a state beyond its ranges."""
    x = Argument("x", lib.layout.state, (), "inout")
    carry = Argument("carry", lib.layout.carry, (), "inout")
    body = Body()
    q = x.place.attitude
    first = next(first for name, _, first in _numbers(lib) if name == "attitude")
    square = body.let("square", q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    lib.guard(body, Not(and_(square > real(0.5), square < real(2))), "RANGE")
    body.note("1/|q| - 1, without the digits that the difference would lose")
    excess = body.let("excess", (1 - square) / (lib["sqrt"](square) + square))
    with body.loop("i", 4) as i:
        kept = carry.place.rounding[i + first]
        step = body.let("step", q[i] * excess + kept)
        total, lost = _sum(body, q[i], step, "sum")
        body.set(kept, lost)
        body.set(q[i], total)
    check_again(lib, body, x.place)
    return body.checked_function(
        "finish_carried",
        "Normalizes the quaternion, rounding kept in the carry; RANGE if the state is out of range.",
        (x, carry),
        statuses=STATE_STATUSES,
    )


def _keep_pivot(lib: Library) -> Function:
    """Takes from a step, and from its carry, what moved the pivot where the hold does not let it go.

    How far the pivot went is a difference of near numbers, which rounding hardly changes, and it goes into a sum that
    is compensated: what the steps add up to stays at the pivot, however many they are.
    """
    table, x = lib.table_argument(), lib.state_argument()
    before = Argument("before", lib.layout.carry, purpose="of the state before the step")
    after = Argument("y", lib.layout.state, (), "inout", purpose="state after the step")
    carry = Argument("carry", lib.layout.carry, (), "inout", purpose="of the state after the step")
    first = next(first for name, _, first in _numbers(lib) if name == "position")
    body = Body()
    C, arm, reached = pivot_arms.put_into(body, lib, table.place, x.place, after.place)
    way = body.local("way", (3,), comment="how the pivot went, in E0")
    for i in range(3):
        moved = (after.place.position[i] - x.place.position[i]) + (reached[i] - arm[i])
        kept = carry.place.rounding[first + i] - before.place.rounding[first + i]
        body.set(way[i], moved + kept)
    slid = allowed_way.put_into(body, lib, table.place, C, way)
    for i in range(3):
        with body.block():
            part = carry.place.rounding[first + i] - (way[i] - slid[i])
            total, lost = _sum(body, after.place.position[i], body.let("part", part), "sum")
            body.set(carry.place.rounding[first + i], lost)
            body.set(after.place.position[i], total)
    return body.function(
        "keep_pivot_carried",
        "Puts the pivot of the hold back to where it can slide, by a sum that the carry compensates.",
        (table, x, before, after, carry),
    )


def _step(lib: Library, torques: bool) -> Function:
    """One step with a carry."""
    arguments, carry, out = step_arguments(lib, torques), _carry(lib), next_argument(lib)
    x = arguments[1]
    body = Body()
    check_step(lib, body, arguments, torques)
    numbers = carry.place.rounding
    lib.check(body, "within", numbers, len(numbers), lib.limits["MAX_ROUNDING"].expression)
    y, total, over = increment(lib, body, arguments, torques)
    turning = fastest(lib, body, x.place)
    kept = body.local("kept", (), lib.layout.carry, "the new carry")
    body.copy(kept, carry.place)
    body.call(lib["advance_carried"], x.place, total, over, kept, y)
    lib.check_as(body, "RANGE", "finish_carried", y, kept)
    if lib.layout.held:
        body.call(lib["keep_pivot_carried"], arguments[0].place, x.place, carry.place, y, kept)
    finish_step(lib, body, arguments, turning, ((carry.place, kept), (out.place, y)))
    what = "drive torques" if torques else "given flywheel accelerations"
    return body.checked_function(
        form_name(lib, "step", torques) + "_carried",
        f"State after one time step under {what} and wrenches, held constant; sums are compensated by a carry.",
        (*arguments, carry, out),
        statuses=(*STATE_STATUSES, "NOT_POSITIVE_DEFINITE", "BAD_ARGUMENT", "COARSE"),
        notes=(
            f"Statuses as of {form_name(lib, 'step', torques)}. A carry belongs to its state: where another state is"
            " set, set the carry to zero.",
        ),
        public=True,
    )
