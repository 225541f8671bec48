"""Functions that evaluate a flywheel programme from tables, and its clock: what `core/emit/programme.py` prints.

Place. x = phase * parts is exact, `parts` being a power of two. A large constant leaves x to nearest in the last bits
of the sum, so that the index comes from bits and is masked: it stays inside the table whatever the phase is.

Nodes. Between two nodes a quintic polynomial has the angle, rate and second derivative of both (h the step, u in
[0, 1]): phi = p0 + v0 u + a0/2 u^2 + c3 u^3 + c4 u^4 + c5 u^5, v = h phi_dot, a = h^2 phi_ddot, with d = p1 - p0 - v0 -
a0/2, e = v1 - v0 - a0, g = a1 - a0: c3 = 10 d - 4 e + g/2, c4 = -15 d + 7 e - g, c5 = 6 d - 3 e + g/2. Speed and
acceleration are its derivatives: the three belong together. A torque is the polynomial through the six nodes about the
place.

Clock. The phase is counted in control ticks as an integer that wraps: it does not drift over long runs. `ticks` ticks
are `periods` periods, two whole numbers. The phase is a word, 2^width to a period; a tick adds floor(2^width periods /
ticks) to it, and what division leaves over is carried from tick to tick in `rest`, in parts of 1/ticks. So the phase
after n ticks is n periods / ticks rounded down to 2^-width, modulo 1, for every n.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import prod
from typing import Any

from mahovik.core import routines
from mahovik.core.lower.layout import Layout
from mahovik.core.lower.library import Library
from mahovik.core.program.expression import Status
from mahovik.core.program.function import Function, Program
from mahovik.core.program.kernel import (
    BAD_ARGUMENT,
    NOT_FINITE,
    OK,
    RANGE,
    Reals,
    Result,
    argument,
    bits_of,
    changed,
    inline,
    int_of,
    reals,
    result,
    word,
    words,
)
from mahovik.core.program.types import Field, Kind, NamedCount, Struct
from mahovik.core.program.validate import validate
from mahovik.core.routines.real_constants import PI, nearest, polynomial, rounder

SECTORS = 64
"""Parts of a period in which a Fourier table removes the whole turns of a winding."""

POINTS = 6
"""Nodes that a torque is interpolated from."""

MOST = 2**31 - 1
"""The largest int: where the count of laps stops."""

RESERVED = frozenset(
    (
        *("PROGRAMME_H", "PROGRAMME_TEST_MAIN"),
        *(
            f"PROGRAMME_{part}{name}"
            for part in ("", "RUNUP_", "RUNDOWN_")
            for name in ("NODES", "HARMONICS", "PERIOD", "DURATION")
        ),
    )
)
"""Names of a programme's header and source, that no flywheel may have."""

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

_WORDS = {
    "": "What the flywheels are to do at a phase of the programme.",
    "runup": "What the flywheels are to do at a phase of the run-up, which ends on phase 0 of the programme.",
    "rundown": "What the flywheels are to do at a phase of the run-down, which begins on phase 0 of the programme.",
}


@dataclass(frozen=True)
class Form:
    """What decides the text of the C of one table, beside the stand.

    `part` is "" for the programme itself, else "runup" or "rundown". `kind`: "quintic" or "fourier". `rows`: intervals
    of a quintic table, a power of two, at least 8; harmonics of a Fourier table. `cyclic`: the last interval ends on
    the first node, and flywheels have windings. `torque`: drive torques are in the table. `count`: flywheels.
    """

    part: str
    kind: str
    rows: int
    cyclic: bool
    torque: bool
    count: NamedCount

    @property
    def quintic(self) -> bool:
        """Has the table nodes?"""
        return self.kind == "quintic"

    @property
    def prefix(self) -> str:
        """Prefix of the names of this table."""
        return f"programme_{self.part}_" if self.part else "programme_"

    @cached_property
    def size(self) -> NamedCount:
        """Intervals, or harmonics."""
        name, words = ("NODES", "intervals") if self.quintic else ("HARMONICS", "harmonics")
        return NamedCount(f"{self.prefix.upper()}{name}", self.rows, f"{words} of the table")

    @cached_property
    def row(self) -> Struct:
        """One node, or one harmonic."""
        if self.quintic:
            name, purpose = "node", "A node of the table: each number a flywheel."
            angle = "angle, less winding and mean" if self.cyclic else "within half a turn"
            members = [("phi", "rad", angle), ("phi_dot", "rad/s", "its rate")]
            members += [("phi_ddot", "rad/s2", "its second derivative"), ("tau", "N m", "drive torque")]
        else:
            name, purpose = "harmonic", "A harmonic of the table: each number a flywheel."
            members = [("cos", "rad", "of the angle"), ("sin", "rad", "of the angle")]
            members += [("tau_cos", "N m", "of the drive torque"), ("tau_sin", "N m", "of the drive torque")]
        return Struct(f"{self.prefix}{name}", purpose, self._fields(members))

    @cached_property
    def table(self) -> Struct:
        """The whole table. Fields that it does not use are omitted."""
        if self.quintic:
            fields = [Field("step", Kind.REAL, (), "s", "time between nodes")]
            fields.append(Field("rate", Kind.REAL, (), "1/s", "1 / step"))
        else:
            fields = [Field("omega", Kind.REAL, (), "rad/s", "2 pi / period")]
        if self.cyclic:
            speed, mean = "mean speed: 2 pi winding / period", "mean angle, less the winding"
            fields.append(Field("winding", Kind.INT, (self.count,), "", "turns per period"))
            fields += self._fields([("speed", "rad/s", speed), ("mean", "rad", mean)])
        if self.quintic:
            fields.append(Field("node", self.row, (self.size if self.cyclic else self.rows + 1,)))
        else:
            fields += self._fields([("tau_mean", "N m", "mean drive torque")])
            fields.append(Field("harmonic", self.row, (self.size,)))
        return Struct(f"{self.prefix}table", "Angles of the flywheels in time.", tuple(fields))

    def _fields(self, members: Sequence[tuple[str, str, str]]) -> tuple[Field, ...]:
        """Members with a number a flywheel; of torques, where they are in the table."""
        taken = [row for row in members if self.torque or not row[0].startswith("tau")]
        return tuple(Field(name, Kind.REAL, (self.count,), unit, comment) for name, unit, comment in taken)


