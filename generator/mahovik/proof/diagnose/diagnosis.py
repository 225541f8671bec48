"""Diagnosis of a program: a wrong reading, one number of the stand file or two, wrong terms; in words and as data."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from mahovik.contract.functions import wants_of_carrier
from mahovik.contract.limits import DOUBLE
from mahovik.core.stand.model import Stand, State
from mahovik.core.stand.numbers import exact
from mahovik.core.stand.stand_file import document_of
from mahovik.errors import CheckError
from mahovik.proof.diagnose.answers import (
    FIRST,
    Answers,
    AnswerVector,
    Model,
    Precision,
    Reference,
    numbers_at,
    separating_states,
    spread_rows,
)
from mahovik.proof.diagnose.causes import FACTORS, NumberSearch, Reading, SolvedNumbers, answered_by_factor, readings_of
from mahovik.proof.diagnose.columns import TERMS_OF_BODIES, count_products
from mahovik.proof.diagnose.fit import MOST
from mahovik.proof.diagnose.search import WANTS, TermSearch, TermSearchResult, WrongTerm
from mahovik.proof.reference.algebra import Array, carrier_rotation, wrench_to_parent
from mahovik.proof.verify.check import Check, Report
from mahovik.proof.verify.foreign import Program
from mahovik.proof.verify.harness import applicable
from mahovik.proof.verify.states import Request

Verdict = Literal["none", "named", "approximate", "unnamed"]

NEAR = 0.1
"""Part of the error that a reading or a number may leave and be called approximately the cause."""

HOPELESS = 0.5
"""Part of the error that a cause may leave at one state, to be compared with the error at more."""

TELLING, FEW_WANTS = ("coupled", "forward", "torque"), 3
"""Wants by which causes are looked for, before they are compared with all: these where they differ, and how many."""

SIMPLE = 6
"""Digits of a number that people write: of numbers that explain an error alike, one with so few comes first."""


@dataclass(frozen=True)
class Cause:
    """A cause of the error of a program, alone or with another: a reading, or a number of the stand file.

    name    what the program does, or the path of the number
    number  its value in the program, that in the file, and its unit; None of a reading
    like    other names of the same effect on this stand
    only_in wants in which it is, where it would spoil others as well that are right
    """

    name: str
    number: tuple[float, float, str] | None = None
    like: tuple[str, ...] = ()
    only_in: tuple[str, ...] = ()


@dataclass(frozen=True)
class Diagnosis:
    """Result of the search of a program's error.

    verdict      none: no error beyond rounding; named: `causes` or `terms` explain all of it to rounding; approximate:
                 they explain most of it; unnamed: nothing does, or there are no numbers
    causes       at most two at once; of an unnamed error what leaves least of it, which may be far
    unexplained  part of the error that has no name, 0 to 1
    precision    of the program, to which its error is explained; None: it answered no numbers
    wrong        quantities with an error, as want: quantity; follows: those of them that follow from other answers
    terms        wrong terms that a sparse fit finds; None: not looked for
    missing      quantities, as want: quantity, some of whose numbers are missing in answers; they are left out
    failed       what the table says FAILED and the diagnosis did not compare
    hindrance    why wrong terms were not looked for
    """

    verdict: Verdict
    causes: tuple[Cause, ...] = ()
    unexplained: float = 0.0
    precision: Precision | None = None
    wrong: tuple[str, ...] = ()
    follows: tuple[str, ...] = ()
    terms: TermSearchResult | None = None
    missing: tuple[str, ...] = ()
    failed: tuple[str, ...] = ()
    hindrance: str = ""

    @property
    def by_terms(self) -> bool:
        """Whether its causes are wrong terms, beside a reading of bodies if there is one."""
        return self.terms is not None and self.terms.whole and (not self.causes or self.verdict == "named")

    @property
    def not_looked_at(self) -> tuple[str, ...]:
        """Quantities with an error that the search for wrong terms did not look at."""
        looked_at = (*self.follows, *(() if self.terms is None else self.terms.looked_at))
        return tuple(x for x in self.wrong if x not in looked_at)

    def with_terms(self, terms: TermSearchResult) -> Diagnosis:
        """The diagnosis after the search for wrong terms, of an error that has no other name.

        In place of two numbers terms are named only where they are fewer; one in two wants is one term.
        """
        different = {(term.component, term.term) for term in terms.terms}
        fewer = terms.whole and not terms.unexplained and len(different) < len(self.causes)
        if self.verdict == "named" and not fewer:
            return self
        if not terms.whole:
            unsure = replace(self, verdict="unnamed", causes=(), unexplained=1.0) if terms.doubtful else self
            return replace(unsure, terms=terms)
        after = replace(self, verdict="named", causes=(), terms=terms, unexplained=terms.unexplained)
        approximate = terms.besides or after.not_looked_at or terms.unexplained
        return replace(after, verdict="approximate") if approximate else after


class Diagnoser:
    """Diagnoses programs of one stand: the states and the reference's answers are kept."""

    def __init__(
        self,
        stand: Stand,
        document: Mapping[str, Any] | None = None,
        *,
        seed: int = 1,
        wants: Sequence[str] = (),
        states: Sequence[tuple[str, State]] | None = None,
        tolerance: float = DOUBLE.value,
        program: Program | None = None,
    ) -> None:
        """`document`: the keys of the stand's file, whose numbers are named; None: those of the stand in SI.

        `states`: the only ones with answers, by name, as in a log; None: those that tell faults apart best.
        `tolerance`: accepted difference, relative to the scale, where it is more than rounding. `program`: which states
        it takes; None: all.
        """
        self._stand = stand
        self._tolerance = tolerance if tolerance > DOUBLE.value else 0.0
        if states is None:
            states = separating_states(stand, seed, program)
        asked = [
            (number, Request(f"{name}, {want}", state, (want,)))
            for number, (name, state) in enumerate(states)
            for want in wants or wants_of_carrier(stand.hold is not None)
            if applicable(state, want) and (stand.flywheels or want != "inverse")
        ]
        self.whole = AnswerVector.of(stand, [request for _, request in asked])
        self._first = {request.id for number, request in asked if number < FIRST}
        self._document = document if document is not None else exact(document_of(stand))

    @property
    def requests(self) -> tuple[Request, ...]:
        """Requests for a program."""
        return self.whole.requests

    def diagnose(self, answers: Answers) -> Diagnosis:
        """The diagnosis of a program by its answers to `requests`, without wrong terms."""
        numbers = self.whole.fill(answers)
        numbers[~np.isfinite(numbers)] = np.nan
        if not np.isfinite(numbers).any():
            return Diagnosis("unnamed", unexplained=1.0)
        missing = self._missing(numbers, answers)
        precision = Precision.of(numbers, self._tolerance)
        evidence = _Evidence(self.whole, self._first, numbers, precision)
        wrong = self.whole.words_of(evidence.wrong)
        if not wrong:
            return Diagnosis("unnamed" if missing else "none", precision=precision, missing=missing)
        right = evidence.right_beside(self.whole.of_model(self._following(answers)))
        follows = tuple(x for x in wrong if x in right)
        named, near = self._by_reading(evidence, wrong)
        if not named:
            named, near_numbers = self._by_numbers(evidence)
            near = min(near, near_numbers, key=lambda candidate: candidate[0])
        left, causes = (0.0, named) if named else near
        verdict: Verdict = "named" if named else "approximate" if left < NEAR else "unnamed"
        return Diagnosis(verdict, causes, left, precision, wrong, follows, missing=missing)

    def _missing(self, numbers: Array, answers: Answers) -> tuple[str, ...]:
        """Quantities with numbers that are missing; not of states that the program refused, nor what it never has."""
        offered = {f"{request.want[0]}: {key}" for request in self.requests for key in answers(request)}
        parts = zip(self.requests, self.whole.parts, strict=True)
        answered = {x.id for x, of in parts if any(path[0] in answers(x) for path, *_ in of)}
        lost = self.whole.words_of(self.whole.places(answered) & ~np.isfinite(numbers))
        return tuple(name for name in lost if name.partition(".")[0] in offered)

    def _following(self, answers: Answers) -> Model:
        """Quantities by other answers of the program: q_ddot by V_dot, Z0 by Z."""
        right = Reference(self._stand)
        requests = {(id(request.state), request.want[0]): request for request in self.requests}

        def implied(state: State, want: str) -> Mapping[str, Any]:
            source = requests.get((id(state), "forward" if want == "generalized" else want))
            beside = {} if source is None else answers(source)
            V_dot, Z = (numbers_at(beside, (name,)) for name in ("V_dot", "Z"))
            if want == "momentum" and Z is not None and Z.shape == (6,):
                return {"Z0": wrench_to_parent(np.array(state.position), carrier_rotation(self._stand, state)) @ Z}
            at = right(state, want) if want == "generalized" else {}
            if "A" not in at or V_dot is None or V_dot.shape != (6,):
                return {}
            return {"q_ddot": np.linalg.solve(at["A"], V_dot - at["D"] @ at["q_dot"])}

        return implied

    def _by_reading(self, evidence: _Evidence, wrong: Sequence[str]) -> _Search:
        """A reading that explains all of the error, with those of the same effect; else the nearest one."""
        quantities = dict.fromkeys(label.partition(": ")[2] for label in wrong)
        factors = [answered_by_factor(name, factor) for name in quantities for factor in FACTORS]
        exact: list[tuple[Reading, tuple[str, ...]]] = []
        near: _Near = 1.0, ()
        for reading in (*factors, *readings_of(self._stand)):
            if reading.only and exact:
                break
            left, wants = evidence.compare(reading.model(self._stand))
            if wants is not None:
                exact.append((reading, wants))
            elif left < near[0]:
                near = left, (Cause(reading.words),)
        if not exact:
            return (), near
        exact.sort(key=lambda pair: len(pair[1]))  # what is right nowhere else comes first
        best, only = exact[0]
        same = tuple(reading.words for reading, wants in exact[1:] if len(wants) == len(only))
        return (Cause(best.words, None, same, only),), near

    def _by_numbers(self, evidence: _Evidence) -> _Search:
        """A number, or two, that explain all of the error; else those that leave least."""
        search, wide = (
            NumberSearch(self._stand, self._document, self.whole, among, evidence.error, evidence.noise)
            for among in (evidence.few, evidence.every)
        )
        near: _Near = 1.0, ()
        for count in (1, 2):
            exact = []
            for first_solved in search.solutions(count):
                solved = first_solved
                if search.explains(solved.values):  # to the digits that all states tell, which few may not
                    solved = wide.solve(list(solved.values)) or solved
                left, wants = evidence.compare(search.model(solved.values))
                if wants == ():
                    exact.append(wide.rounded(solved))
                elif left < near[0]:
                    near = left, _causes(solved)
            if exact:
                first, *further = sorted(exact, key=_is_unlikely)
                like = tuple(" and ".join(x.path for x in solved.values) for solved in further)
                return tuple(replace(cause, like=like) for cause in _causes(first)), near
        return (), near


