"""True error of the C over states, by the literal equations and its own program in ball arithmetic; and its table."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from flint import arb, ctx

from mahovik.contract.functions import FUNCTIONS, wants_of
from mahovik.core.lower.layout import Layout
from mahovik.core.program.function import Program
from mahovik.core.program.interpret import Interpreter
from mahovik.core.program.types import Precision
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.errors import StateError, UsageError
from mahovik.proof import reference, rigorous
from mahovik.proof.rigorous import BITS, Balls, enclose
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import BOUNDS
from mahovik.proof.verify.c_backend import CBackend, prepare_records
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.draw import draw
from mahovik.proof.verify.harness import Progress, report
from mahovik.proof.verify.program_backend import ProgramBackend, is_beyond, public_names
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.report import as_json as report_json
from mahovik.proof.verify.report import conclusion as report_conclusion
from mahovik.proof.verify.rounding.error import MISSING, Error, error, is_narrow, units
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request

ULPS: Mapping[str, float | None] = {"double": 50.0, "float": None}
"""Largest accepted error of every quantity in ulp of its natural scale, by element type.

None for float: the tolerances of `verify` are stricter there. In double 1e-12 is 4500 ulp, so that an error of 1e-12
in one number would pass by the tolerance alone.
"""

MARGIN = 3.0
"""Least ratio of a tolerance of `verify` to the possible difference of C and judge (docs/results.md)."""


def ball_precision(precision: Precision) -> Precision:
    """The element type with balls for numbers; those that come in are rounded to the type first, as in C."""

    def ball(x: Any) -> arb:
        return x if isinstance(x, arb) else arb(float(precision.scalar(x)))

    return replace(precision, scalar=ball)


def sincos(x: arb, sine: list[arb], cosine: list[arb]) -> None:
    """The program's function of that name."""
    sine[0], cosine[0] = x.sin_cos()


def sincos_each(x: Sequence[arb], sine: list[arb], cosine: list[arb]) -> None:
    """The program's function of that name; places beyond the angles are zero."""
    for place in range(len(sine)):
        sine[place], cosine[place] = x[place].sin_cos() if place < len(x) else (arb(0), arb(0))


ROUTINES: Mapping[str, Callable[..., Any]] = {
    "sincos": sincos,
    "sincos_each": sincos_each,
    "sqrt": lambda x: x.nonnegative_part().sqrt(),  # a ball may reach below zero though its number does not
    "atan2": arb.atan2,
    "exp": arb.exp,
}
"""Functions of Arb in the place of the program's own, so that its polynomials count as rounding."""


class ExactProgram(ProgramBackend):
    """The program of a stand in ball arithmetic, on the table of its C: what the C would give if nothing were rounded.

    The difference to the C is the error of a function alone, its table taken as exact; that of the table is in the
    difference to the literal equations. Wants are evaluated at the working precision.
    """

    def __init__(self, layout: Layout, program: Program, table: Any, mounting: Any) -> None:
        exact = replace(program, precision=ball_precision(program.precision))
        interpreter = Interpreter(exact, ROUTINES)
        # the numbers of the records are binary: exact at any precision
        super().__init__(
            "exact", layout, exact, *prepare_records(interpreter, layout, table, mounting), interpreter.run
        )


def state_given_to_c(backend: ProgramBackend, state: State) -> State:
    """The state with the quaternion that the C gets; for angles, the one from its own function `quaternion`."""
    rounded = backend.layout.precision.scalar
    w, x, y, z = (float(rounded(element)) for element in backend.arguments(state)["x"]["attitude"])
    return replace(state, angles=None, quaternion=(w, x, y, z))


Values = dict[str, Any]