@dataclass(frozen=True)
class Course:
    """A table's functions: `inner` takes the table, `outer` is what the header has, with the table left out."""

    form: Form
    inner: Function
    outer: Function


@dataclass(frozen=True)
class ProgrammeProgram:
    """The program, and of each table its functions; the programme itself comes first."""

    program: Program
    courses: tuple[Course, ...]

    @property
    def public(self) -> tuple[Function, ...]:
        """The functions of the header, in its order."""
        return (*(c.outer for c in self.courses), *(f for f in self.program.functions if f.public))


def lower_programme(layout: Layout, forms: Sequence[Form]) -> ProgrammeProgram:
    """Functions for tables of these forms. Their text depends on the forms and the stand's structure alone."""
    lib = Library(layout)
    precision = layout.precision
    if not all(form.quintic for form in forms):
        lib.add(routines.sincos(precision))
    lib.add(routines.unwind(precision))
    lib.add(routines.wrap(precision, lib["unwound"]))
    courses = tuple(course(lib, form) for form in forms)
    add_clock(lib)
    counts = (layout.count, *(form.size for form in forms))
    tables = (CLOCK, *(struct for form in forms for struct in (form.row, form.table)))
    program = Program(layout.structure.name, precision, counts, tables, lib.functions)
    validate(program)
    return ProgrammeProgram(program, courses)


# -- tables ------------------------------------------------------------------------------------------------------------


def course(lib: Library, form: Form) -> Course:
    """Adds the function of a table."""
    n = form.count
    of = "a carrier that is free on the way" if form.part else "the prescribed motion"
    time: Any = argument(f"time as a part of the {'period, in [0, 1)' if form.cyclic else 'duration, in [0, 1]'}")
    torques: Any = result(f"drive torques of {of}", n, unit="N m") if form.torque else None
    by = "a table of nodes" if form.quintic else "Fourier coefficients"

    @lib.kernel(f"{form.prefix}course", purpose=f"Angles, speeds and accelerations of all flywheels from {by}.")
    def inner(
        table: Any = argument(struct=form.table),
        phase: float = time,
        phi: Reals = result("angles, within half a turn of zero to rounding", n, unit="rad"),
        phi_dot: Reals = result("speeds", n, unit="rad/s"),
        phi_ddot: Reals = result("accelerations", n, unit="rad/s2"),
        tau: Any = torques,
    ) -> Status:
        """The three of each flywheel at a phase."""
        check_phase(lib, phase, form.cyclic)
        if form.quintic:
            between_nodes(lib, form, table, phase, phi, phi_dot, phi_ddot, tau)
        else:
            sum_of_harmonics(lib, form, table, phase, phi, phi_dot, phi_ddot, tau)
        return OK

    note = "Speeds and accelerations are derivatives of the angles, term by term."
    if form.quintic:
        note = "The three belong together: speeds and accelerations are derivatives of the angles, to rounding."
    shown = tuple(a for a in inner.arguments if a.name != "table")
    outer = replace(
        inner, name=f"{form.prefix}at", purpose=_WORDS[form.part], arguments=shown, notes=(note,), public=True
    )
    return Course(form, inner, outer)