_Near = tuple[float, tuple[Cause, ...]]
"""Part of the error that some causes leave, and these."""

_Search = tuple[tuple[Cause, ...], _Near]
"""Causes that explain all of an error, none if there are none; and the nearest of the others."""


class _Evidence:
    """The error of a program, and what of it may be rounding."""

    def __init__(self, whole: AnswerVector, first: Collection[str], answered: Array, precision: Precision) -> None:
        """`first`: ids of requests at states with all features active."""
        self._whole, self._answered = whole, answered
        self.error = answered - whole.expected
        self.noise = precision.noise(np.nan_to_num(answered), whole.scale)
        self.wrong = np.abs(np.nan_to_num(self.error, nan=0.0)) > self.noise
        self._there = np.isfinite(answered)
        self._wants = {want for want, _ in (whole.quantities[i] for i in set(whole.block[self.wrong].tolist()))}
        of_wants = np.array([want in self._wants for want, _ in whole.quantities])
        self._in_wrong_wants = of_wants[whole.block]
        chosen = sorted(self._wants, key=lambda want: (want not in TELLING, want))[:FEW_WANTS]
        self.every = {x.id for x in whole.requests}
        self.few = {x.id for x in whole.requests if x.id in first and x.want[0] in chosen}
        if not self.wrong[whole.places(self.few)].any():
            self.few = self.every
        state = next(x.state for x in whole.requests if x.id in self.few)
        self.one = {x.id for x in whole.requests if x.id in self.few and x.state is state}

    def right_beside(self, numbers: Array) -> set[str]:
        """Quantities all of whose answers are other numbers, to rounding."""
        off = self._there & ~(np.abs(self._answered - numbers) <= self.noise)
        return {*self._whole.words_of(self._there)} - {*self._whole.words_of(off)}

    def compare(self, model: Model) -> tuple[float, tuple[str, ...] | None]:
        """What a model leaves of the error, 0 to 1; and, where this is rounding, the wants that it is in alone.

        These are none where it explains the rightness of all others as well; None where it leaves more than rounding.
        """
        for among in (self.one, self.few, self.every):
            places, predicted = self._whole.places(among), self._whole.of_model(model, among)
            rest = np.abs(np.nan_to_num(self._answered - predicted, nan=np.inf))
            growth = self._growth(np.where(places, self._whole.expected, 0.0), predicted)
            beyond = places & self._there & (rest > self.noise * growth)
            if (beyond & self._in_wrong_wants).any():
                wrong = places & self.wrong
                if among is self.one and not wrong.any():
                    continue
                blocks, e = self._whole.block[wrong], np.abs(self.error[wrong])
                with np.errstate(all="ignore"):
                    shares = np.bincount(blocks, np.minimum(rest[wrong], e) ** 2) / np.bincount(blocks, e**2)
                left = float(np.sqrt(np.nanmean(shares))) if blocks.size else 0.0
                if among is not self.one or left > HOPELESS:
                    return left, None
        return 0.0, tuple(sorted(self._wants)) if beyond.any() else ()

    def _growth(self, right: Array, predicted: Array) -> Array:
        """How much larger the numbers of each quantity are than the right ones: their rounding is so too."""
        largest = np.zeros((2, len(self._whole.quantities)))
        for size, numbers in zip(largest, (right, predicted), strict=True):
            np.maximum.at(size, self._whole.block, np.nan_to_num(np.abs(numbers) / self._whole.scale))
        return np.asarray(np.maximum(1.0, largest[1] / np.maximum(largest[0], 1e-12)))[self._whole.block]


