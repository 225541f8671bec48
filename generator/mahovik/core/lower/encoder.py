"""Phases and speeds of flywheels from encoder counts, without drift: the same for every stand.

A count is an integer and stays one: whole turns are removed by integer division, so that the phase after 10^9 counts is
as good as that after one.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from mahovik.contract.quantities import BOUNDS
from mahovik.core.lower.checks import check_number
from mahovik.core.program.expression import Convert, Status, integer
from mahovik.core.program.function import Function, Program
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    OK,
    RANGE,
    Result,
    argument,
    changed,
    int_of,
    kernel,
    result,
    word,
)
from mahovik.core.program.types import FLOAT, Field, Kind, NamedCount, Precision, Struct
from mahovik.core.program.validate import validate
from mahovik.core.routines.real_constants import PI, nearest

MOST = {
    "double": NamedCount("MAX_COUNTS", 2**30, "counts per turn, in magnitude"),
    "float": NamedCount("MAX_COUNTS_FLOAT", 2**23, "likewise: a float has every integer up to twice as many"),
}
LONGEST = NamedCount("MAX_PERIOD", int(BOUNDS["MAX_STEP"].at("double")), "s; time between two readings")
FASTEST = NamedCount("MAX_SPEED", int(BOUNDS["MAX_SPEED"].at("double")), "rad/s")
COUNTS = (*MOST.values(), LONGEST, FASTEST)
"""Integers, which C converts to either element type."""

ENCODER = Struct(
    "encoder",
    "An encoder whose counter wraps. Updated by mahovik_accumulate.",
    (
        Field("counter", Kind.INT, (), "", "last reading; start with the first"),
        Field("place", Kind.INT, (), "", "counts within the turn, 0 to |per_turn| - 1; start with those of the first"),
        Field("moved", Kind.INT, (), "", "counts between the last two readings"),
    ),
)


def lower_encoder(precision: Precision) -> Program:
    """Functions in a precision; those of float end in `_float`. `accumulate` is with these: words of 32 bits do."""
    integers = (accumulate,) if precision is FLOAT else ()
    functions = (remainder_of, *integers, *of_counts(precision))
    program = Program("mahovik", precision, (), (ENCODER,), functions)
    validate(program)
    return program


def quotient(count: int, turn: int) -> Any:
    """count / turn, towards zero, as C divides ints."""
    return count / turn


@kernel()
def remainder_of(count: int = argument(), turn: int = argument()) -> int:
    """Counts less whole turns, of the sign of the count: `/` of ints is towards zero."""
    return count - quotient(count, turn) * turn


@kernel(
    statuses=("OK", "BAD_ARGUMENT"),
    notes=("Call it before the counter has moved by half its range (by half a turn if bits is 0).",),
    public=True,
)
def accumulate(
    encoder: Any = changed("as it was after the last reading", struct=ENCODER),
    counter: int = argument("as read; a 32-bit counter as a signed number"),
    bits: int = argument("width of the counter, 2 to 32; 0: it counts 0 to |per_turn| - 1"),
    per_turn: int = argument(
        "counts per turn, at most MAHOVIK_MAX_COUNTS in magnitude; negative if phi falls as counts rise"
    ),
) -> Status:
    """Takes one reading of a counter, which may wrap: place in the turn and counts moved, both exact."""
    most = integer(MOST["double"])
    if per_turn < -most or per_turn > most or per_turn == 0:
        return BAD_ARGUMENT
    turn = -per_turn if per_turn < 0 else per_turn
    if encoder.place < 0 or encoder.place >= turn:
        return BAD_ARGUMENT
    moved: int = 0
    if bits == 0:
        half = turn / 2
        if counter < 0 or counter >= turn or encoder.counter < 0 or encoder.counter >= turn:
            return BAD_ARGUMENT
        moved = counter - encoder.counter  # in the shorter direction
        moved = moved - turn if moved > half else moved + turn if moved < -half else moved
    else:
        if bits < 2 or bits > 32:
            return BAD_ARGUMENT
        mask = word(0xFFFFFFFF) >> word(32 - bits)
        up = (word(counter) - word(encoder.counter)) & mask  # counts forwards
        down = mask - up  # counts backwards, less one
        moved = -1 - int_of(down) if up > down else int_of(up)
    place = encoder.place + remainder_of(moved, turn)
    encoder.place = place + turn if place < 0 else place if place < turn else place - turn
    encoder.counter = counter
    encoder.moved = moved
    return OK


def of_counts(precision: Precision) -> tuple[Function, ...]:
    """Phase and speed of counts."""
    end = "_float" if precision is FLOAT else ""
    most, whole = integer(MOST[precision.name]), nearest(2 * PI, precision)
    reals = SimpleNamespace(largest=float(precision.largest))  # without its name: the file is of both element types
    statuses = ("OK", "NOT_FINITE", "RANGE", "BAD_ARGUMENT")
    turning: Any = argument(f"as above; at most MAHOVIK_{MOST[precision.name].name}")

    @kernel(f"phase_of_counts{end}", statuses=statuses, public=True)
    def phase_of_counts(
        count: int = argument("any count; or `place` of the encoder"),
        per_turn: int = turning,
        zero: float = argument("count at phi = 0, at most one turn in magnitude, else RANGE"),
        phi: Result = result("in [-pi, pi] (pi rounded to the nearest real)", unit="rad"),
    ) -> Status:
        """Phase of a count, to 2 units in the last place at any count and whole zero."""
        if per_turn < -most or per_turn > most or per_turn == 0:
            return BAD_ARGUMENT
        turn = -per_turn if per_turn < 0 else per_turn
        size = float(turn)
        half = size * 0.5
        check_number(reals, zero, size)
        place: float = float(remainder_of(count, turn)) - zero  # counts from phi = 0
        for i in range(2):  # to within half a turn
            place = place - size if place > half else place + size if place < -half else place
        phi.value = place / float(per_turn) * whole
        return OK

    @kernel(f"speed_of_counts{end}", statuses=statuses, public=True)
    def speed_of_counts(
        moved: int = argument("counts during dt: `moved` of the encoder"),
        per_turn: int = turning,
        dt: float = argument("above 0, at most MAHOVIK_MAX_PERIOD", unit="s"),
        phi_dot: Result = result("RANGE where it is beyond MAHOVIK_MAX_SPEED", unit="rad/s"),
    ) -> Status:
        """Mean speed over a time. One count is 2 pi/(per_turn dt)."""
        if per_turn < -most or per_turn > most or per_turn == 0:
            return BAD_ARGUMENT
        check_number(reals, dt, Convert(integer(LONGEST), Kind.REAL))
        if not (dt > 0):
            return BAD_ARGUMENT
        speed = float(moved) / float(per_turn) * whole / dt
        fastest = Convert(integer(FASTEST), Kind.REAL)
        if not (speed >= -fastest and speed <= fastest):
            return RANGE
        phi_dot.value = speed
        return OK

    return phase_of_counts, speed_of_counts
