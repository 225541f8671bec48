"""A diagnosis in plain words, and as data for programs."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from mahovik.core.stand.model import WRENCH_LETTERS
from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
from mahovik.proof.diagnose.terms.search import TermSearchResult, WrongTerm

WRENCH_SIDE = "factors are those on the right-hand side of K V* = ..., of force and moment about {} in E1"
"""The equations that the factors of wrong terms of a wrench belong to, in words."""

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
    found = diagnosis.terms
    if not diagnosis.wrong:
        lines += _no_difference(diagnosis)
    elif diagnosis.by_terms and found is not None:
        lines += _term_lines(found, diagnosis.not_looked_at)
        lines += [f"the error of {want} is not a few terms: nothing of it is named" for want in found.besides]
    elif diagnosis.verdict == "named":
        lines += _cause_lines(diagnosis.causes, _to_rounding(diagnosis))
    elif found is not None and found.doubtful:
        lines += _doubtful_lines(found.doubtful)
    else:
        left = f"{max(diagnosis.unexplained, 0.001):.1%} of the error is left"
        if diagnosis.verdict == "approximate":
            lines += [f"approximately, {left}:", *_cause_lines(diagnosis.causes, "")]
        else:
            near = f"; nearest: {' and '.join(map(_short, diagnosis.causes))}, {left}" if diagnosis.causes else ""
            lines.append(f"no wrong reading and no one or two numbers of the stand file explain it{near}")
        if found is not None:
            lines.append(f"nor do a few wrong terms in {join(found.wants)}")
        if diagnosis.hindrance:
            lines.append(f"wrong terms are not looked for: {diagnosis.hindrance}")
    return lines + (
        [f"not compared there, but FAILED above: {'; '.join(diagnosis.failed)}"] if diagnosis.failed else []
    )


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """The diagnosis for `--json`."""
    precision = diagnosis.precision
    return {
        "verdict": diagnosis.verdict,
        "unexplained": diagnosis.unexplained,
        "precision": None if precision is None else {"name": precision.name, "accepted": precision.accepted},
        "found": _named_causes(diagnosis),
        "gaps": [
            {
                "want": gap.want,
                "missing": gap.missing,
                "states": gap.states,
                "components": {name: list(each) for name, each in gap.components.items()},
                **({"shapes": {name: [*map(list, pair)] for name, pair in gap.shapes.items()}} if gap.shapes else {}),
            }
            for gap in diagnosis.gaps
        ],
        "wrong": list(diagnosis.wrong),
        "words": sentences(diagnosis),
    }


def _named_causes(diagnosis: Diagnosis) -> list[dict[str, Any]]:
    """Causes of the error by name; none where it has no name."""
    if diagnosis.verdict not in ("named", "approximate"):
        return []
    if diagnosis.by_terms and diagnosis.terms is not None:
        return [
            {
                "want": each.want,
                "component": each.component,
                "term": each.term,
                "factor": each.factor,
                "expected": each.expected,
                "coefficient": each.coefficient,
                "share": each.share,
                **({"like": list(each.twins)} if each.twins else {}),
            }
            for each in diagnosis.terms.terms
        ]
    share = (1.0 - diagnosis.unexplained) / max(len(diagnosis.causes), 1)
    return [_cause(each, share) for each in diagnosis.causes]


def _cause(cause: Cause, share: float) -> dict[str, Any]:
    more = ({"like": list(cause.like)} if cause.like else {}) | (
        {"only_in": list(cause.only_in)} if cause.only_in else {}
    )
    if cause.number is None:
        return {"fault": cause.name, "share": share, **more}
    value, expected, unit = cause.number
    return {"number": cause.name, "value": value, "expected": expected, "unit": unit, "share": share, **more}


def _no_difference(diagnosis: Diagnosis) -> list[str]:
    """A line where nothing differs: to what precision, though the table may say FAILED of what was not compared."""
    if diagnosis.precision is None:
        if diagnosis.verdict == "none":
            return ["no fault: nothing differs by more than is accepted"]
        return [] if diagnosis.gaps else ["no diagnosis: the program answered nothing that can be compared"]
    kind = f"rounding ({diagnosis.precision.name})"
    if diagnosis.gaps:
        return [f"the numbers that it does answer differ by no more than {kind}"]
    return [f"no fault: nothing differs by more than {kind} at the states of the diagnosis"]


def _to_rounding(diagnosis: Diagnosis) -> str:
    assert diagnosis.precision is not None
    return f"explains the error to rounding ({diagnosis.precision.name})"


def _cause_lines(causes: Sequence[Cause], explains: str) -> list[str]:
    """A line for each cause, and what has the same effect."""
    lines = []
    for each in causes:
        if each.number is None:
            lines.append(f"reading: {each.name}" + (f"; it {explains}" if explains else ""))
        else:
            value, expected, unit = each.number
            more = "with the other " if len(causes) > 1 else ""
            words = f" {more}{explains};" if explains else ""
            lines.append(f"{each.name}: {f'{value:.15g} {unit}'.rstrip()}{words} the file has {expected:.15g}")
    if causes and causes[0].only_in:
        lines.append(f"  only in {join(causes[0].only_in)}: what else it would spoil is right")
    if causes and causes[0].like:
        lines.append(f"  of the same effect on this stand: {_some(causes[0].like)}")
    return lines


def _short(cause: Cause) -> str:
    return cause.name if cause.number is None else f"{cause.name} = {cause.number[0]:.6g} {cause.number[2]}".rstrip()


def join(names: Sequence[str]) -> str:
    """`a, b and c`."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _term_lines(result: TermSearchResult, unknown: Sequence[str]) -> list[str]:
    """A line for each wrong term, what their names stand for, and whether they are all of the error."""
    found = result.terms
    count = len(found)
    lines = ["wrong term found:" if count == 1 else f"{count} wrong terms found:"]
    for each in found:
        place = f"{each.want}, {each.component}"
        words = _constant_words(each) if each.term == CONSTANT else _term_words(each)
        lines.append(f"  {place}: {words}; {_part(each.share)} of the error")
        if each.twins:
            lines.append(f"    these states do not tell it from {_some(each.twins)}, which the equations do not have")
    sides = dict.fromkeys(WRENCHES, WRENCH_SIDE.format(result.about))
    sides |= {"momentum": f"factors are those in Z about {result.about} in E1"}
    products = [each for each in found if not each.of_body]
    for side in dict.fromkeys(sides[each.want] for each in products if each.want in sides):
        lines.append(f"  {side}; letters of SNAME")
    if len(products) < count:
        lines.append(
            "  e: spin axis; O, r: from O1 to the origin of the body, and from there to its mass centre; on the left"
        )
    if any(each.want in WRENCHES and ACCELERATION.search(each.term) for each in products):
        lines.append("  accelerations stand on the left; the signs of their factors are those on the right, -K")
    if result.freedoms:
        lines.append(f"  {result.freedoms}")
    them, they_explain = ("it", "it explains") if count == 1 else ("them", "they explain")
    if not unknown and not result.besides:
        return [*lines, f"without {them} nothing is left of the error beyond rounding"]
    lines.append(f"without {them} the equations of {join(list(dict.fromkeys(each.want for each in found)))} are right")
    return [*lines, f"not known: whether {they_explain} all of {'; '.join(unknown)}"] if unknown else lines