def _causes(solved: SolvedNumbers) -> tuple[Cause, ...]:
    return tuple(Cause(n.path, (value, n.value, n.dimension.si)) for n, value in solved.values.items())


def _is_unlikely(solved: SolvedNumbers) -> tuple[bool, bool, bool]:
    """Whether a number has many digits; whether the file has one as zero; whether one is of the fluid, not the body."""
    digits = [len(f"{x:.15g}".partition("e")[0].replace(".", "").strip("-0")) for x in solved.values.values()]
    numbers = solved.values
    return max(digits) > SIMPLE, any(x.value == 0.0 for x in numbers), any(x.key == "added_mass" for x in numbers)


# -- words -------------------------------------------------------------------------------------------------------------

CONSTANT = "1"
"""The product without factors, as it is written."""

MOST_TWINS = 4
"""Number of products that are printed beside one that looks like them."""

TERM_KEYS = ("want", "component", "term", "factor", "expected", "coefficient", "share")


def sentences(diagnosis: Diagnosis) -> list[str]:
    """Lines with the cause of the error, or what comes nearest; before, numbers that the program leaves out."""
    lines = [f"numbers are missing in {_join(diagnosis.missing)}: they are left out"] if diagnosis.missing else []
    result, precision = diagnosis.terms, diagnosis.precision
    rounding = "rounding" if precision is None else f"rounding ({precision.name})"
    if not diagnosis.wrong:
        if diagnosis.verdict == "none" and precision is None:
            lines.append("no fault: nothing differs by more than is accepted")
        elif precision is not None:
            partly = diagnosis.missing or diagnosis.failed
            right = "the numbers that it answers differ by no" if partly else "no fault: nothing differs by"
            lines.append(f"{right} more than {rounding} at the states of the diagnosis")
        else:
            lines.append("no diagnosis: there is no answer in which causes are looked for")
    elif diagnosis.by_terms and result is not None:
        lines += [f"{line}; and of what it leaves of the error:" for line in _cause_lines(diagnosis.causes, "")[:1]]
        lines += _term_lines(result, diagnosis.not_looked_at, rounding)
        lines += [f"the error of {want} is not a few terms: nothing of it is named" for want in result.besides]
    elif diagnosis.verdict == "named":
        lines += _cause_lines(
            diagnosis.causes, f"explains the error to {rounding}", precision.name if precision else "double"
        )
    elif result is not None and result.doubtful:
        lines.append("a few wrong terms explain it, but these states do not tell which:")
        lines += [f"  {x.want}, {x.component}: {x.term} or, as well, {_some(x.twins)}" for x in result.doubtful]
        lines.append("nothing is named: more kinds of motion are needed, in one log, independent of one another")
    else:
        if diagnosis.hindrance:
            lines.append(f"wrong terms are not looked for: {diagnosis.hindrance}")
        if diagnosis.verdict == "approximate":
            lines += [f"approximately, {_remainder_words(diagnosis.unexplained)}:", *_cause_lines(diagnosis.causes, "")]
        else:
            lines.append("no single cause explains it: no wrong reading, and no one or two numbers of the stand file")
        if result is not None and result.wants:
            lines.append(f"a few wrong terms in {_join(result.wants)} do not explain it either")
    failed = "; ".join(diagnosis.failed)
    return [*lines, f"not compared there, but FAILED above: {failed}"] if failed else lines


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """The diagnosis for `--json`."""
    precision, causes = diagnosis.precision, list[dict[str, Any]]()
    if diagnosis.by_terms and diagnosis.terms is not None:
        causes = [{"fault": cause.name} for cause in diagnosis.causes]
        causes += [{key: getattr(term, key) for key in TERM_KEYS} for term in diagnosis.terms.terms]
    elif diagnosis.verdict in ("named", "approximate"):
        share = (1.0 - diagnosis.unexplained) / max(len(diagnosis.causes), 1)
        causes = [_cause(cause, share) for cause in diagnosis.causes]
    return {
        "verdict": diagnosis.verdict,
        "unexplained": diagnosis.unexplained,
        "precision": None if precision is None else {"name": precision.name, "accepted": precision.accepted},
        "found": causes,
        "missing": list(diagnosis.missing),
        "wrong": list(diagnosis.wrong),
        "words": sentences(diagnosis),
    }


