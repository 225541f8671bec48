"""A diagnosis in plain words, and as data for programs."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

from mahovik.core.stand.model import WRENCH_LETTERS
from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
from mahovik.proof.diagnose.factors import join
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import Part
from mahovik.proof.diagnose.terms.coefficients import Multiple
from mahovik.proof.diagnose.terms.search import TermSearchResult, WrongTerm

SURE = 0.5
"""Least confidence of a fault that is not called a guess."""

SUREST = 0.999
"""Largest confidence that is reported: a fault that is not in the dictionary may look like one that is."""

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


def name_of(part: Part) -> str:
    """Name of the fault, and the flywheel that has it alone."""
    return part.fault.name + (f" ({part.wheel} alone)" if part.wheel else "")


def short_text(cause: Cause) -> str:
    """A cause in a few words."""
    return " and ".join(name_of(part) for part in cause.parts)


def sentences(diagnosis: Diagnosis) -> list[str]:
    """Lines with the fault of the program, the confidence, and the terms to look at; before, numbers it leaves out."""
    gaps = [gap.sentence() for gap in diagnosis.gaps]
    if diagnosis.outcome in ("equal", "rounding", "nothing") and (gaps or diagnosis.failed):
        return gaps + _no_difference(diagnosis)
    return [*gaps, *_sentences(diagnosis), *_not_compared(diagnosis)]


def _no_difference(diagnosis: Diagnosis) -> list[str]:
    """A line where nothing differs, though the table says FAILED: what was compared, and what was not."""
    if diagnosis.outcome == "nothing":
        return [] if diagnosis.gaps else ["no diagnosis: the program answered nothing that can be compared"]
    kind = "rounding in float" if diagnosis.outcome == "rounding" else "rounding"
    if diagnosis.gaps:
        return [f"the numbers that it does answer differ by no more than {kind}"]
    (more,) = _not_compared(diagnosis)
    return [f"nothing is named: at the states of the diagnosis nothing differs by more than {kind}; {more}"]


def _not_compared(diagnosis: Diagnosis) -> list[str]:
    """A line on what the diagnosis did not compare."""
    return [f"not compared there, but FAILED above: {'; '.join(diagnosis.failed)}"] if diagnosis.failed else []


def _sentences(diagnosis: Diagnosis) -> list[str]:
    match diagnosis.outcome:
        case "equal":
            return ["no fault: nothing differs beyond rounding at the states of the diagnosis"]
        case "rounding":
            return ["no fault found: its answers are numbers of float, and differ by no more than rounding in float"]
        case "nothing":
            return ["no diagnosis: the program answered nothing that can be compared"]
        case "terms":
            assert diagnosis.terms is not None
            besides = diagnosis.terms.besides
            more = [f"the error of {want} is not a few terms: nothing of it is named" for want in besides]
            return _term_lines(diagnosis.terms, diagnosis.wrong) + more
        case "factors":
            them = "this" if len(diagnosis.factors) == 1 else "these"
            lines = [each.sentence() for each in diagnosis.factors]
            if diagnosis.gaps or diagnosis.failed:
                return lines
            return [*lines, f"with {them} put right nothing is left of the error beyond rounding"]
        case "unknown" if diagnosis.terms is not None and diagnosis.terms.doubtful:
            return _doubtful_lines(diagnosis.terms.doubtful)
        case "unknown":
            nearest = "".join(
                f"; nearest: {short_text(each)} ({_explained_part(each)})" for each in diagnosis.others[:1]
            )
            few = (
                []
                if diagnosis.terms is None
                else [f"nor do a few wrong terms in {' and '.join(diagnosis.terms.wants)}"]
            )
            return [
                f"no fault of the {len(DICTIONARY)} in the dictionary explains it{nearest}",
                *few,
                *([f"wrong terms are not looked for: {diagnosis.hindrance}"] if diagnosis.hindrance else []),
                *_unseen(diagnosis),
            ]
    best, *twins = diagnosis.causes
    what = "fault" if len(best.parts) == 1 else "two faults at once"
    lines = [what + (" found:" if diagnosis.confidence >= SURE else ", perhaps:")]
    for part in best.parts:
        lines += _part_lines(part)
    if best.only_in:
        lines.append(f"  only in {', '.join(best.only_in)}: what else it would spoil is right")
    lines += [f"  or, with the same effect on this stand: {_sentence(each)}" for each in twins]
    lines.append(f"confidence {min(diagnosis.confidence, SUREST):.1%}: {_reason(diagnosis)}")
    return lines + _unseen(diagnosis)


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """The diagnosis for `--json`."""
    return {
        "outcome": diagnosis.outcome,
        "verdict": diagnosis.verdict,
        "unexplained": diagnosis.unexplained,
        "found": _parts_of_error(diagnosis),
        "causes": [_cause(each) for each in diagnosis.causes],
        "confidence": diagnosis.confidence if diagnosis.outcome == "named" else None,
        "others": [_cause(each) for each in diagnosis.others],
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
        "unseen": list(diagnosis.unseen),
        "dictionary": len(DICTIONARY),
        "words": sentences(diagnosis),
    }


def _parts_of_error(diagnosis: Diagnosis) -> list[dict[str, Any]]:
    """Parts of the error by name: factors, wrong terms, or faults of the dictionary; none where it has no name."""
    if diagnosis.outcome == "factors":
        return [
            {"quantities": list(each.quantities), "wants": list(each.wants), "factor": each.factor}
            for each in diagnosis.factors
        ]
    if diagnosis.wrong_terms:
        return [
            {
                "want": each.want,
                "component": each.component,
                "term": each.term,
                "factor": each.multiple.factor,
                "expected": each.multiple.expected,
                "coefficient": each.multiple.coefficient,
                "share": each.share,
                **({"like": list(each.twins)} if each.twins else {}),
            }
            for each in diagnosis.wrong_terms
        ]
    return [{"fault": name_of(part), "share": 1.0 - each.score} for each in diagnosis.causes[:1] for part in each.parts]


def _term_lines(result: TermSearchResult, wrong: Sequence[str]) -> list[str]:
    """A line for each wrong term, what their names stand for, and whether they are all of the `wrong` quantities."""
    found = result.terms
    count = len(found)
    lines = ["wrong term found:" if count == 1 else f"{count} wrong terms found:"]
    for each in found:
        place = f"{each.want}, {each.component}"
        words = _constant_words(each) if each.term == CONSTANT else _term_words(each.multiple, each.term)
        lines.append(f"  {place}: {words}; {_part(each.share)} of the error")
        if each.twins:
            lines.append(f"    these states do not tell it from {_some(each.twins)}, which the equations do not have")
    sides = dict.fromkeys(WRENCHES, WRENCH_SIDE.format(result.about))
    sides |= {"momentum": f"factors are those in Z about {result.about} in E1"}
    for side in dict.fromkeys(sides[each.want] for each in found if each.want in sides):
        lines.append(f"  {side}; letters of SNAME")
    if any(each.want in WRENCHES and ACCELERATION.search(each.term) for each in found):
        lines.append("  accelerations stand on the left; the signs of their factors are those on the right, -K")
    if result.freedoms:
        lines.append(f"  {result.freedoms}")
    them, they_explain = ("it", "it explains") if count == 1 else ("them", "they explain")
    unknown = [each for each in wrong if each not in result.looked_at]
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


def _term_words(multiple: Multiple, term: str) -> str:
    unit = f" {multiple.coefficient}" if multiple.coefficient else ""
    if multiple.expected is None:
        return f"{term} has a factor that is wrong by {multiple.factor:.6g}"
    if multiple.expected == 0.0:
        return f"{term} has the factor {multiple.factor:.6g}{unit}, and should not be there"
    if multiple.factor == 0.0:
        return f"{term} is missing, expected with the factor {multiple.expected:.6g}{unit}"
    if abs(multiple.factor + multiple.expected) <= 1e-6 * abs(multiple.expected):
        return f"{term} has the wrong sign: factor {multiple.factor:.6g}{unit}, expected {multiple.expected:.6g}{unit}"
    return f"{term} has the factor {multiple.factor:.6g}{unit}, expected {multiple.expected:.6g}{unit}"


def _constant_words(term: WrongTerm) -> str:
    """A wrong constant in words; that of a reaction has its own sign, which is not that on the right-hand side."""
    multiple, of_reaction = term.multiple, term.want == "reaction"
    units = ("kg m/s", "kg m2/s") if term.want == "momentum" else ("N", "N m")
    forces = term.component in WRENCH_LETTERS[:3] and term.want in (*WRENCHES, "momentum")
    moments = term.component in WRENCH_LETTERS[3:] or term.want == "torque"
    unit = units[0] if forces else units[1] if moments else "in SI"
    sign = -1.0 if of_reaction else 1.0
    where = " of the reaction" if of_reaction else ""
    if multiple.expected is None or multiple.expected == 0.0:
        tail = f" ({term.error:.6g} on the right-hand side)" if of_reaction else ""
        error = " is too much" if multiple.expected is None else ", which should not be there"
        return f"a constant{where} of {sign * term.error:.6g} {unit}{tail}{error}"
    right = term.error / (multiple.factor - multiple.expected) * multiple.expected
    given = right + term.error
    return f"the constant{where} is {sign * given:.6g} {unit}, expected {sign * right:.6g} {unit}"


def _part(share: float) -> str:
    return f"{share:.0%}" if share >= 0.01 else "less than 1 %"


def _cause(cause: Cause) -> dict[str, Any]:
    faults = [
        {
            "name": part.fault.name,
            "flywheel": part.wheel,
            "equation": part.fault.equation,
            "words": part.fault.words,
            "look": part.fault.look,
        }
        for part in cause.parts
    ]
    return {"faults": faults, "unexplained": cause.score, "only_in": list(cause.only_in)}


def _part_lines(part: Part) -> list[str]:
    where = f"in {part.wheel} alone: " if part.wheel else ""
    return [f"  {where}{part.fault.words}", f"  equation {part.fault.equation}; look at: {part.fault.look}"]


def _sentence(cause: Cause) -> str:
    return "; and ".join((f"in {p.wheel} alone: " if p.wheel else "") + p.fault.words for p in cause.parts)


def _explained_part(cause: Cause) -> str:
    """Part of the error that a cause explains, rounded down: all of it would be named."""
    return f"{math.floor(100 * max(1.0 - cause.score, 0.0))} %"


def _reason(diagnosis: Diagnosis) -> str:
    left = "it explains the error to rounding"
    for each in diagnosis.others[:1]:
        return f"{left}; the next best, {short_text(each)}, leaves {each.score:.0%}"
    return left


def _unseen(diagnosis: Diagnosis) -> list[str]:
    if not diagnosis.unseen:
        return []
    return [f"{len(diagnosis.unseen)} faults of the dictionary have no effect here, so that they cannot be seen"]
