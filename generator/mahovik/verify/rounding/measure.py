"""Measures the true error of the C over states: against the literal equations, and against its own program."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from flint import ctx

from mahovik import reference, rigorous
from mahovik.errors import StateError
from mahovik.program.types import Precision
from mahovik.rigorous.evaluate import BITS, Balls, enclose
from mahovik.stand.model import Stand
from mahovik.stand.state import State
from mahovik.verify.bounds import BOUNDS
from mahovik.verify.c_backend import CBackend
from mahovik.verify.compare import Row
from mahovik.verify.draw import draw
from mahovik.verify.harness import Progress, report
from mahovik.verify.report import Report
from mahovik.verify.rounding.error import MISSING, Error, error, narrow, units
from mahovik.verify.rounding.exact_program import ExactProgram, given_to_c
from mahovik.verify.rounding.limits import accepted
from mahovik.verify.scales import scales
from mahovik.verify.states import Request

Naturals = dict[str, Any]


@dataclass
class Rounding:
    """One line of the table: a quantity.

    row    error over the natural scale, judged by the tolerance of `verify` and by the limits in ulp
    ulps   worst error in ulp of the natural scale: of stand file and state to the answer
    alone  the same of the function alone: its table, and the attitude as it got it, are exact
    own    error over the largest component of the same unit, state by state
    limit  accepted of `ulps`; None where nothing is promised but the tolerance
    """

    row: Row
    limit: float | None
    ulps: float = 0.0
    alone: float = 0.0
    own: list[float] = field(default_factory=list)

    @property
    def typical(self) -> float:
        """Median of `own`: what a user sees; its worst says only how much cancels at some state."""
        return median(self.own) if self.own else 0.0

    def note(self, whole: Error, alone: Error, request: Request, reason: str = "") -> None:
        """Count one state."""
        self.row.note(whole.scale, request, reason)
        self.ulps = max(self.ulps, whole.ulps)
        self.alone = max(self.alone, alone.ulps)
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
        self._exact: dict[CBackend, ExactProgram] = {}
        self.lines: dict[tuple[str, str], Rounding] = {}

    @property
    def wants(self) -> tuple[str, ...]:
        """What the C offers and has an enclosure."""
        return tuple(want for want in rigorous.WANTS if want in self._backend.wants)

    def measure(self, name: str, state: State) -> None:
        """Note the errors of all wants at a state; one that the reference refuses is no test."""
        with np.errstate(all="ignore"):
            try:
                at = reference.pieces(self._stand, state)
                for want in self.wants:
                    reference.evaluate(self._stand, state, [want], at)
            except StateError:
                return
            naturals = {want: scales(self._stand, state, at, want) for want in self.wants}
        pieces = cache(lambda bits: rigorous.pieces_at(self._stand, state, bits))
        judged = self._judged(state)
        for want in self.wants:
            request = Request(name, state, (want,))

            def literal(bits: int, want: str = want) -> Balls:
                return rigorous.evaluate(pieces(bits), state, want, bits)

            self._note(request, want, naturals[want], literal, judged)

    def _judged(self, state: State) -> CBackend:
        """The C that takes the run-time wrenches of a state."""
        taken = set(state.wrench) <= set(self._backend.inputs)
        return self._backend if taken else self._backend.full

    def _note(
        self, request: Request, want: str, natural: Naturals, literal: Callable[[int], Balls], judged: CBackend
    ) -> None:
        state, significand = request.state, self._precision.significand
        exact = self._program(judged)

        def own(bits: int) -> Balls:
            with ctx.workprec(bits):
                return exact.evaluate(given, (want,))

        def good(balls: Balls) -> bool:
            unit = {key: units(natural[key], self._floor, significand) for key in balls}
            return all(narrow(balls[key], unit[key]) for key in balls)

        found: dict[str, Any] = {}
        reason = ""
        try:
            found = self._backend.evaluate(state, (want,))
            given = given_to_c(judged, state)
            whole, alone = enclose(literal, good), enclose(own, good)
        except StateError as refusal:
            reason = str(refusal)
            whole = alone = {}
        for key, scale in natural.items():
            line = self._line(want, key)
            if reason:
                line.note(MISSING, MISSING, request, reason)
                continue
            with ctx.workprec(BITS):
                errors = [
                    error(key, found[key], balls[key], scale, self._floor, significand) for balls in (whole, alone)
                ]
            line.note(errors[0], errors[1], request)

    @property
    def _precision(self) -> Precision:
        return self._backend.layout.precision

    def _program(self, judged: CBackend) -> ExactProgram:
        if judged not in self._exact:
            self._exact[judged] = ExactProgram(judged)
        return self._exact[judged]

    def _line(self, want: str, quantity: str) -> Rounding:
        key = (want, quantity)
        if key not in self.lines:
            row = Row(want, quantity, tolerance=BOUNDS[self._real].of(want, quantity))
            self.lines[key] = Rounding(row, accepted(self._real, want, quantity))
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