def _cause(cause: Cause, share: float) -> dict[str, Any]:
    more = {key: list(names) for key in ("like", "only_in") if (names := getattr(cause, key))}
    if cause.number is None:
        return {"fault": cause.name, "share": share, **more}
    value, expected, unit = cause.number
    return {"number": cause.name, "value": value, "expected": expected, "unit": unit, "share": share, **more}


def _cause_lines(causes: Sequence[Cause], explains: str, precision: str = "double") -> list[str]:
    """A line for each cause, and what has the same effect."""
    lines = []
    for cause in causes:
        if cause.number is None:
            lines.append(f"reading: {cause.name}" + (f"; it {explains}" if explains else ""))
        else:
            value, expected, unit = cause.number
            more = "with the other " if len(causes) > 1 else ""
            words = f" {more}{explains}" if explains else ""
            lines.append(f"{cause.name}: {f'{value:.15g} {unit}'.rstrip()}{words}; the file has {expected:.15g}")
    if causes and causes[0].only_in:
        lines.append(f"  only in {_join(causes[0].only_in)}: what else it would spoil is right")
    if causes and causes[0].like:
        alike = (
            "of the same effect on this stand" if precision == "double" else f"not told apart by answers in {precision}"
        )
        lines.append(f"  or, {alike}: {_some(causes[0].like)}")
    return lines