@inline
def check_phase(lib: Library, phase: float, cyclic: bool) -> Any:
    """RANGE or NOT_FINITE for an invalid phase."""
    if not (phase >= 0 and (phase < 1 if cyclic else phase <= 1)):
        if phase >= -lib.largest and phase <= lib.largest:
            return RANGE
        return NOT_FINITE
    return None


@inline
def spot(lib: Library, phase: float, parts: int, cyclic: bool) -> Any:
    """Part j and place u in it, 0 to 1, of a checked phase; the end of a finite table is that of its last part."""
    # x = j + u: the large constant leaves x to nearest in the last bits of the sum.
    x = phase * parts
    shifted = x + rounder(lib.layout.precision)
    close = shifted - rounder(lib.layout.precision)
    behind = x < close if cyclic else x < close or not (phase < 1)  # the part ends there
    j = int_of((bits_of(shifted) - (word(1) if behind else word(0))) & word(parts - 1))
    u = (x - close) + 1 if behind else x - close
    return j, u


@inline
def phase_of_winding(lib: Library, winding: int, j: int, u: float, parts: int) -> Any:
    """2 pi winding * phase, less whole turns (rad): whole turns are removed as integers, exactly."""
    count = int_of(word(winding) * word(j) & word(parts - 1))  # parts of a turn, modulo a turn
    sector = count if count < parts // 2 else count - parts
    return (float(sector) + float(winding) * u) * nearest(2 * PI / Fraction(parts), lib.layout.precision)


def lagrange(n: int, w: Any) -> Any:
    """The polynomial that is 1 at node n of POINTS and 0 at the others."""
    value: Any = 1.0 / prod(n - m for m in range(POINTS) if m != n)
    for m in range(POINTS):
        if m != n:
            value = value * (w - m if m else w)
    return value


@inline
def between_nodes(
    lib: Library, form: Form, table: Any, phase: float, phi: Reals, phi_dot: Reals, phi_ddot: Reals, tau: Any
) -> None:
    """Quintic Hermite interpolation of the angles, Lagrange's of the drive torques."""
    j, u = spot(lib, phase, form.rows, form.cyclic)
    after = (j + 1) % form.rows if form.cyclic else j + 1
    first, last = table.node[j], table.node[after]
    for s in range(form.count):
        # The quintic that has angle, rate and second derivative of both nodes.
        v0 = table.step * first.phi_dot[s]
        a0 = table.step * table.step * first.phi_ddot[s]
        v1 = table.step * last.phi_dot[s]
        if form.cyclic:
            d = last.phi[s] - first.phi[s] - v0 - a0 * 0.5
        else:  # angles are without whole turns: the mean of both speeds says how many
            expected = (v0 + v1) * 0.5
            d = lib["wrapped"](last.phi[s] - first.phi[s] - expected) + (v1 - v0) * 0.5 - a0 * 0.5
        e = (v1 - v0) - a0
        g = table.step * table.step * last.phi_ddot[s] - a0
        c3 = 10 * d - 4 * e + g * 0.5
        c4 = 7 * e - 15 * d - g
        c5 = 6 * d - 3 * e + g * 0.5
        angle = (first.phi[s], v0, a0 * 0.5, c3, c4, c5)
        speed = (v0, a0, 3 * c3, 4 * c4, 5 * c5)
        if form.cyclic:
            turned = (table.winding[s], j, u, form.rows)
            phi[s] = lib["wrapped"](phase_of_winding(lib, *turned) + table.mean[s] + polynomial(angle, u))
            phi_dot[s] = table.speed[s] + polynomial(speed, u) * table.rate
        else:
            phi[s] = lib["wrapped"](polynomial(angle, u))
            phi_dot[s] = polynomial(speed, u) * table.rate
        phi_ddot[s] = polynomial((a0, 6 * c3, 12 * c4, 20 * c5), u) * (table.rate * table.rate)
    if form.torque:
        # Drive torque: the polynomial through six nodes; w is the place among them.
        weight = reals(POINTS)
        if form.cyclic:
            start = j + (form.rows - 2)
            w = u + 2
        else:
            low = 0 if j < 2 else j - 2
            start = form.rows + 1 - POINTS if low > form.rows + 1 - POINTS else low
            w = float(j - start) + u
        for n in list(range(POINTS)):
            weight[n] = lagrange(n, w)
        for s in range(form.count):
            tau[s] = 0
        for i in range(POINTS):
            row = (start + i) % form.rows if form.cyclic else start + i
            for s in range(form.count):
                tau[s] += weight[i] * table.node[row].tau[s]


