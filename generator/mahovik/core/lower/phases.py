"""Phases for firmware: an angle brought within half a turn, and phases and speeds of encoder counts without drift.

A count is an integer and stays one: whole turns are removed by integer division, so that the phase after 10^9 counts is
as good as that after one. Every int operation here stays within 32 bits for any input.
"""

from __future__ import annotations

from mahovik.core import routines
from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Convert,
    Expr,
    Not,
    Place,
    and_,
    equal,
    integer,
    or_,
    real,
    select,
    word,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Kind
from mahovik.core.routines.real_constants import PI, nearest

MAX_COUNTS = {"double": 1 << 30, "float": 1 << 23}
"""Counts per turn: twice as many fit an int, and a float has every integer up to 2^24."""

MAX_BITS = 32
"""Widest counter: an int."""


def wrap(lib: Library) -> Function:
    """`wrap`: the angle wrapped to [-pi, pi], with a status."""
    precision = lib.layout.precision
    phi = Argument("phi", Kind.REAL, unit="rad", purpose="any angle within MAX_PHASE")
    out = Argument("wrapped", Kind.REAL, (), "out", "rad", "the same angle in [-pi, pi]")
    pi = real(nearest(PI, precision))
    body = Body()
    lib.check_number(body, phi.place, lib.limits["MAX_PHASE"].expression)
    k = body.local("k", comment="nearest number of turns; may be off by one next to an odd multiple of pi")
    angle = body.local("angle")
    body.set(k, routines.turns_of_angle(precision, phi.place))
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


def phase_of_counts(lib: Library) -> Function:
    """`phase_of_counts`: the phase of a count, to two units in the last place at any count."""
    precision = lib.layout.precision
    count = Argument("count", Kind.INT, purpose="any count of the encoder; or `place` of accumulate")
    per_turn = _per_turn(lib)
    zero = Argument("zero", Kind.REAL, purpose="count at phi = 0, at most one turn in magnitude")
    phi = Argument("phi", Kind.REAL, (), "out", "rad", "phase, in [-pi, pi] (pi rounded to the nearest real)")
    body = Body()
    turn = _size_of_turn(lib, body, per_turn.place)
    size = body.let("size", Convert(turn, Kind.REAL))
    lib.check_number(body, zero.place, size)
    rest = body.let("rest", _remainder(count.place, turn), "whole turns removed")
    place = body.local("place", comment="counts from phi = 0; then reduced to within half a turn")
    body.set(place, Convert(rest, Kind.REAL) - zero.place)
    half = body.let("half", size * real(0.5))
    with body.loop("i", 2):
        body.set(place, select(place > half, place - size, select(place < -half, place + size, place)))
    body.set(phi.place, place / Convert(per_turn.place, Kind.REAL) * real(nearest(2 * PI, precision)))
    return body.checked_function(
        "phase_of_counts",
        "Phase for a count of an encoder.",
        (count, per_turn, zero, phi),
        statuses=("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"),
        notes=(
            "Error at most 2 units in the last place for a whole `zero` and every count: the phase does not drift.",
            "Also returns RANGE if |zero| is more than one turn.",
        ),
        public=True,
    )


def speed_of_counts(lib: Library) -> Function:
    """`speed_of_counts`: mean speed over a time."""
    precision = lib.layout.precision
    moved = Argument("moved", Kind.INT, purpose="counts during dt: `moved` of accumulate")
    per_turn = _per_turn(lib)
    dt = Argument("dt", Kind.REAL, unit="s", purpose="greater than 0")
    phi_dot = Argument("phi_dot", Kind.REAL, (), "out", "rad/s", "mean speed during dt")
    body = Body()
    _size_of_turn(lib, body, per_turn.place, used=False)
    lib.check_number(body, dt.place, lib.limits["MAX_STEP"].expression)
    lib.guard(body, Not(dt.place > 0), "BAD_ARGUMENT")
    turns = body.let("turns", Convert(moved.place, Kind.REAL) / Convert(per_turn.place, Kind.REAL))
    speed = body.let("speed", turns * real(nearest(2 * PI, precision)) / dt.place)
    limit = lib.limits["MAX_SPEED"].expression
    lib.guard(body, Not(and_(speed >= -limit, speed <= limit)), "RANGE")
    body.set(phi_dot.place, speed)
    return body.checked_function(
        "speed_of_counts",
        "Mean speed of a flywheel from the counts of one interval.",
        (moved, per_turn, dt, phi_dot),
        statuses=("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT"),
        notes=("Also returns RANGE if the speed is beyond MAX_SPEED. Resolution: one count is 2 pi/(per_turn dt).",),
        public=True,
    )


