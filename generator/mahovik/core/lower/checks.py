"""Checks of inputs: finite, and inside the ranges of limits.py. Nothing is computed from an input before it passed.

Values are looked at one by one only where a sum of their squares is not below the square of the limit. Where it is,
each value is within: rounding keeps the order of numbers, so a rounded sum of what is not negative is no smaller than
any rounded square in it, and where a rounded square is below another, so are the numbers: v^2 < limit^2. This holds in
any rounding, with and without fused multiply-add. Infinities, NaN and what overflows are below nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from mahovik.core.lower.library import Library, unit_square
from mahovik.core.lower.limits import limits
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Const,
    Expr,
    Not,
    Place,
    Status,
    and_,
    integer,
    real,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind, NamedCount, Precision, Struct


def _arguments() -> tuple[Argument, Argument, Argument]:
    values, limit = Argument("values", Kind.REAL, (0,)), Argument("limit", Kind.REAL)
    return values, Argument("count", Kind.INT), limit


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


def check_vector(lib: Library, body: Body, values: Place, limit: Expr) -> None:
    """Returns the status of the first bad one of a few values, which are looked at if their squares are not small."""
    with body.when(Not(_squares(list(values)) < limit * limit)):
        lib.check(body, "within", values, len(values), limit)


def check_turns(lib: Library) -> Function:
    """Sines and cosines from encoders: finite, and of unit length within 1e-3."""
    sine, cosine = lib.given_turns()
    body = Body()
    for given in (sine, cosine):
        lib.check(body, "within", given.place, lib.layout.count, real(2))
    with body.loop("s", lib.layout.count) as s:
        norm = body.let("norm2", sine.place[s] * sine.place[s] + cosine.place[s] * cosine.place[s])
        lib.check_unit(body, norm)
    return body.checked_function(
        "check_turns", "Are sines and cosines finite, and is s^2 + c^2 between 0.999^2 and 1.001^2?", (sine, cosine)
    )


def _squares(values: Sequence[Expr]) -> Expr:
    """The sum of the squares, from left to right."""
    total = values[0] * values[0]
    for value in values[1:]:
        total = total + value * value
    return total


def _add_square(body: Body, sums: Mapping[str, Place], name: str, value: Expr) -> None:
    """Add the square of a local: intervals prove that a square of a variable is not negative, not one of an element."""
    read = body.let(name, value)
    body.add(sums[name], read * read)


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
                    _add_square(body, sums, name, value)
        if each:
            with body.loop("s", lib.layout.count) as s:
                for name, values in each:
                    _add_square(body, sums, name, values[s])
        q = x.attitude
        fine = unit_square(body.let("norm2", _squares(list(q))))
        for name, total in sums.items():
            fine = and_(fine, total < most[name] * most[name])
        with body.when(fine):
            body.ret(Status("OK"))


def state_limits(state: Struct, precision: Precision) -> list[tuple[str, int | NamedCount, Const]]:
    """Members of a state that are checked, in this order: a member, how many of its first numbers, their limit."""
    limit = {name: found.expression for name, found in limits(precision).items()}
    size = {f.name: f.shape[0] for f in state.fields}
    found: list[tuple[str, int | NamedCount, Const]] = [
        ("position", 3, limit["MAX_POSITION"]),
        ("attitude", 4, Const(2, Kind.REAL)),
        ("V", 6, limit["MAX_SPEED"]),
        ("V", 3, limit["MAX_VELOCITY"]),
    ]
    if "phi" in size:
        found += [("phi", size["phi"], limit["MAX_PHASE"]), ("phi_dot", size["phi_dot"], limit["MAX_SPEED"])]
    return found


def _look_at_each(lib: Library, body: Body, state: Place) -> None:
    """The state number by number."""
    for name, count, limit in state_limits(lib.layout.state, lib.layout.precision):
        lib.check(body, "within", state.member(name), count, limit)
    lib.check_unit(body, body.let("norm2", _squares(list(state.attitude))))


def check_state(lib: Library) -> Function:
    """Ranges of a whole state; the quaternion within 1e-3 of unit length."""
    x = lib.state_argument()
    body = Body()
    _look_at_sums(lib, body, x.place)
    _look_at_each(lib, body, x.place)
    return body.checked_function(
        "check_state", "Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length?", (x,)
    )


def check_motion(lib: Library) -> Function:
    """A state, and what each flywheel has besides: accelerations or torques."""
    x = lib.state_argument()
    values, limit = Argument("values", Kind.REAL, (lib.layout.count,)), Argument("limit", Kind.REAL)
    body = Body()
    _look_at_sums(lib, body, x.place, ((values.place, limit.place),))
    _look_at_each(lib, body, x.place)
    lib.check(body, "within", values.place, lib.layout.count, limit.place)
    return body.checked_function(
        "check_motion",
        "The same of a state, and then: are values of the flywheels within a limit?",
        (x, values, limit),
    )
