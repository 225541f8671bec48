"""A diagnosis in plain words, and as data for programs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
from mahovik.proof.diagnose.search import TermSearchResult, WrongTerm

CONSTANT = "1"
"""The product without factors, as it is written."""

MOST_TWINS = 4
"""Number of products that are printed beside one that looks like them."""

TERM_KEYS = ("want", "component", "term", "factor", "expected", "coefficient", "share")


def sentences(diagnosis: Diagnosis) -> list[str]:
    """Lines with the cause of the error, or what comes nearest; before, numbers that the program leaves out."""
    lines = [f"numbers are missing in {_join(diagnosis.missing)}: they are left out"] if diagnosis.missing else []
    result, precision = diagnosis.terms, diagnosis.precision
    rounding = "" if precision is None else f"rounding ({precision.name})"
    if not diagnosis.wrong:
        if diagnosis.verdict == "none" and precision is None:
            lines.append("no fault: nothing differs by more than is accepted")
        elif precision is not None:
            right = "the numbers that it answers differ by no" if diagnosis.missing else "no fault: nothing differs by"
            lines.append(f"{right} more than {rounding} at the states of the diagnosis")
        else:
            lines.append("no diagnosis: the program answered nothing that can be compared")
    elif diagnosis.by_terms and result is not None:
        lines += _term_lines(result, diagnosis.not_looked_at)
        lines += [f"the error of {want} is not a few terms: nothing of it is named" for want in result.besides]
    elif diagnosis.verdict == "named":
        lines += _cause_lines(diagnosis.causes, f"explains the error to {rounding}")
    elif result is not None and result.doubtful:
        lines.append("a few wrong terms explain it, but these states do not tell which:")
        lines += [f"  {x.want}, {x.component}: {x.term} or, as well, {_some(x.twins)}" for x in result.doubtful]
        lines.append("nothing is named: more kinds of motion are needed, in one log, independent of one another")
    else:
        left = f"{max(diagnosis.unexplained, 0.001):.1%} of the error is left"
        if diagnosis.verdict == "approximate":
            lines += [f"approximately, {left}:", *_cause_lines(diagnosis.causes, "")]
        else:
            near = " and ".join(_cause_lines([cause], "")[0] for cause in diagnosis.causes)
            lines.append("no wrong reading and no one or two numbers of the stand file explain it"
                         + (f"; nearest: {near}, {left}" if near else ""))  # fmt: skip
        if result is not None:
            lines.append(f"nor do a few wrong terms in {_join(result.wants)}")
        if diagnosis.hindrance:
            lines.append(f"wrong terms are not looked for: {diagnosis.hindrance}")
    failed = "; ".join(diagnosis.failed)
    return [*lines, f"not compared there, but FAILED above: {failed}"] if failed else lines


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """The diagnosis for `--json`."""
    precision, causes = diagnosis.precision, list[dict[str, Any]]()
    if diagnosis.by_terms and diagnosis.terms is not None:
        causes = [{key: getattr(term, key) for key in TERM_KEYS} for term in diagnosis.terms.terms]
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


def _cause_lines(causes: Sequence[Cause], explains: str) -> list[str]:
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
        lines.append(f"  of the same effect on this stand: {_some(causes[0].like)}")
    return lines


def _join(names: Sequence[str]) -> str:
    """`a, b and c`."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _some(terms: Sequence[str]) -> str:
    more = len(terms) - MOST_TWINS
    return ", ".join(terms[:MOST_TWINS]) + (f" or {more} more" if more > 0 else "")


def _term_lines(result: TermSearchResult, unknown: Sequence[str]) -> list[str]:
    """A line for each wrong term, what their names stand for, and whether they are all of the error."""
    terms = result.terms
    lines = ["wrong term found:" if len(terms) == 1 else f"{len(terms)} wrong terms found:"]
    for term in terms:
        part = f"{term.share:.0%}" if term.share >= 0.01 else "less than 1 %"
        lines.append(f"  {term.want}, {term.component}: {_term_words(term)}; {part} of the error")
    if not all(term.of_body for term in terms):
        side = f"the right-hand side of K V* = ..., of force and moment about {result.about} in E1"
        lines.append(f"  factors are those on {side}; letters of SNAME")
    if result.freedoms:
        lines.append(f"  {result.freedoms}")
    them, they_explain = ("it", "it explains") if len(terms) == 1 else ("them", "they explain")
    if not unknown and not result.besides:
        return [*lines, f"without {them} nothing is left of the error beyond rounding"]
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
