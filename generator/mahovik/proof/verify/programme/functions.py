"""Functions of a programme's C: tables against the programme's file and (12), the clock against exact fractions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from mahovik.contract.limits import LIMITS, Limits
from mahovik.core.motion.functions import Angles
from mahovik.errors import StateError
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Rows
from mahovik.proof.verify.programme.compiled import Part, judge_refusals, spread_phases
from mahovik.proof.verify.programme.mechanics import largest

if TYPE_CHECKING:
    from mahovik.proof.verify.programme.verification import ProgrammeCase

PHASES = 400
"""Phases at which a table is compared."""

TORQUE = 10.0
"""Factor on the limit of the file for drive torques: their parts are larger than their sum."""

TABLES = ("at", "runup_at", "rundown_at")
"""Functions that give angles of the flywheels by the time."""

CLOCK = {"phase": 0, "increment": 0, "surplus": 0, "rest": 0, "ticks": 2, "laps": 0}
CLOCK_FUNCTIONS: dict[str, dict[str, Any]] = {
    "start": {"ticks": 400, "periods": 1, "clock": {}},
    "advance": {"clock": CLOCK},
    "phase": {"clock": CLOCK, "phase": np.full(1, np.nan)},
}
"""Good arguments of the functions of the clock."""

CLOCKS = ((400, 1), (7, 3), (1000, 7), (4001, 2000))
"""Ticks and periods that they take, of the clocks that are tried over two rounds each; one period if it is finite."""


@dataclass(frozen=True, eq=False)
class CompiledProgramme:
    """A programme and its C: where the judges of its functions start."""

    case: ProgrammeCase
    made: Part
    states: int = PHASES

    @property
    def limits(self) -> Limits:
        """Accepted differences of the element type of the C."""
        return LIMITS[self.made.real]

    @property
    def tables(self) -> dict[str, tuple[Callable[[Array], Angles], float]]:
        """phi, phi', phi'' by time, and the duration (s), by the function that gives them."""
        programme = self.case.programme
        ways = {"runup_at": programme.runup, "rundown_at": programme.rundown}
        result = {function: (table.at, table.duration) for function, table in ways.items() if table is not None}
        return {"at": (programme.at, programme.span), **result}

    @property
    def public(self) -> list[str]:
        """Functions that the C must have, and those that it has."""
        return self.made.functions((*self.tables, *CLOCK_FUNCTIONS))

    def inputs(self, function: str, phase: float = 0.25) -> dict[str, Any]:
        """Arguments of the function of a table; of four outputs the last are drive torques."""
        if function not in self.tables or not self.made.library.has(function):
            raise StateError(f"{function} is in one of programme and C alone: export it again")
        count = len(self.made.library.ffi.typeof(self.made.library.function(function)).args) - 1
        none = np.full(len(self.case.stand.flywheels), np.nan)
        return {"phase": phase} | dict.fromkeys(("phi", "phi_dot", "phi_ddot", "tau")[:count], none)


def judge_table(compiled: CompiledProgramme, rows: Rows) -> None:
    """Angles and speeds of a table against the programme's file; of the programme the residual and drive torques."""
    case, made, function = compiled.case, compiled.made, rows.function
    judge_refusals(made, rows, compiled.inputs(function))
    at, span = compiled.tables[function]
    phases = made.round(spread_phases(PHASES))
    t, exact = phases * span, at(phases * span)
    answers = [made.call(function, compiled.inputs(function, phase)) for phase in phases]
    if (status := min(status for status, _ in answers)) < 0:
        rows.add(Check.of(function, np.inf, made.limit, f"the C answers with status {status}"))
        return
    columns = {name: np.array([answer[name] for _, answer in answers]) for name in answers[0][1]}
    angles = Angles(columns["phi"], columns["phi_dot"], columns["phi_ddot"])
    turned, speed = angles.phi - exact.phi, largest(exact.phi_dot) or 1.0
    turned -= 2 * np.pi * np.round(turned / (2 * np.pi))
    value = max(largest(turned), largest(angles.phi_dot - exact.phi_dot) / speed)
    words = f"angles, rad, and speeds, share of the largest, at {PHASES} times, against the programme's file"
    rows.add(Check.of(function, value, made.limit, words))
    if function == "at":
        shares = case.scale.wrench_share(case.equations(t, angles)[0])
        i = int(np.argmax(shares))
        words = f"of (12) with the C's angles, at {PHASES} times; largest at t = {t[i]:.6g} s"
        rows.add(Check.of("residual", shares[i], case.limit.residual + made.limit, words))
        if "tau" in columns:
            tau = case.equations(t)[1]
            peak = largest(tau) or 1.0
            words = f"drive torques, share of the largest, {peak:.3g} N m"
            rows.add(Check.of("torque", largest(columns["tau"] - tau) / peak, TORQUE * made.limit, words))


def judge_clock(compiled: CompiledProgramme, rows: Rows) -> None:
    """Phase and laps of clocks, which all three functions make together: with the first of them."""
    made, periodic = compiled.made, compiled.case.programme.periodic
    judge_refusals(made, rows, CLOCK_FUNCTIONS[rows.function])
    if rows.function == "start" and all(map(made.library.has, CLOCK_FUNCTIONS)):
        wrong = sum(_clock_errors(made, ticks, periods if periodic else 1) for ticks, periods in CLOCKS)
        words = "ticks whose phase or laps are not the exact fraction, rounded down: start, phase, advance"
        rows.add(Check.of("clock", wrong, 0, words))


def _clock_errors(made: Part, ticks: int, periods: int) -> int:
    """Ticks, of two rounds, at which phase or laps are not those of exact fractions."""
    start, clock_phase, advance = (made.library.function(name) for name in ("start", "phase", "advance"))
    ffi, unit = made.library.ffi, Fraction(1, 2**24 if made.real == "float" else 2**52)
    clock, phase = ffi.new(ffi.typeof(start).args[2]), ffi.new(ffi.typeof(clock_phase).args[1])
    wrong = int(start(ticks, periods, clock) != 0)
    for tick in range(2 * ticks):
        wrong += int(clock_phase(clock, phase) != 0)
        laps, part = divmod(Fraction(tick * periods, ticks), 1)
        wrong += int(not 0 <= part - Fraction(float(phase[0])) < unit or clock.laps != laps)
        wrong += int(advance(clock) != 0)
    return wrong