@dataclass
class Rounding:
    """One line of the table: a quantity.

    row    error over the natural scale, judged by the tolerance of `verify` and by the limits in ulp
    ulps   worst error in ulp of the natural scale: of stand file and state to the answer
    alone  the same of the function alone: its table, and the attitude as it got it, are exact
    judges worst error of reference and second derivation, in the same units
    apart  error of these over the natural scale
    own    error over the largest component of the same unit, state by state
    limit  accepted of `ulps`; None where nothing is promised but the tolerance
    """

    row: Check
    limit: float | None
    ulps: float = 0.0
    alone: float = 0.0
    judges: float = 0.0
    apart: float = 0.0
    own: list[float] = field(default_factory=list)

    @property
    def typical(self) -> float:
        """Median of `own`, which users see; its maximum shows only how much cancels at some state."""
        return median(self.own) if self.own else 0.0

    def note(
        self, request: Request, whole: Error, alone: Error, judges: Sequence[Error] = (), reason: str = ""
    ) -> None:
        """Count one state; the row keeps the one of the most ulp."""
        row = self.row
        if row.request is None or whole.ulps > self.ulps:
            row.request, row.words, row.state = request, reason, str(request.id)
        row.states += 1
        row.value = max(row.value, whole.scale)
        self.ulps = max(self.ulps, whole.ulps)
        self.alone = max(self.alone, alone.ulps)
        for judge in judges:
            self.judges, self.apart = max(self.judges, judge.ulps), max(self.apart, judge.scale)
        self.own.append(whole.own)

    def judge(self) -> None:
        """Set the verdict of the row."""
        row, beyond = self.row, self.limit is not None and self.ulps > self.limit
        row.verdict = "ok" if row.states and row.share <= 1 and not beyond else "FAILED"
        if beyond and not row.words:
            row.words = f"{self.ulps:.3g} ulp of the natural scale, {self.limit:g} accepted"


@dataclass(frozen=True)
class RoundingReport:
    """Result of a measurement: the lines of the table, and a report like that of `verify`."""

    real: str
    lines: tuple[Rounding, ...]
    report: Report


