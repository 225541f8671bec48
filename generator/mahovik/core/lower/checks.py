"""Checks of inputs: finite, and inside the ranges of limits.py. Nothing is computed from an input before it passed.

Values are looked at one by one only where a sum of their squares is not below the square of the limit. Where it is,
each value is within: rounding keeps the order of numbers, so a rounded sum of what is not negative is no smaller than
any rounded square in it, and where a rounded square is below another, so are the numbers: v^2 < limit^2. This holds in
any rounding, with and without fused multiply-add. Infinities, NaN and what overflows are below nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from mahovik.core.lower import lanes
from mahovik.core.lower.library import Library, unit_square
from mahovik.core.program.build import Body, call
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Expr,
    Not,
    Operand,
    Place,
    Status,
    and_,
    equal,
    excess_bits,
    integer,
    real,
    unequal,
    word,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind


def _arguments() -> tuple[Argument, Argument, Argument]:
    values, limit = Argument("values", Kind.REAL, (0,)), Argument("limit", Kind.REAL)
    return values, Argument("count", Kind.INT), limit


def excess(lib: Library) -> Function:
    """Top bit set where an element is above a limit in magnitude, infinite or NaN; see `excess_bits`."""
    values, count, limit = _arguments()
    body = Body()
    over = body.local("over", (), Kind.WORD)
    body.set(over, word(0))
    with body.loop("i", count.place) as i:
        body.set(over, over | excess_bits(values.place[i], limit.place, lib.layout.precision.width))
    body.ret(over)
    return body.function(
        "excess",
        "Top bit set where a value is above the limit in magnitude, infinite or NaN: limit - |value| on the bits.",
        (values, count, limit),
        returns=Kind.WORD,
    )


def within(lib: Library) -> Function:
    """Every element finite and of magnitude at most a limit. A NaN fails every comparison, so it cannot pass."""
    values, count, limit = _arguments()
    largest = lib.limits["LARGEST"].expression
    body = Body()
    with body.loop("i", count.place) as i:
        value = values.place[i]
        with body.when(Not(and_(value >= -limit.place, value <= limit.place))):
            with body.when(and_(value >= -largest, value <= largest)):
                body.ret(Status("RANGE"))
            body.ret(Status("NOT_FINITE"))
    function = body.checked_function(
        "within",
        "Are all values finite, and none larger in magnitude than the limit? A NaN fails every comparison.",
        (values, count, limit),
    )
    return replace(function, apart=True)


def check_within(lib: Library, body: Body, values: Place, count: Operand, limit: Expr) -> None:
    """Returns the status of the first bad one of `count` values.

    By blocks, where speed is worth some code, all are tried at once first.
    """
    if lib.layout.lanes == 1:
        lib.check(body, "within", values, count, limit)
        return
    if count == 6:
        lib.check(body, "check_six", values, limit)
        return
    over = call(lib["excess"], values, count, limit)
    with body.when(unequal(over >> (lib.layout.precision.width - 1), word(0)), "which one, and why"):
        lib.check(body, "within", values, count, limit)


def check_vector(lib: Library, body: Body, values: Place, limit: Expr) -> None:
    """Returns the status of the first bad one of a few values, which are looked at if their squares are not small."""
    total = values[0] * values[0]
    for value in list(values)[1:]:
        total = total + value * value
    with body.when(Not(total < limit * limit)):
        lib.check(body, "within", values, len(values), limit)


def check_six(lib: Library) -> Function:
    """Six numbers of one limit: a wrench or an acceleration, which are looked at if their squares are not small."""
    values, limit = Argument("values", Kind.REAL, (6,)), Argument("limit", Kind.REAL)
    body = Body()
    with body.shortcut(), body.when(_squares(list(values.place)) < limit.place * limit.place):
        body.ret(Status("OK"))
    lib.begin(body)
    lib.check(body, "within", values.place, 6, limit.place)
    return body.checked_function("check_six", "Are six values finite, and none larger than the limit?", (values, limit))


def check_turns(lib: Library) -> Function:
    """Sines and cosines from encoders: finite, and of unit length within 1e-3."""
    sine, cosine = lib.given_turns()
    body = Body()
    lib.begin(body)
    for given in (sine, cosine):
        lib.check(body, "within", given.place, lib.layout.count, real(2))
    with body.loop("s", lib.layout.count) as s:
        norm = body.let("norm2", sine.place[s] * sine.place[s] + cosine.place[s] * cosine.place[s])
        lib.check_unit(body, norm)
    return body.checked_function(
        "check_turns", "Are sines and cosines finite, and is s^2 + c^2 between 0.999^2 and 1.001^2?", (sine, cosine)
    )


def _squares(values: Sequence[Expr]) -> Expr:
    """The sum of the squares."""
    return _total([value * value for value in values])


def _look_at_words(lib: Library, body: Body, x: Place, more: Sequence[tuple[Place, Expr]] = ()) -> None:
    """OK by vectors: the flywheels by bits of each number; the carrier, too small for vectors, by sums of squares."""
    limit = {name: found.expression for name, found in lib.limits.items()}
    width = lib.layout.precision.width
    with body.shortcut():
        over = body.local("over", (), Kind.WORD, "top bit set: a value of a flywheel is too large, or no number")
        body.set(over, word(0))
        with body.loop("s", lib.layout.count) as s:
            for values, most in ((x.phi, limit["MAX_PHASE"]), (x.phi_dot, limit["MAX_SPEED"]), *more):
                body.set(over, over | excess_bits(values[s], most, width))
        V = list(x.V)
        fine = and_(unit_square(body.let("norm2", _squares(list(x.attitude)))), equal(over >> (width - 1), word(0)))
        squares = (("position2", list(x.position), "MAX_POSITION"), ("velocity2", V[:3], "MAX_VELOCITY"))
        for name, few, bound in (*squares, ("omega2", V[3:], "MAX_SPEED")):
            fine = and_(fine, body.let(name, _squares(few)) < limit[bound] * limit[bound])
        with body.when(fine):
            body.ret(Status("OK"))


def _look_at_sums(lib: Library, body: Body, x: Place, more: Sequence[tuple[Place, Expr]] = ()) -> None:
    """OK where squares are small and the quaternion is of unit length; `more`: values of the flywheels with a limit."""
    limit = {name: found.expression for name, found in lib.limits.items()}
    with body.shortcut():
        sums = {name: body.local(f"{name}2") for name in ("position", "velocity", "speed")}
        most: dict[str, Expr] = {
            "position": limit["MAX_POSITION"],
            "velocity": limit["MAX_VELOCITY"],
            "speed": limit["MAX_SPEED"],
        }
        each: list[tuple[str, Place]] = []
        if lib.layout.flywheels:
            for name, values, bound in [("phase", x.phi, limit["MAX_PHASE"]), *(("given", *one) for one in more)]:
                sums[name], most[name] = body.local(f"{name}2"), bound
                each.append((name, values))
            each.append(("speed", x.phi_dot))
        carrier = {"position": list(x.position), "velocity": list(x.V)[:3], "speed": list(x.V)[3:]}
        for name, total in sums.items():  # beside few freedoms a loop of three turns counts
            body.set(total, _squares(carrier[name]) if lib.layout.held and name in carrier else real(0))
        if not lib.layout.held:
            with body.loop("i", 3) as i:
                for name, value in (("position", x.position[i]), ("velocity", x.V[i]), ("speed", x.V[i + integer(3)])):
                    body.add(sums[name], value * value)
        if each:
            with body.loop("s", lib.layout.count) as s:
                for name, values in each:
                    body.add(sums[name], values[s] * values[s])
        q = x.attitude
        fine = unit_square(body.let("norm2", _squares(list(q))))
        for name, total in sums.items():
            fine = and_(fine, total < most[name] * most[name])
        with body.when(fine):
            body.ret(Status("OK"))


def _look_at_all(lib: Library, body: Body, x: Place, more: Sequence[tuple[Place, Expr]] = ()) -> None:
    """OK where a look at all numbers at once says so: by sums, or by words where vectors are about."""
    look = _look_at_sums if lib.layout.lanes == 1 else _look_at_words
    look(lib, body, x, more)


def all_small(
    lib: Library, body: Body, x: Place, each: Sequence[tuple[Place, Expr]], six: Sequence[tuple[Place, Expr]]
) -> Expr:
    """Whether one sum shows that a state and more are within their limits, and the quaternion is of unit length.

    Each square is divided by that of its limit: where the sum of all shares is below 1, no value is beyond its limit;
    0.99 leaves room for the rounding of the weights. The few sums go side by side, as each waits for its numbers.
    `each`: values of the flywheels; `six`: others, six or more. Both with their limits.
    """
    layout, width = lib.layout, lib.layout.lanes
    limit: dict[str, Expr] = {name: found.expression for name, found in lib.limits.items()}
    whole, more = divmod(int(layout.count), width)
    wheels = [(x.phi, limit["MAX_PHASE"]), (x.phi_dot, limit["MAX_SPEED"]), *each]
    share = body.local("share", (layout.lane_count,), comment="sums of squares, each over that of its limit, by lanes")

    def add(start: Expr, count: Operand) -> None:
        with body.loop("k", count) as k:
            body.add(share[k], _total([_share(values[start + k], most) for values, most in wheels]))

    with body.loop("k", layout.lane_count) as k:
        body.set(share[k], _total([_share(values[k], most) for values, most in six]))
    if whole:
        with body.loop("b", whole if more else layout.blocks) as b:
            add(b * integer(width), layout.lane_count)
    if more:
        add(integer(whole * width), more)
    V = list(x.V)
    rest = [(V[:3], limit["MAX_VELOCITY"]), (V[3:], limit["MAX_SPEED"])]
    rest = [(list(x.position), limit["MAX_POSITION"]), *rest, *((list(values)[width:], most) for values, most in six)]
    norm = body.let("norm2", _squares(list(x.attitude)))
    shares = [*(_squares(few) * _weight(most) for few, most in rest), lanes.tree(list(share))]
    return and_(unit_square(norm), body.let("shares", _total(shares)) < real(0.99))


def _weight(limit: Expr) -> Expr:
    """1 / limit^2."""
    return real(1) / (limit * limit)


def _share(value: Expr, limit: Expr) -> Expr:
    """(value / limit)^2."""
    return value * value * _weight(limit)


def _total(parts: Sequence[Expr]) -> Expr:
    """The sum, from left to right."""
    total = parts[0]
    for part in parts[1:]:
        total = total + part
    return total


def _look_at_each(lib: Library, body: Body, state: Place) -> None:
    """The state number by number."""
    limit = {name: found.expression for name, found in lib.limits.items()}
    parts: list[tuple[Place, Operand, Expr]] = [
        (state.position, 3, limit["MAX_POSITION"]),
        (state.attitude, 4, real(2)),
        (state.V, 6, limit["MAX_SPEED"]),
        (state.V, 3, limit["MAX_VELOCITY"]),
    ]
    if lib.layout.flywheels:
        parts.append((state.phi, lib.layout.count, limit["MAX_PHASE"]))
        parts.append((state.phi_dot, lib.layout.count, limit["MAX_SPEED"]))
    for part in parts:
        lib.check(body, "within", *part)
    lib.check_unit(body, body.let("norm2", _squares(list(state.attitude))))


def check_state(lib: Library) -> Function:
    """Ranges of a whole state; the quaternion within 1e-3 of unit length."""
    x = lib.state_argument()
    body = Body()
    _look_at_all(lib, body, x.place)
    lib.begin(body)
    _look_at_each(lib, body, x.place)
    return body.checked_function(
        "check_state", "Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length?", (x,)
    )


def check_motion(lib: Library) -> Function:
    """A state, and what each flywheel has besides: accelerations or torques."""
    x = lib.state_argument()
    values, limit = Argument("values", Kind.REAL, (lib.layout.count,)), Argument("limit", Kind.REAL)
    body = Body()
    _look_at_all(lib, body, x.place, ((values.place, limit.place),))
    lib.begin(body)
    _look_at_each(lib, body, x.place)
    lib.check(body, "within", values.place, lib.layout.count, limit.place)
    return body.checked_function(
        "check_motion",
        "The same of a state, and then: are values of the flywheels within a limit?",
        (x, values, limit),
    )
