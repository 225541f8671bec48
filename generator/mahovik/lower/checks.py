"""Checks of inputs: finite, and inside the ranges of stand.md. Nothing is computed from an input before it passed."""

from __future__ import annotations

from mahovik.lower.library import Library
from mahovik.lower.limits import UNIT_SQUARE_MAX, UNIT_SQUARE_MIN
from mahovik.program.build import Body
from mahovik.program.expression import Not, Status, both, real
from mahovik.program.function import Argument, Function
from mahovik.program.types import Kind


def within(lib: Library) -> Function:
    """Every element finite and of magnitude at most a limit. A NaN fails every comparison, so it cannot pass."""
    values = Argument("values", Kind.REAL, (0,))
    count = Argument("count", Kind.INT)
    limit = Argument("limit", Kind.REAL)
    largest = lib.limits["LARGEST"].expression
    body = Body()
    with body.loop("i", count.place) as i:
        value = values.place[i]
        with body.when(Not(both(value >= -limit.place, value <= limit.place))):
            with body.when(both(value >= -largest, value <= largest)):
                body.ret(Status("RANGE"))
            body.ret(Status("NOT_FINITE"))
    body.ret(Status("OK"))
    return Function(
        "within",
        "Are all values finite, and none larger in magnitude than the limit? A NaN fails every comparison.",
        (values, count, limit),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_FINITE", "RANGE"),
    )


def check_turns(lib: Library) -> Function:
    """Sines and cosines from encoders: finite, and of unit length within 1e-3."""
    sine, cosine = lib.given_turns()
    body = Body()
    lib.begin(body)
    for given in (sine, cosine):
        lib.check(body, "within", given.place, lib.layout.count, real(2))
    with body.loop("s", lib.layout.count) as s:
        norm = body.let("norm2", sine.place[s] * sine.place[s] + cosine.place[s] * cosine.place[s])
        unit = both(norm >= real(UNIT_SQUARE_MIN), norm <= real(UNIT_SQUARE_MAX))
        lib.guard(body, Not(unit), "RANGE")
    body.ret(Status("OK"))
    return Function(
        "check_turns",
        "Are sines and cosines finite, and s^2 + c^2 that of a length within 1e-3 of 1?",
        (sine, cosine),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_FINITE", "RANGE"),
    )


def check_state(lib: Library) -> Function:
    """Ranges of a whole state; the quaternion within 1e-3 of unit length."""
    x = lib.state_argument()
    state = x.place
    body = Body()
    lib.begin(body)
    limit = {name: found.expression for name, found in lib.limits.items()}
    lib.check(body, "within", state.position, 3, limit["MAX_POSITION"])
    lib.check(body, "within", state.attitude, 4, real(2))
    lib.check(body, "within", state.V, 6, limit["MAX_SPEED"])
    lib.check(body, "within", state.V, 3, limit["MAX_VELOCITY"])
    if lib.layout.flywheels:
        lib.check(body, "within", state.phi, lib.layout.count, limit["MAX_PHASE"])
        lib.check(body, "within", state.phi_dot, lib.layout.count, limit["MAX_SPEED"])
    q = state.attitude
    norm = body.let("norm2", q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    unit = both(norm >= real(UNIT_SQUARE_MIN), norm <= real(UNIT_SQUARE_MAX))
    lib.guard(body, Not(unit), "RANGE")
    body.ret(Status("OK"))
    return Function(
        "check_state",
        "Is the state finite, in its ranges, and its quaternion within 1e-3 of unit length?",
        (x,),
        body.statements,
        returns=Kind.STATUS,
        statuses=("OK", "NOT_FINITE", "RANGE"),
    )
