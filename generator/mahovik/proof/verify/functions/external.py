"""Judges of functions that repeat what a want gives: `wrench`, and the forms of given sines and cosines."""

from __future__ import annotations

from collections.abc import Iterator

from mahovik.contract.functions import FUNCTIONS
from mahovik.errors import StateError
from mahovik.proof.verify.check import Check
from mahovik.proof.verify.compare import Judge
from mahovik.proof.verify.functions.case import Case
from mahovik.proof.verify.scales import scales
from mahovik.proof.verify.states import Request

MOTIONS = ("forward", "coupled")
"""Wants whose answer has the reaction of a hold beside it."""


def wrench_rows(case: Case) -> Iterator[Check]:
    """F of (7) against that of the literal reference."""
    row = Check("wrench", "F", case.bounds.of("matrices", "F"), case.bounds.floor)
    for name, state in case.states:
        at = case.at(state)
        scale = scales(case.stand, state, at, "matrices", case.bounds.cuts)["F"]
        try:
            row.compare(case.call("wrench", case.backend.arguments(state))["F"], at.F, scale, name)
        except StateError as error:
            row.refuse(error, name)
    yield row


def rows_of_given_sines(case: Case, function: str) -> Iterator[Check]:
    """A function `NAME_at` of given sines and cosines, against the reference's answer to the want NAME."""
    want = function.removesuffix("_at")
    judge = Judge(case.stand, case.bounds)
    assert FUNCTIONS[want].want
    for name, state in case.states:
        request = Request(name, state, (want,))
        try:
            inputs = case.backend.arguments(state)
            found = case.call(function, inputs)
            judge.compare(request, want, case.backend.with_reaction(inputs, found) if want in MOTIONS else found)
        except StateError as error:
            judge.compare(request, want, None, words=str(error))
    for row in judge.rows():
        row.judged = function
        row.request = None  # `eval` has no want of this name
        yield row
