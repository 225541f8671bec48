"""Comparison of a log: the answers of its rows, whoever wrote it, against the reference and the second derivation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.second import Second
from mahovik.proof.verify.bounds import DOUBLE, uniform
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.harness import report
from mahovik.proof.verify.report import Report
from mahovik.proof.verify.states import Request

OF_HELD = frozenset(("reaction",))
"""Quantities of a held carrier that the answer of a want may leave out: they have a want of their own."""


def verify_log(
    stand: Stand,
    source: str,
    states: Sequence[tuple[str, State]],
    answers: Mapping[str, Mapping[str, Mapping[str, Any]]],
    *,
    wants: Sequence[str] = (),
    tolerance: float = DOUBLE.default,
) -> Report:
    """Judge the rows of a log, `answers` by want and by name of the state. `wants`: those it must answer."""
    judge = Judge(stand, uniform(tolerance), Second(stand), "log")
    given = {want: set().union(*rows.values()) for want, rows in answers.items()}
    for name, state in states:
        for want in wants or answers:
            if name in answers.get(want, {}):
                left_out = () if stand.hold is None else OF_HELD - given[want]
                judge.compare(Request(f"{name}, {want}", state, (want,)), want, answers[want][name], left_out)
    rows, missing = judge.rows(), [want for want in wants if not answers.get(want)]
    rows += [Check(want, want, verdict="MISSING", words="no row of the log has it") for want in missing]
    return report(stand, source, 0, len(states), tolerance, rows)


def by_request(answers: Mapping[str, Mapping[str, Mapping[str, Any]]]) -> dict[str, Mapping[str, Any]]:
    """The answers of a log by the id of a request of one want."""
    return {f"{name}, {want}": value for want, rows in answers.items() for name, value in rows.items()}