def _doubtful_lines(found: Sequence[WrongTerm]) -> list[str]:
    """A line for each term that the states do not tell from others."""
    lines = ["a few wrong terms explain it, but these states do not tell which:"]
    for each in found:
        lines.append(f"  {each.want}, {each.component}: {each.term} or, as well, {_some(each.twins)}")
    return [*lines, "nothing is named: more kinds of motion are needed, in one log, independent of one another"]


def _some(terms: Sequence[str]) -> str:
    more = len(terms) - MOST_TWINS
    return ", ".join(terms[:MOST_TWINS]) + (f" or {more} more" if more > 0 else "")


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
    of_reaction, letters = term.want == "reaction", [*WRENCH_LETTERS]
    units = ("kg m/s", "kg m2/s") if term.want == "momentum" else ("N", "N m")
    unit = (
        units[0 if term.component in letters[:3] else 1]
        if term.component in letters or term.want == "torque"
        else "in SI"
    )
    sign, of = (-1.0, " of the reaction") if of_reaction else (1.0, "")
    if not term.expected:
        side = f" ({term.factor:.6g} on the right-hand side)" if of_reaction else ""
        error = " is too much" if term.expected is None else ", which should not be there"
        return f"a constant{of} of {sign * term.factor:.6g} {unit}{side}{error}"
    return f"the constant{of} is {sign * term.factor:.6g} {unit}, expected {sign * term.expected:.6g} {unit}"


def _part(share: float) -> str:
    return f"{share:.0%}" if share >= 0.01 else "less than 1 %"