def _join(names: Sequence[str]) -> str:
    """`a, b and c`."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _some(terms: Sequence[str]) -> str:
    more = len(terms) - MOST_TWINS
    return ", ".join(terms[:MOST_TWINS]) + (f" or {more} more" if more > 0 else "")


def _remainder_words(unexplained: float) -> str:
    return f"{f'{unexplained:.1%}' if unexplained >= 1e-3 else f'{unexplained:.0e}'} of the error is left"


def _term_lines(result: TermSearchResult, unknown: Sequence[str], rounding: str) -> list[str]:
    """A line for each wrong term, what their names stand for, and whether they are all of the error."""
    terms = result.terms
    lines = ["wrong term found:" if len(terms) == 1 else f"{len(terms)} wrong terms found:"]
    if result.unexplained:
        lines[0] = f"approximately, {lines[0]}"
    for term in terms:
        part = f"{term.share:.0%}" if term.share >= 0.01 else "less than 1 %"
        lines.append(f"  {term.want}, {term.component}: {_term_words(term)}; {part} of the error")
    if not all(term.of_body for term in terms):
        side = f"the right-hand side of K V* = ..., of force and moment about {result.about} in E1"
        lines.append(f"  factors are those on {side}; letters of SNAME")
    if any(term.of_body for term in terms):
        lines.append(f"  {TERMS_OF_BODIES}")
    if result.freedoms:
        lines.append(f"  {result.freedoms}")
    them, they_explain = ("it", "it explains") if len(terms) == 1 else ("them", "they explain")
    if not unknown and not result.besides:
        left = (
            _remainder_words(result.unexplained)
            if result.unexplained
            else f"nothing is left of the error beyond {rounding}"
        )
        return [*lines, f"without {them} {left}"]
    lines.append(f"without {them} the equations of {_join(list(dict.fromkeys(x.want for x in terms)))} are right")
    return [*lines, f"not known: whether {they_explain} all of {'; '.join(unknown)}"] if unknown else lines


def _term_words(term: WrongTerm) -> str:
    name, factor, expected = "a constant" if term.term == CONSTANT else term.term, term.factor, term.expected
    path = f": {term.coefficient}" if term.coefficient not in ("", name) else ""
    if expected is None:
        return f"{name} has a factor that is wrong by {factor:.6g}"
    if expected == 0.0:
        return f"{name} has the factor {factor:.6g}, and should not be there"
    if factor == 0.0:
        return f"{name} is missing, expected with the factor {expected:.6g}{path}"
    sign = "wrong sign: factor" if abs(factor + expected) <= 1e-6 * abs(expected) else "factor"
    return f"{name} has the {sign} {factor:.6g}, expected {expected:.6g}{path}"


# -- of what a report has judged ---------------------------------------------------------------------------------------

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
            return replace(diagnosed, verdict="unnamed", unexplained=1.0)
        return diagnosed
    if not set(offered) & set(WANTS):
        return diagnosed
    if states is not None:
        states = spread_rows(states, ROWS_OF_TERMS * count_products(stand))

    most = len(diagnosed.causes) - 1 if diagnosed.verdict == "named" else MOST  # more would not take their place

    def terms_beside(right: Stand) -> TermSearchResult:
        """Wrong terms beside what is right."""
        of = right, seed, offered, states, precision, program, diagnosed.wrong
        if states is None and right.flywheels:  # few questions suffice where whole bodies have it
            search = TermSearch(*of, of_bodies=True, most=most)
            with suppress(CheckError):
                return search.find(judged.answers(search.requests))
        search = TermSearch(*of, most=most)
        return search.find(judged.answers(search.requests))

    try:
        with_terms = diagnosed.with_terms(terms_beside(stand))
        nearest = next(
            (x for x in readings_of(stand) if [x.words] == [cause.name for cause in with_terms.causes]), None
        )
        read = None if nearest is None else nearest.of_bodies(stand)
        if with_terms.verdict == "named" or read is None:
            return with_terms
        both = replace(diagnosed, causes=()).with_terms(terms_beside(read))
        return replace(both, causes=with_terms.causes) if both.verdict == "named" else with_terms
    except CheckError as error:
        if not (diagnosed.missing or diagnosed.causes):
            raise
        return diagnosed if diagnosed.verdict == "named" else replace(diagnosed, hindrance=str(error))


def _failure_words(report: Report, compared: Sequence[str] = ()) -> tuple[str, ...]:
    """What failed in the table, why and how far; without what a diagnosis has `compared`, as want: quantity."""

    def reason(row: Check) -> str:
        far = f"{row.share:.2g} times its limit" if 1.0 < row.share < np.inf else ""
        words = ", ".join(filter(None, (row.words, far)))
        return f" ({words})" if words else ""

    return tuple(
        f"{row.judged} {row.quantity}".strip() + reason(row)
        for row in report.failures
        if not any(f"{quantity}.".startswith(f"{row.judged}: {row.quantity}.") for quantity in compared)
    )
