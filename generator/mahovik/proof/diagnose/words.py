"""A diagnosis in plain words, and as data for programs."""

from __future__ import annotations

import math
from typing import Any

from mahovik.proof.diagnose.diagnosis import Cause, Diagnosis
from mahovik.proof.diagnose.faults import DICTIONARY
from mahovik.proof.diagnose.predict import Part
from mahovik.proof.diagnose.search import EXACT

SURE = 0.5
"""Least confidence of a fault that is not called a guess."""

SUREST = 0.999
"""Largest confidence that is reported: a fault that is not in the dictionary may look like one that is."""


def name_of(part: Part) -> str:
    """Name of the fault, and the flywheel that has it alone."""
    return part.fault.name + (f" ({part.wheel} alone)" if part.wheel else "")


def short_text(cause: Cause) -> str:
    """A cause in a few words."""
    words = " and ".join(name_of(part) for part in cause.parts)
    return words if cause.share == 1.0 else f"{_share(cause.share)} of: {words}"


def sentences(diagnosis: Diagnosis) -> list[str]:
    """Lines with the fault of the program, the confidence, and the terms to look at."""
    match diagnosis.outcome:
        case "equal":
            return ["no fault: nothing differs beyond rounding at the states of the diagnosis"]
        case "rounding":
            return ["no fault found: the differences are not larger than rounding in float, and look like no fault"]
        case "nothing":
            return ["no diagnosis: the program answered nothing that can be compared"]
        case "unknown":
            nearest = "".join(
                f"; nearest: {short_text(each)} ({_explained_part(each)})" for each in diagnosis.others[:1]
            )
            return [f"no fault of the {len(DICTIONARY)} in the dictionary explains it{nearest}", *_unseen(diagnosis)]
    best, *twins = diagnosis.causes
    what = "fault" if len(best.parts) == 1 else "two faults at once"
    lines = [what + (" found:" if diagnosis.confidence >= SURE else ", perhaps:")]
    for part in best.parts:
        lines += _part_lines(part)
    if best.share != 1.0:
        lines.append(f"  not as a whole: the error is {_share(best.share)} of what that would give")
    if best.only_in:
        lines.append(f"  only in {', '.join(best.only_in)}: what else it would spoil is right")
    lines += [f"  or, with the same effect on this stand: {_sentence(each)}" for each in twins]
    lines.append(f"confidence {min(diagnosis.confidence, SUREST):.1%}: {_reason(best, diagnosis)}")
    return lines + _unseen(diagnosis)


def as_object(diagnosis: Diagnosis) -> dict[str, Any]:
    """The diagnosis for `--json`."""
    return {
        "outcome": diagnosis.outcome,
        "causes": [_cause(each) for each in diagnosis.causes],
        "confidence": diagnosis.confidence,
        "others": [_cause(each) for each in diagnosis.others],
        "wrong": list(diagnosis.wrong),
        "unseen": list(diagnosis.unseen),
        "dictionary": len(DICTIONARY),
        "words": sentences(diagnosis),
    }


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
    return {"faults": faults, "share": cause.share, "unexplained": cause.score, "only_in": list(cause.only_in)}


def _part_lines(part: Part) -> list[str]:
    where = f"in {part.wheel} alone: " if part.wheel else ""
    return [f"  {where}{part.fault.words}", f"  equation {part.fault.equation}; look at: {part.fault.look}"]


def _sentence(cause: Cause) -> str:
    words = "; and ".join((f"in {p.wheel} alone: " if p.wheel else "") + p.fault.words for p in cause.parts)
    return words if cause.share == 1.0 else f"{_share(cause.share)} of: {words}"


def _explained_part(cause: Cause) -> str:
    """Part of the error that a cause explains, rounded down: 90 % would be named."""
    return f"{math.floor(100 * max(1.0 - cause.score, 0.0))} %"


def _share(share: float) -> str:
    return f"{share:.3g} times" if abs(share) > 2 or share < 0 else f"{share:.0%}"


def _reason(best: Cause, diagnosis: Diagnosis) -> str:
    left = "it explains the error to rounding" if best.score <= EXACT else f"it leaves {best.score:.0%} of the error"
    for each in diagnosis.others[:1]:
        return f"{left}; the next best, {short_text(each)}, leaves {each.score:.0%}"
    return left


def _unseen(diagnosis: Diagnosis) -> list[str]:
    if not diagnosis.unseen:
        return []
    return [f"{len(diagnosis.unseen)} faults of the dictionary have no effect here, so that they cannot be seen"]
