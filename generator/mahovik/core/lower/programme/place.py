"""Where a phase in [0, 1) lies among equal parts of the period, and the whole turns of a winding there.

x = phase * parts is exact, `parts` being a power of two. The large constant leaves x to nearest in the last bits of the
sum, so that the index comes from bits and is masked: it stays inside the table whatever the phase is.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from mahovik.core.lower.library import Library
from mahovik.core.program.build import Body
from mahovik.core.program.call import Argument
from mahovik.core.program.expression import (
    Convert,
    Expr,
    Not,
    Place,
    Status,
    and_,
    bits_of,
    integer,
    or_,
    real,
    select,
    word,
)
from mahovik.core.program.types import Kind
from mahovik.core.routines.real_constants import PI, nearest


@dataclass(frozen=True)
class Spot:
    """The part `j` (int) and the place `u` in it, 0 to 1."""

    j: Expr
    u: Expr


def phase_argument(cyclic: bool) -> Argument:
    """Time as a part of the period or the duration."""
    if cyclic:
        return Argument("phase", Kind.REAL, purpose="time as a part of the period, in [0, 1)")
    return Argument("phase", Kind.REAL, purpose="time as a part of the duration, in [0, 1]")


def check_phase(lib: Library, body: Body, phase: Place, cyclic: bool) -> None:
    """Return RANGE or NOT_FINITE for an invalid phase."""
    largest = lib.limits["LARGEST"].expression
    with body.when(Not(and_(phase >= 0, phase < 1 if cyclic else phase <= 1))):
        with body.when(and_(phase >= -largest, phase <= largest)):
            body.ret(Status("RANGE"))
        body.ret(Status("NOT_FINITE"))


def spot(lib: Library, body: Body, phase: Place, parts: int, cyclic: bool) -> Spot:
    """Part and place of a checked phase; the end of a finite table is the end of its last part."""
    magic = real(1.5 * 2.0 ** (lib.layout.precision.significand - 1))
    body.note("x = j + u: the large constant leaves x to nearest in the last bits of the sum.")
    x = body.let("x", phase * real(parts))
    shifted = body.let("shifted", x + magic)
    close = body.let("close", shifted - magic)
    before = x < close
    behind = body.let("behind", before if cyclic else or_(before, Not(phase < 1)), "the part ends there")
    number = bits_of(shifted) - select(behind, word(1), word(0))
    j = body.let("j", Convert(number & word(parts - 1), Kind.INT))
    u = body.let("u", select(behind, (x - close) + real(1), x - close))
    return Spot(j, u)


def phase_of_winding(lib: Library, body: Body, winding: Place, at: Spot, parts: int) -> Expr:
    """2 pi winding * phase, less whole turns (rad): whole turns are removed as integers, exactly."""
    turn = nearest(2 * PI / Fraction(parts), lib.layout.precision)
    product = Convert(winding, Kind.WORD) * Convert(at.j, Kind.WORD)
    count = body.let("count", Convert(product & word(parts - 1), Kind.INT), "parts of a turn, modulo a turn")
    half = integer(parts // 2)
    sector = body.let("sector", select(count < half, count, count - integer(parts)))
    whole = Convert(sector, Kind.REAL) + Convert(winding, Kind.REAL) * at.u
    return whole * real(turn)
