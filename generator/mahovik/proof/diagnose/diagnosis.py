"""Diagnosis of a program: its requests, the search of its error, and the result."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from mahovik.contract.functions import wants_of_carrier
from mahovik.core.stand.model import Stand
from mahovik.core.stand.state import State
from mahovik.proof.diagnose.answer_vector import answer_vector
from mahovik.proof.diagnose.factors import WholeFactor, whole_factors
from mahovik.proof.diagnose.gaps import Gap, gaps_of
from mahovik.proof.diagnose.predict import Part, Predictions
from mahovik.proof.diagnose.search import Evidence, Finding, Search
from mahovik.proof.diagnose.states import FIRST, separating_states
from mahovik.proof.diagnose.terms.search import TermSearchResult, WrongTerm
from mahovik.proof.reference.array import Array
from mahovik.proof.verify.bounds import DOUBLE, FLOAT, Bounds, uniform
from mahovik.proof.verify.harness import applicable
from mahovik.proof.verify.states import Request

Outcome = Literal["equal", "rounding", "named", "terms", "factors", "unknown", "nothing"]

NINE_DIGITS = 5e-9
"""Relative rounding of a number written with nine digits; one of double lies up to 6e-8 from the next of float."""

Answers = Callable[[Request], Mapping[str, Any]]
"""Answer of a program to a request: empty if it refused."""


@dataclass(frozen=True)
class Cause:
    """A cause of the error of a program: one fault, or two at once.

    parts    faults, each with the flywheel it is in alone, or None
    score    0: it explains the error to rounding; 1: it explains nothing
    only_in  quantities in which the error is, where the fault would spoil others as well; else empty
    """

    parts: tuple[Part, ...]
    score: float
    only_in: tuple[str, ...] = ()


@dataclass(frozen=True)
class Diagnosis:
    """Result of the search of a program's error.

    outcome     equal: no error beyond double rounding at these states; rounding: none beyond that of float, and the
                answers are in float; named: `causes`; terms: `wrong_terms`; factors: `factors`; unknown: an error that
                none of these explains; nothing: no numbers
    causes      the best first; more than one where answers at these states cannot tell them apart
    confidence  of `named`, 0 to 1: how well the first explains the error, and how much worse the best other does
    others      the next best, for what they are worth
    unseen      names of faults that have no effect on this stand, in what the program offers
    wrong       quantities with an error, as want: quantity
    terms       of an unknown error, the wrong terms that a sparse fit finds, see `terms`; None: not looked for
    gaps        wants with answers that are no numbers, which are left out of all else
    failed      what the table says FAILED and the diagnosis finds no difference in: it did not compare this
    hindrance   why wrong terms were not looked for, where gaps leave too few answers
    factors     of an error that is no whole fault, the constant factors of quantities that explain all of it
    """

    outcome: Outcome
    causes: tuple[Cause, ...] = ()
    confidence: float = 0.0
    others: tuple[Cause, ...] = ()
    unseen: tuple[str, ...] = ()
    wrong: tuple[str, ...] = ()
    terms: TermSearchResult | None = None
    gaps: tuple[Gap, ...] = ()
    failed: tuple[str, ...] = ()
    hindrance: str = ""
    factors: tuple[WholeFactor, ...] = ()

    @property
    def wrong_terms(self) -> tuple[WrongTerm, ...]:
        """Wrong terms that are the whole error; none where they leave more than rounding."""
        return self.terms.terms if self.terms is not None and self.terms.whole else ()

    @property
    def verdict(self) -> Literal["none", "named", "approximate", "unnamed"]:
        """Whether there is an error, and whether it has a name: that of a fault, or those of wrong terms.

        Approximate: a want beside those of the wrong terms has an error without a name.
        """
        if self.outcome in ("equal", "rounding"):
            return "unnamed" if self.gaps or self.failed else "none"
        if self.outcome == "terms" and self.terms is not None and self.terms.besides:
            return "approximate"
        return "named" if self.outcome in ("named", "terms", "factors") else "unnamed"

    @property
    def of_two(self) -> bool:
        """Whether two faults at once are named: along few freedoms a wrong factor looks like two of many faults."""
        return self.outcome == "named" and len(self.causes[0].parts) > 1

    def with_terms(self, found: TermSearchResult) -> Diagnosis:
        """The diagnosis of an error after the search for wrong terms: of one that is unknown, or named as two faults.

        In place of two faults terms are named only where they are no more than these.
        """
        after = replace(self, terms=found)
        if self.of_two and not 0 < len(after.wrong_terms) <= len(self.causes[0].parts):
            return self
        return replace(after, outcome="terms", causes=(), others=()) if after.wrong_terms else after

    def by_factors(self) -> Diagnosis:
        """The diagnosis by constant factors of whole quantities, where these are a shorter name than what was found."""
        if not self.factors or not (self.outcome in ("unknown", "terms") or self.of_two):
            return self
        names = len(self.wrong_terms) or min((len(each.parts) for each in self.causes), default=0)
        count, plain = len(self.factors), all(each.is_plain for each in self.factors)
        if names and (count > names or (count == names and not plain)):
            return self
        return replace(self, outcome="factors", causes=(), others=(), confidence=0.0, terms=None)

    @property
    def unexplained(self) -> float:
        """Part of the error that has no name, 0 to 1."""
        if self.verdict == "none":
            return 0.0
        if self.outcome == "factors":
            return 0.0
        if self.terms is not None and self.terms.whole:
            return self.terms.unexplained
        return self.causes[0].score if self.causes else 1.0


class Diagnoser:
    """Diagnoses programs of one stand: the states, the reference's answers and what the faults predict are kept."""

    def __init__(
        self,
        stand: Stand,
        seed: int = 1,
        wants: Sequence[str] = (),
        states: Sequence[tuple[str, State]] | None = None,
        tolerance: float = DOUBLE.default,
        actuators: bool = False,
        on_hold: bool = False,
    ) -> None:
        """`states`: the only ones with answers, by name, as in a log; None: those that tell faults apart best.

        `tolerance`: accepted difference, relative to the natural scale; that of float is a rounding in any case.

        `actuators`: the program takes deflections of fins and speeds of propellers. `on_hold`: it takes only poses that
        the hold allows.
        """
        self._stand = stand
        self._double, self._float = (
            each if each.default >= tolerance else uniform(tolerance) for each in (DOUBLE, FLOAT)
        )
        if states is None:
            states = separating_states(stand, seed, actuators, on_hold)
        asked = [
            (number, Request(f"{name}, {want}", state, (want,)))
            for number, (name, state) in enumerate(states)
            for want in wants or wants_of_carrier(stand.hold is not None)
            if applicable(state, want) and (stand.flywheels or want != "inverse")
        ]
        self.whole = answer_vector(stand, [request for _, request in asked])
        searched = {request.id for number, request in asked if number < FIRST}
        count = sum(request.id in searched for request in self.whole.requests)
        self._first = self.whole.head(count).expected.size
        self.predictions = Predictions(stand, self.whole, count)

    @property
    def requests(self) -> tuple[Request, ...]:
        """Requests for a program."""
        return self.whole.requests

    def diagnose(self, answers: Answers) -> Diagnosis:
        """The diagnosis of a program by its answers to `requests`."""
        found = self.whole.fill(answers)
        found[~np.isfinite(found)] = np.nan
        gaps = gaps_of(self._stand, self.whole, found, answers)
        diagnosed = replace(self._by_numbers(found), gaps=gaps)
        if diagnosed.outcome != "unknown" and not diagnosed.of_two:
            return diagnosed
        noise = self.whole.noise(self._precision(found))
        return replace(diagnosed, factors=whole_factors(self.whole, found, diagnosed.wrong, noise))

    def _precision(self, found: Array) -> Bounds:
        """The bounds of the program's own element type."""
        return self._float if is_float(found) else self._double

    def _by_numbers(self, found: Array) -> Diagnosis:
        """The diagnosis by the numbers that there are."""
        if not np.isfinite(found).any():
            return Diagnosis("nothing")
        fine = self._evidence(found, self._double)
        if not self._wrong(fine):
            return Diagnosis("equal")
        own = self._evidence(found, self._precision(found))
        return self._search(own) if self._wrong(own) else Diagnosis("rounding", wrong=self._wrong(fine))

    def _evidence(self, found: Array, bounds: Bounds) -> Evidence:
        e = self.whole.over_scale(found - self.whole.expected)
        return Evidence(e, self.whole.noise(bounds), self.whole.block, self._first)

    def _wrong(self, evidence: Evidence) -> tuple[str, ...]:
        """Quantities with an error beyond rounding."""
        there = np.abs(np.nan_to_num(evidence.e, nan=0.0)) > evidence.noise
        blocks = sorted({int(i) for i in evidence.block[there]})
        return tuple(f"{want}: {quantity}" for want, quantity in (self.whole.quantities[i] for i in blocks))

    def _search(self, evidence: Evidence) -> Diagnosis:
        wrong = self._wrong(evidence)
        search = Search(self._stand, evidence, self.predictions)
        ranked = search.rank_suspects()
        unseen = tuple(part.fault.name for (part,) in search.invisible_faults())
        if not ranked or not ranked[0].match.exact:
            nearest = sorted(ranked, key=lambda each: each.match.score)[:3]
            return Diagnosis("unknown", (), 0.0, tuple(_cause(each, wrong) for each in nearest), unseen, wrong)
        best = ranked[0]
        twins = search.equal_findings(best, ranked)
        others = [each for each in ranked if not any(each.repeats(named) for named in (best, *twins))]
        return Diagnosis(
            "named",
            tuple(_cause(each, wrong) for each in (best, *twins)),
            _confidence(best, others),
            tuple(_cause(each, wrong) for each in others)[:3],
            unseen,
            wrong,
        )


def is_float(numbers: Array) -> bool:
    """Whether all numbers that there are may be of float, written with nine digits or more."""
    there = numbers[np.isfinite(numbers)]
    with np.errstate(over="ignore"):
        rounded = there.astype(np.float32).astype(np.float64)
    return bool((np.abs(there - rounded) <= NINE_DIGITS * np.abs(there)).all())


def _cause(finding: Finding, wrong: Sequence[str]) -> Cause:
    only = tuple(wrong) if finding.match.absent and finding.match.exact else ()
    return Cause(finding.suspect, finding.match.score, only)


def _confidence(best: Finding, others: Sequence[Finding]) -> float:
    """(1 - score) (1 - score / next score)."""
    score = best.match.score
    next_score = min((each.match.score for each in others), default=1.0)
    apart = 1.0 - min(score / next_score, 1.0) if next_score > 0.0 else 0.0
    return (1.0 - score) * apart