class Ruler:
    """Measures one C at state after state."""

    def __init__(self, stand: Stand, backend: CBackend, real: str) -> None:
        self._stand = stand
        self._backend = backend
        self._bounds = BOUNDS[real]
        self._limit = ULPS[real]
        self._significand = backend.layout.precision.significand
        self._second = Second(stand)
        self._exact_program = cache(lambda c: ExactProgram(c.layout, c.complete.program, c.table(), c.mounting))
        self.lines: dict[tuple[str, str], Rounding] = {}

    @property
    def wants(self) -> tuple[str, ...]:
        """Wants that the C offers and that have an enclosure."""
        return tuple(want for want in wants_of("rigorous") if want in self._backend.wants)

    def measure(self, name: str, state: State) -> None:
        """Note the errors of all wants at a state; one that the reference refuses is no test."""
        try:
            with np.errstate(all="ignore"):
                at = reference.pieces(self._stand, state)
        except (StateError, ArithmeticError):
            return
        exact = cache(lambda bits: rigorous.exact_at(self._stand, state, bits))
        for want in self.wants:
            judges = self._judges(state, want, at)
            if not judges:
                continue
            with np.errstate(all="ignore"):
                natural = scales(self._stand, state, at, want)
            if is_beyond(judges[0]):  # of these accelerations the C gives no reaction
                natural.pop("reaction", None)

            def literal(bits: int, want: str = want) -> Balls:
                return rigorous.evaluate(exact(bits), want)

            self._note(Request(name, state, (want,)), natural, literal, judges)

    def _note(
        self, request: Request, natural: Values, literal: Callable[[int], Balls], judges: Sequence[Values]
    ) -> None:
        """Note the errors of one want, and of what judges found of it, by the literal equations and the program."""
        state, want, floor = request.state, request.want, self._bounds.floor
        # the C that takes the run-time wrenches of the state
        judged = self._backend if set(state.wrench) <= set(self._backend.inputs) else self._backend.full
        program = self._exact_program(judged)

        def good(balls: Balls) -> bool:
            return all(is_narrow(balls[key], units(scale, floor, self._significand)) for key, scale in natural.items())

        try:
            found = judged.evaluate(state, want)
            given = state_given_to_c(judged, state)

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

                def error_of_values(values: Values, balls: Balls, key: str = key, scale: Any = scale) -> Error:
                    return error(key, values[key], balls[key], scale, floor, self._significand)

                others = [error_of_values(values, whole) for values in judges]
                self._line(want[0], key).note(
                    request, error_of_values(found, whole), error_of_values(found, own), others
                )

    def _judges(self, state: State, want: str, at: reference.Pieces) -> list[Values]:
        """Answers of reference and second derivation; none if the reference refuses."""
        try:
            found = [reference.evaluate(self._stand, state, [want], at)]
        except (StateError, np.linalg.LinAlgError, ArithmeticError):
            return []
        if "second" in FUNCTIONS[want].judges:
            with suppress(StateError):  # `verify` reports that
                found.append(self._second.evaluate(state, (want,)))
        return found

    def _line(self, want: str, quantity: str) -> Rounding:
        row = Check(want, quantity, self._bounds.of(want, quantity))
        return self.lines.setdefault((want, quantity), Rounding(row, self._limit))


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
    """Errors of the generated C, fresh or in the folder `against`, over the states of `verify`.

    `backend`: where it is compiled already. Raises ToolchainError where it does not compile, CheckError where it is of
    another stand.
    """
    backend = backend or CBackend(stand, real, against)
    states = draw(stand, seed, count, real, wrenches=against is None)
    ruler = Ruler(stand, backend, real)
    if not ruler.wants:
        there, expected = ", ".join(public_names(backend.program)), ", ".join(wants_of("rigorous"))
        raise UsageError(f"--rigorous: {against} holds {there}, expected one of {expected}: no other has enclosures")
    for done, (name, state) in enumerate(states):
        ruler.measure(name, state)
        if progress is not None:
            progress(done + 1, len(states))
    lines = tuple(ruler.lines.values())
    for line in lines:
        line.judge()
    judged = f"{real} C" if against is None else f"{real} C in {against}"
    judged += f", only {', '.join(public_names(backend.program))}" if backend.left_out else ""
    rows = [line.row for line in lines]
    return RoundingReport(real, lines, report(stand, judged, seed, len(states), BOUNDS[real].default, rows))


NEGLIGIBLE = 1e-9
"""Errors below this, in ulp, are shown as 0: the answer is exact, and its enclosure has a radius."""


def ulp_text(ulps: float, digits: int = 2) -> str:
    """Text of an error in ulp."""
    return "0" if ulps < NEGLIGIBLE else f"{ulps:.{digits}g}"


def conclusion(found: RoundingReport) -> str:
    """The verdict."""
    if not found.report.passed:
        return report_conclusion(found.report)
    worst = max(found.lines, key=lambda line: line.ulps)
    words = f"passed: worst {ulp_text(worst.ulps)} ulp of the natural scale, {worst.row.quantity} ({worst.row.judged})"
    return words if worst.limit is None else f"{words}; {worst.limit:g} accepted"


def as_json(found: RoundingReport) -> str:
    """JSON of `verify`, with the errors of each row; null where an error is not finite."""
    table: dict[str, Any] = json.loads(report_json(found.report))
    table["real"] = found.real
    table["conclusion"] = conclusion(found)
    for row, line in zip(table["rows"], found.lines, strict=True):
        for unused in ("second",):
            del row[unused]
        row.update(_errors(line))
    return json.dumps(table, indent=1, allow_nan=False)


def _errors(line: Rounding) -> dict[str, float | None]:
    found = {
        "ulps": line.ulps,
        "ulps_accepted": line.limit,
        "ulps_function_alone": line.alone,
        "ulps_judges": line.judges,
        "worst_judges": line.apart,
        "relative_typical": line.typical,
        "relative_worst": max(line.own, default=0.0),
    }
    return {key: x if x is not None and math.isfinite(x) else None for key, x in found.items()}
