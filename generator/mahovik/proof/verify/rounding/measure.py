"""Measures the true error of the C over states: against the literal equations, and against its own program."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from flint import ctx

from mahovik.contract.functions import FUNCTIONS, wants_of
from mahovik.core.program.types import Precision
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError
from mahovik.proof import reference, rigorous
from mahovik.proof.rigorous.evaluate import BITS, Balls, enclose
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.c_backend import CBackend
from mahovik.proof.verify.compare import Row
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, report
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.rounding.error import MISSING, Array, Error, error, narrow, units
from mahovik.proof.verify.rounding.exact_program import ExactProgram, given_to_c
from mahovik.proof.verify.rounding.limits import ULPS
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request

Values = dict[str, Any]


@dataclass
class Rounding:
    """One line of the table: a quantity.

    row    error over the natural scale, judged by the tolerance of `verify` and by the limits in ulp
    ulps   worst error in ulp of the natural scale: of stand file and state to the answer
    alone  the same of the function alone: its table, and the attitude as it got it, are exact
    judges the same of those that `verify` judges by, reference and second derivation: of whichever is worse
    apart  error of these over the natural scale
    own    error over the largest component of the same unit, state by state
    limit  accepted of `ulps`; None where nothing is promised but the tolerance
    """

    row: Row
    limit: float | None
    ulps: float = 0.0
    alone: float = 0.0
    judges: float = 0.0
    apart: float = 0.0
    own: list[float] = field(default_factory=list)

    @property
    def typical(self) -> float:
        """Median of `own`: what a user sees; its worst says only how much cancels at some state."""
        return median(self.own) if self.own else 0.0

    def note(
        self, request: Request, whole: Error, alone: Error, judges: Sequence[Error] = (), reason: str = ""
    ) -> None:
        """Count one state; the row keeps the one of the most ulp."""
        row = self.row
        if row.request is None or whole.ulps > self.ulps:
            row.request, row.reason, row.state = request, reason, str(request.id)
        row.states += 1
        row.worst = max(row.worst, whole.scale)
        self.ulps = max(self.ulps, whole.ulps)
        self.alone = max(self.alone, alone.ulps)
        for judge in judges:
            self.judges, self.apart = max(self.judges, judge.ulps), max(self.apart, judge.scale)
        self.own.append(whole.own)

    def judge(self) -> None:
        """Set the verdict of the row."""
        row, beyond = self.row, self.limit is not None and self.ulps > self.limit
        row.verdict = "ok" if row.states and row.excess <= 1 and not beyond else "FAILED"
        if beyond and not row.reason:
            row.reason = f"{self.ulps:.3g} ulp of the natural scale, {self.limit:g} accepted"


@dataclass(frozen=True)
class RoundingReport:
    """The lines, and the same as `verify` reports them."""

    real: str
    lines: tuple[Rounding, ...]
    report: Report


class Ruler:
    """Measures one C at state after state."""

    def __init__(self, stand: Stand, backend: CBackend, real: str) -> None:
        self._stand = stand
        self._backend = backend
        self._real = real
        self._floor = BOUNDS[real].floor
        self._second = Second(stand)
        self._exact: dict[CBackend, ExactProgram] = {}
        self.lines: dict[tuple[str, str], Rounding] = {}

    @property
    def wants(self) -> tuple[str, ...]:
        """What the C offers and has an enclosure."""
        return tuple(want for want in wants_of("rigorous") if want in self._backend.wants)

    def measure(self, name: str, state: State) -> None:
        """Note the errors of all wants at a state; one that the reference refuses is no test."""
        at = self._pieces(state)
        if at is None:
            return
        pieces = cache(lambda bits: rigorous.pieces_at(self._stand, state, bits))
        for want in self.wants:
            judges = self._judges(state, want, at)
            if not judges:
                continue
            with np.errstate(all="ignore"):
                natural = scales(self._stand, state, at, want)

            def literal(bits: int, want: str = want) -> Balls:
                return rigorous.evaluate(pieces(bits), state, want, bits)

            self._note(Request(name, state, (want,)), natural, literal, judges)

    def _note(
        self, request: Request, natural: Values, literal: Callable[[int], Balls], judges: Sequence[Values]
    ) -> None:
        """Note the errors of one want, and of what judges found of it, by the literal equations and the program."""
        state, want = request.state, request.want
        judged = self._judged(state)
        program = self._program(judged)

        def good(balls: Balls) -> bool:
            return all(narrow(balls[key], self._units(scale)) for key, scale in natural.items())

        try:
            found = judged.evaluate(state, want)
            given = given_to_c(judged, state)

            def alone(bits: int) -> Balls:
                with ctx.workprec(bits):
                    return program.evaluate(given, want)

            whole, own = enclose(literal, good), enclose(alone, good)
        except StateError as refusal:
            for key in natural:
                self._line(want[0], key).note(request, MISSING, MISSING, reason=str(refusal))
            return
        with ctx.workprec(BITS):
            for key, scale in natural.items():

                def off(values: Values, balls: Balls, key: str = key, scale: Any = scale) -> Error:
                    return error(key, values[key], balls[key], scale, self._floor, self._precision.significand)

                others = [off(values, whole) for values in judges]
                self._line(want[0], key).note(request, off(found, whole), off(found, own), others)

    def _pieces(self, state: State) -> reference.Pieces | None:
        try:
            with np.errstate(all="ignore"):
                return reference.pieces(self._stand, state)
        except (StateError, ArithmeticError):
            return None

    def _judges(self, state: State, want: str, at: reference.Pieces) -> list[Values]:
        """What reference and second derivation find; nothing where the reference refuses."""
        try:
            found = [reference.evaluate(self._stand, state, [want], at)]
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return []
        if "second" in FUNCTIONS[want].judges:
            with suppress(StateError):  # `verify` reports that
                found.append(self._second.evaluate(state, (want,)))
        return found

    def _judged(self, state: State) -> CBackend:
        """The C that takes the run-time wrenches of a state."""
        return self._backend if set(state.wrench) <= set(self._backend.inputs) else self._backend.full

    def _units(self, scale: Any) -> Array:
        return units(scale, self._floor, self._precision.significand)

    @property
    def _precision(self) -> Precision:
        return self._backend.layout.precision

    def _program(self, judged: CBackend) -> ExactProgram:
        if judged not in self._exact:
            self._exact[judged] = ExactProgram(judged.layout, judged.program, judged.table(), judged.mounting)
        return self._exact[judged]

    def _line(self, want: str, quantity: str) -> Rounding:
        key = (want, quantity)
        if key not in self.lines:
            row = Row(want, quantity, tolerance=BOUNDS[self._real].of(want, quantity))
            self.lines[key] = Rounding(row, ULPS[self._real])
        return self.lines[key]


def measure_rounding(
    stand: Stand,
    *,
    seed: int = 1,
    count: int = 200,
    real: str = "double",
    against: Path | None = None,
    progress: Progress | None = None,
    backend: CBackend | None = None,
) -> RoundingReport:
    """Errors of the generated C, fresh or as it lies in `against`, over the states of `verify`.

    `backend`: where it is compiled already. Raises ToolchainError where it does not compile, CheckError where it is of
    another stand.
    """
    backend = backend or CBackend(stand, real, against)
    states = draw(stand, seed, count, real, wrenches=against is None)
    ruler = Ruler(stand, backend, real)
    for done, (name, state) in enumerate(states):
        ruler.measure(name, state)
        if progress is not None:
            progress(done + 1, len(states))
    lines = tuple(ruler.lines.values())
    for line in lines:
        line.judge()
    judged = f"{real} C" if against is None else f"{real} C in {against}"
    rows = [line.row for line in lines]
    return RoundingReport(real, lines, report(stand, judged, seed, len(states), BOUNDS[real].default, rows))