@inline
def sum_of_harmonics(
    lib: Library, form: Form, table: Any, phase: float, phi: Reals, phi_dot: Reals, phi_ddot: Reals, tau: Any
) -> None:
    """Fourier sums: one sine and cosine, the others by the angle sum, harmonic by harmonic."""
    j, u = spot(lib, phase, SECTORS, True)
    # Sine and cosine of k 2 pi phase, from k = 1 on by the sum of angles.
    sine_1 = reals()
    cosine_1 = reals()
    first_turn(lib, phase, sine_1, cosine_1)
    sine: float = sine_1
    cosine: float = cosine_1
    k: float = 0
    for s in range(form.count):
        phi[s] = table.mean[s]
        phi_dot[s] = 0
        phi_ddot[s] = 0
        if form.torque:
            tau[s] = table.tau_mean[s]
    for i in range(form.size):
        row = table.harmonic[i]
        k += 1
        for s in range(form.count):
            value = row.cos[s] * cosine + row.sin[s] * sine
            slope = row.sin[s] * cosine - row.cos[s] * sine
            phi[s] += value
            phi_dot[s] += k * slope
            phi_ddot[s] = phi_ddot[s] - k * k * value
            if form.torque:
                tau[s] += row.tau_cos[s] * cosine + row.tau_sin[s] * sine
        turned_cosine = cosine * cosine_1 - sine * sine_1
        sine = sine * cosine_1 + cosine * sine_1
        cosine = turned_cosine
    for s in range(form.count):
        phi[s] = lib["wrapped"](phase_of_winding(lib, table.winding[s], j, u, SECTORS) + phi[s])
        phi_dot[s] = table.speed[s] + table.omega * phi_dot[s]
        phi_ddot[s] = table.omega * table.omega * phi_ddot[s]


@inline
def first_turn(lib: Library, phase: float, sine: Any, cosine: Any) -> None:
    """Sine and cosine of 2 pi phase, of an angle within half a turn."""
    centred = phase - 1 if phase > 0.5 else phase
    lib["sincos"](centred * nearest(2 * PI, lib.layout.precision), sine, cosine)


# -- clock -------------------------------------------------------------------------------------------------------------


@inline
def below(value: int, limit: int) -> Any:
    """0 <= value < limit"""
    return not (value < 0 or not (value < limit))


def add_clock(lib: Library) -> None:
    """Adds `programme_start`, `programme_advance`, `programme_phase`."""
    width, significand = lib.layout.precision.width, lib.layout.precision.significand
    made: Any = argument("what start made", struct=CLOCK)

    @lib.kernel(
        statuses=("OK", "BAD_ARGUMENT"),
        notes=(
            "The frequency is not rounded: after n ticks the phase is n periods / ticks, rounded down to a multiple of "
            f"2^-{width}, for every n. Of a finite table a period is the duration, and its end is where laps is 1.",
        ),
        public=True,
    )
    def programme_start(
        ticks: int = argument("control ticks that take `periods` periods; at least 2 per period"),
        periods: int = argument("1 or more"),
        clock: Any = result("at phase 0", struct=CLOCK),
    ) -> Status:
        """Clock at phase 0, in which `ticks` control ticks take `periods` periods."""
        if not (periods >= 1 and (ticks >= 2 and periods <= ticks / 2)):
            return BAD_ARGUMENT
        # Long division of 2^width periods by ticks: quotient and remainder are exact.
        count = word(ticks)
        left = words()
        quotient = words()
        left = word(periods)
        quotient = word(0)
        for i in range(width):
            left = left << 1
            quotient = quotient << 1
            if left >= count:
                left = left - count
                quotient = quotient + 1
        clock.phase = 0
        clock.increment = quotient
        clock.surplus = int_of(left)
        clock.rest = 0
        clock.ticks = ticks
        clock.laps = 0
        return OK

    @lib.kernel(statuses=("OK", "BAD_ARGUMENT"), public=True)
    def programme_advance(clock: Any = changed("what start made", struct=CLOCK)) -> Status:
        """One control tick: the clock goes on, and wraps at the end of the period."""
        if not (clock.laps >= 0 and (below(clock.rest, clock.ticks) and below(clock.surplus, clock.ticks))):
            return BAD_ARGUMENT
        left = clock.ticks - clock.rest  # parts until one more is full
        carry = not (clock.surplus < left)
        phase = clock.phase + clock.increment + (word(1) if carry else word(0))
        lapped = phase < clock.phase
        clock.laps = clock.laps + (1 if lapped and clock.laps < MOST else 0)
        clock.rest = clock.surplus - left if carry else clock.rest + clock.surplus
        clock.phase = phase
        return OK

    @lib.kernel(statuses=("OK",), public=True)
    def programme_phase(clock: Any = made, phase: Result = result("in [0, 1), rounded down")) -> Status:
        """The phase of a clock as the functions of the programme take it."""
        phase.value = float(clock.phase >> (width - significand)) * 2.0**-significand
        return OK
