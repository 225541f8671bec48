"""Finding the fault of what a report has judged: readings and numbers first, then terms."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from mahovik.core.stand.model import Stand, State
from mahovik.errors import CheckError
from mahovik.proof.diagnose.answers import Answers, spread_rows
from mahovik.proof.diagnose.columns import count
from mahovik.proof.diagnose.diagnosis import Diagnoser, Diagnosis
from mahovik.proof.diagnose.search import WANTS, TermSearch
from mahovik.proof.verify.check import Report
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.states import Request

ROWS_OF_FAULTS = 14
"""Rows of a log at which its error is compared with that of each fault."""

ROWS_OF_TERMS = 3
"""Rows of a log for each product whose factor is looked for, at most."""

States = Sequence[tuple[str, State]]


@dataclass(frozen=True)
class Judged:
    """A verdict, and what can be asked to find its fault.

    answers    of requests
    tolerance  accepted difference, relative to the natural scale
    states     the only ones with answers, those of a log; None: any
    program    that answers; None of a log
    """

    report: Report
    answers: Callable[[Sequence[Request]], Answers]
    tolerance: float
    states: States | None = None
    program: Program | None = None


def diagnose_fault(stand: Stand, document: Mapping[str, Any], judged: Judged, seed: int) -> Diagnosis:
    """Diagnosis of what differs, for the wants that it offers; `document`: keys of the stand's file.

    Raises CheckError, UsageError.
    """
    report, states, program = judged.report, judged.states, judged.program
    if report.passed:
        return Diagnosis("none")
    offered = tuple(dict.fromkeys(row.judged for row in report.rows if row.verdict in ("ok", "FAILED")))
    if not offered:
        return Diagnosis("unnamed", unexplained=1.0, failed=_failure_words(report))
    rows = None if states is None else spread_rows(states, ROWS_OF_FAULTS + len(stand.flywheels))
    diagnoser = Diagnoser(
        stand, document, seed=seed, wants=offered, states=rows, tolerance=judged.tolerance, program=program
    )
    diagnosed = diagnoser.diagnose(judged.answers(diagnoser.requests))
    diagnosed = replace(diagnosed, failed=_failure_words(report, diagnosed.wrong))
    precision = diagnosed.precision
    if precision is None or not diagnosed.wrong or (diagnosed.verdict == "named" and len(diagnosed.causes) < 2):
        if diagnosed.verdict == "none" and diagnosed.failed:
            return replace(diagnosed, verdict="unnamed")
        return diagnosed
    if not set(offered) & set(WANTS):
        return diagnosed
    if states is not None:
        states = spread_rows(states, ROWS_OF_TERMS * count(stand))
    terms = TermSearch(stand, seed, offered, states, precision, program, diagnosed.wrong)
    try:
        return diagnosed.with_terms(terms.find(judged.answers(terms.requests)))
    except CheckError as error:
        if not (diagnosed.missing or diagnosed.causes):
            raise
        return diagnosed if diagnosed.verdict == "named" else replace(diagnosed, hindrance=str(error))


def _failure_words(report: Report, compared: Sequence[str] = ()) -> tuple[str, ...]:
    """What failed in the table, with its reason; without what a diagnosis has `compared`, as want: quantity."""
    return tuple(
        f"{row.judged} {row.quantity}".strip() + (f" ({row.words})" if row.words else "")
        for row in report.failures
        if not any(f"{quantity}.".startswith(f"{row.judged}: {row.quantity}.") for quantity in compared)
    )