def accumulate(lib: Library) -> Function:
    """`accumulate`: one reading of a counter that wraps."""
    layout = lib.layout
    encoder = Argument(
        "encoder",
        layout.encoder,
        (),
        "inout",
        purpose="start with counter = first reading, place = its counts within the turn",
    )
    counter = Argument("counter", Kind.INT, purpose="counter as read; a 32-bit counter as a signed number")
    bits = Argument("bits", Kind.INT, purpose="width of the counter, 2 to 32; 0: it counts 0 to per_turn - 1")
    per_turn = _per_turn(lib)
    e = encoder.place
    body = Body()
    turn = _size_of_turn(lib, body, per_turn.place)
    lib.guard(body, Not(and_(e.place >= 0, e.place < turn)), "BAD_ARGUMENT")
    moved = body.local("moved", (), Kind.INT, "counts since the last reading, in the shorter direction")
    with body.when(equal(bits.place, integer(0))):
        inside = [and_(c >= 0, c < turn) for c in (counter.place, e.counter)]
        lib.guard(body, Not(and_(*inside)), "BAD_ARGUMENT")
        body.set(moved, counter.place - e.counter)
        half = body.let("half", turn / integer(2))
        body.set(moved, select(moved > half, moved - turn, select(moved < -half, moved + turn, moved)))
    with body.otherwise():
        lib.guard(body, Not(and_(bits.place >= 2, bits.place <= MAX_BITS)), "BAD_ARGUMENT")
        mask = body.let("mask", word((1 << MAX_BITS) - 1) >> Convert(integer(MAX_BITS) - bits.place, Kind.WORD))
        now, before = (Convert(c, Kind.WORD) for c in (counter.place, e.counter))
        up = body.let("up", (now - before) & mask, "counts forwards")
        down = body.let("down", mask - up, "counts backwards, less one")
        body.set(moved, select(up > down, integer(-1) - Convert(down, Kind.INT), Convert(up, Kind.INT)))
    place = body.local("place", (), Kind.INT)
    body.set(place, e.place + _remainder(moved, turn))
    body.set(e.place, select(place < 0, place + turn, select(place < turn, place, place - turn)))
    body.set(e.counter, counter.place)
    body.set(e.moved, moved)
    return body.checked_function(
        "accumulate",
        "Takes one reading of an encoder's counter, which may wrap: place in the turn and counts moved, both exact.",
        (encoder, counter, bits, per_turn),
        statuses=("OK", "BAD_ARGUMENT"),
        notes=(
            "Call it before the counter has moved by half its range (by half a turn if bits is 0).",
            "phase_of_counts makes a phase of `place`, speed_of_counts a speed of `moved`; the phase does not drift.",
        ),
        public=True,
    )


def _per_turn(lib: Library) -> Argument:
    most = MAX_COUNTS[lib.layout.precision.name]
    return Argument(
        "per_turn",
        Kind.INT,
        purpose=f"counts per turn, at most {most} in magnitude; negative if phi falls as counts rise",
    )


def _size_of_turn(lib: Library, body: Body, per_turn: Place, used: bool = True) -> Expr:
    """|per_turn|; BAD_ARGUMENT where it is 0 or too large."""
    most = MAX_COUNTS[lib.layout.precision.name]
    lib.guard(body, or_(or_(per_turn < -most, per_turn > most), equal(per_turn, 0)), "BAD_ARGUMENT")
    if not used:
        return per_turn
    return body.let("turn", select(per_turn < 0, -per_turn, per_turn), "counts")


def _remainder(count: Expr, turn: Expr) -> Expr:
    """count less whole turns, of the sign of count: `/` of ints is towards zero."""
    return count - count / turn * turn
