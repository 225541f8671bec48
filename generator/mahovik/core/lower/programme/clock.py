"""The phase of a programme, counted in control ticks as an integer that wraps: it does not drift over long runs.

`ticks` ticks are `periods` periods, two whole numbers. The phase is a word, 2^width to a period; a tick adds
floor(2^width periods / ticks) to it, and what division leaves over is carried from tick to tick in `rest`, in parts of
1/ticks. So the phase after n ticks is n periods / ticks rounded down to 2^-width, modulo 1, for every n.
"""

from __future__ import annotations

from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Convert,
    Expr,
    Not,
    Place,
    and_,
    integer,
    or_,
    real,
    select,
    word,
)
from mahovik.core.program.function import Function
from mahovik.core.program.types import Field, Kind, Struct

MOST = 2**31 - 1
"""The largest int: where the count of laps stops."""

CLOCK = Struct(
    "programme_clock",
    "Where the programme is: an accumulator of phase.",
    (
        Field("phase", Kind.WORD, (), "", "in parts of a period: all words are one period"),
        Field("increment", Kind.WORD, (), "", "of the phase, a tick"),
        Field("surplus", Kind.INT, (), "", "what the increment leaves over, in parts of 1 / ticks"),
        Field("rest", Kind.INT, (), "", "what is left over so far"),
        Field("ticks", Kind.INT, (), "", "as given to start"),
        Field("laps", Kind.INT, (), "", "whole periods since the start; stops at the largest int"),
    ),
)


def start(lib: Library) -> Function:
    """`programme_start(ticks, periods, clock)`."""
    ticks = Argument("ticks", Kind.INT, purpose="control ticks that take `periods` periods; at least 2 per period")
    periods = Argument("periods", Kind.INT, purpose="1 or more")
    clock = Argument("clock", CLOCK, (), "out", "", "at phase 0")
    body = Body()
    good = and_(periods.place >= 1, and_(ticks.place >= 2, periods.place <= ticks.place / integer(2)))
    lib.guard(body, Not(good), "BAD_ARGUMENT")
    body.note("Long division of 2^width periods by ticks: quotient and remainder are exact.")
    count = body.let("count", Convert(ticks.place, Kind.WORD))
    left, quotient = body.local("left", (), Kind.WORD), body.local("quotient", (), Kind.WORD)
    body.set(left, Convert(periods.place, Kind.WORD))
    body.set(quotient, word(0))
    with body.loop("i", lib.layout.precision.width):
        body.set(left, left << word(1))
        body.set(quotient, quotient << word(1))
        with body.when(left >= count):
            body.set(left, left - count)
            body.set(quotient, quotient + word(1))
    c = clock.place
    body.set(c.phase, word(0))
    body.set(c.increment, quotient)
    body.set(c.surplus, Convert(left, Kind.INT))
    body.set(c.rest, integer(0))
    body.set(c.ticks, ticks.place)
    body.set(c.laps, integer(0))
    return body.checked_function(
        "programme_start",
        "Clock at phase 0, in which `ticks` control ticks take `periods` periods.",
        (ticks, periods, clock),
        statuses=("OK", "BAD_ARGUMENT"),
        notes=(
            "The frequency is not rounded: after n ticks the phase is n periods / ticks, rounded down to a multiple of "
            f"2^-{lib.layout.precision.width}, for every n. Of a finite table a period is the duration, and its end is "
            "where laps is 1.",
        ),
        public=True,
    )


def advance(lib: Library) -> Function:
    """`programme_advance(clock)`: one control tick."""
    clock = Argument("clock", CLOCK, (), "inout", "", "what start made")
    c = clock.place
    body = Body()
    inside = and_(_below(c.rest, c.ticks), _below(c.surplus, c.ticks))
    lib.guard(body, Not(and_(c.laps >= 0, inside)), "BAD_ARGUMENT")
    left = body.let("left", c.ticks - c.rest, "parts until one more is full")
    carry = body.let("carry", Not(c.surplus < left))
    phase = body.let("phase", c.phase + c.increment + select(carry, word(1), word(0)))
    lapped = body.let("lapped", phase < c.phase)
    body.set(c.laps, c.laps + select(and_(lapped, c.laps < MOST), integer(1), integer(0)))
    body.set(c.rest, select(carry, c.surplus - left, c.rest + c.surplus))
    body.set(c.phase, phase)
    return body.checked_function(
        "programme_advance",
        "One control tick: the clock goes on, and wraps at the end of the period.",
        (clock,),
        statuses=("OK", "BAD_ARGUMENT"),
        public=True,
    )


def phase(lib: Library) -> Function:
    """`programme_phase(clock, phase)`: the phase as a real."""
    precision = lib.layout.precision
    clock = Argument("clock", CLOCK, purpose="what start made")
    out = Argument("phase", Kind.REAL, (), "out", "", "in [0, 1), rounded down")
    body = Body()
    digits = clock.place.phase >> word(precision.width - precision.significand)
    body.set(out.place, Convert(digits, Kind.REAL) * real(2.0**-precision.significand))
    return body.checked_function(
        "programme_phase",
        "The phase of a clock as the functions of the programme take it.",
        (clock, out),
        statuses=("OK",),
        public=True,
    )


def _below(value: Place, limit: Place) -> Expr:
    """0 <= value < limit"""
    return Not(or_(value < 0, Not(value < limit)))
