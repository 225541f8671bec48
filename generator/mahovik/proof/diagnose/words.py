"""A diagnosis in plain words, and as data for programs."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from mahovik.core.stand.model import WRENCH_LETTERS
from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
from mahovik.proof.diagnose.terms.search import TermSearchResult, WrongTerm

WRENCHES = ("forward", "coupled", "reaction")
"""Wants whose wrong terms are those of a wrench."""

ACCELERATION = re.compile(r"_dot\b|\.acceleration\b")
"""Factor of a product that is an acceleration."""

CONSTANT = "1"
"""The product without factors, as it is written."""

MOST_TWINS = 4
"""Number of products that are printed beside one that looks like them."""


def sentences(diagnosis: Diagnosis) -> list[str]:
    """Lines with the cause of the error, or what comes nearest; before, numbers that the program leaves out."""
    lines = [gap.sentence() for gap in diagnosis.gaps]
    result, precision = diagnosis.terms, diagnosis.precision
    rounding = "" if precision is None else f"rounding ({precision.name})"
    if not diagnosis.wrong:
        if precision is not None:
            right = "the numbers that it does answer differ by no more than {}"
            none = "no fault: nothing differs by more than {} at the states of the diagnosis"
            lines.append((right if diagnosis.gaps else none).format(rounding))
        elif diagnosis.verdict == "none":
            lines.append("no fault: nothing differs by more than is accepted")
        elif not diagnosis.gaps:
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
            near = f"; nearest: {' and '.join(map(_short, diagnosis.causes))}, {left}" if diagnosis.causes else ""
            lines.append(f"no wrong reading and no one or two numbers of the stand file explain it{near}")
        if result is not None:
            lines.append(f"nor do a few wrong terms in {_join(result.wants)}")
        if diagnosis.hindrance:
            lines.append(f"wrong terms are not looked for: {diagnosis.hindrance}")
    failed = "; ".join(diagnosis.failed)
    return [*lines, f"not compared there, but FAILED above: {failed}"] if failed else lines


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """The diagnosis for `--json`."""
    precision, causes = diagnosis.precision, list[dict[str, Any]]()
    if diagnosis.verdict in ("named", "approximate"):
        if diagnosis.by_terms and diagnosis.terms is not None:
            keys = ("want", "component", "term", "factor", "expected", "coefficient", "share")
            causes = [{key: getattr(term, key) for key in keys} for term in diagnosis.terms.terms]
        else:
            share = (1.0 - diagnosis.unexplained) / max(len(diagnosis.causes), 1)
            causes = [_cause(cause, share) for cause in diagnosis.causes]
    return {
        "verdict": diagnosis.verdict,
        "unexplained": diagnosis.unexplained,
        "precision": None if precision is None else {"name": precision.name, "accepted": precision.accepted},
        "found": causes,
        "gaps": [
            {
                "want": gap.want,
                "missing": gap.missing,
                "states": gap.states,
                "components": {name: list(names) for name, names in gap.components.items()},
                **({"shapes": {name: [*map(list, pair)] for name, pair in gap.shapes.items()}} if gap.shapes else {}),
            }
            for gap in diagnosis.gaps
        ],
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
            words = f" {more}{explains};" if explains else ""
            lines.append(f"{cause.name}: {f'{value:.15g} {unit}'.rstrip()}{words} the file has {expected:.15g}")
    if causes and causes[0].only_in:
        lines.append(f"  only in {_join(causes[0].only_in)}: what else it would spoil is right")
    if causes and causes[0].like:
        lines.append(f"  of the same effect on this stand: {_some(causes[0].like)}")
    return lines


def _short(cause: Cause) -> str:
    return cause.name if cause.number is None else f"{cause.name} = {cause.number[0]:.6g} {cause.number[2]}".rstrip()


def _join(names: Sequence[str]) -> str:
    """`a, b and c`."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _some(terms: Sequence[str]) -> str:
    more = len(terms) - MOST_TWINS
    return ", ".join(terms[:MOST_TWINS]) + (f" or {more} more" if more > 0 else "")


def _term_lines(result: TermSearchResult, unknown: Sequence[str]) -> list[str]:
    """A line for each wrong term, what their names stand for, and whether they are all of the error."""
    terms, products = result.terms, [term for term in result.terms if not term.of_body]
    lines = ["wrong term found:" if len(terms) == 1 else f"{len(terms)} wrong terms found:"]
    for term in terms:
        words = _constant_words(term) if term.term == CONSTANT else _term_words(term)
        part = f"{term.share:.0%}" if term.share >= 0.01 else "less than 1 %"
        lines.append(f"  {term.want}, {term.component}: {words}; {part} of the error")
    if any(term.want in WRENCHES for term in products):
        side = f"the right-hand side of K V* = ..., of force and moment about {result.about} in E1"
        lines.append(f"  factors are those on {side}; letters of SNAME")
    if any(term.want == "momentum" for term in products):
        lines.append(f"  factors are those in Z about {result.about} in E1; letters of SNAME")
    if len(products) < len(terms):
        lines.append(
            "  e: spin axis; O, r: from O1 to the origin of the body, and from there to its mass centre; on the left"
        )
    if any(term.want in WRENCHES and ACCELERATION.search(term.term) for term in products):
        lines.append("  accelerations stand on the left; the signs of their factors are those on the right, -K")
    if result.freedoms:
        lines.append(f"  {result.freedoms}")
    them, they_explain = ("it", "it explains") if len(terms) == 1 else ("them", "they explain")
    if not unknown and not result.besides:
        return [*lines, f"without {them} nothing is left of the error beyond rounding"]
    lines.append(f"without {them} the equations of {_join(list(dict.fromkeys(x.want for x in terms)))} are right")
    return [*lines, f"not known: whether {they_explain} all of {'; '.join(unknown)}"] if unknown else lines


def _term_words(term: WrongTerm) -> str:
    name, factor, expected = term.term, term.factor, term.expected
    path = f": {term.coefficient}" if term.coefficient else ""
    if expected is None:
        return f"{name} has a factor that is wrong by {factor:.6g}"
    if expected == 0.0:
        return f"{name} has the factor {factor:.6g}, and should not be there"
    if factor == 0.0:
        return f"{name} is missing, expected with the factor {expected:.6g}{path}"
    sign = "wrong sign: factor" if abs(factor + expected) <= 1e-6 * abs(expected) else "factor"
    return f"{name} has the {sign} {factor:.6g}, expected {expected:.6g}{path}"


def _constant_words(term: WrongTerm) -> str:
    """A wrong constant in words; that of a reaction has its own sign, which is not that on the right-hand side."""
    of_reaction, force = term.want == "reaction", term.component in WRENCH_LETTERS[:3]
    unit = {True: "kg m/s", False: "kg m2/s"} if term.want == "momentum" else {True: "N", False: "N m"}
    known = term.component in WRENCH_LETTERS or term.want == "torque"
    in_unit = unit[force] if known else "in SI"
    sign, of = (-1.0, " of the reaction") if of_reaction else (1.0, "")
    if not term.expected:
        side = f" ({term.factor:.6g} on the right-hand side)" if of_reaction else ""
        error = " is too much" if term.expected is None else ", which should not be there"
        return f"a constant{of} of {sign * term.factor:.6g} {in_unit}{side}{error}"
    return f"the constant{of} is {sign * term.factor:.6g} {in_unit}, expected {sign * term.expected:.6g} {in_unit}"
