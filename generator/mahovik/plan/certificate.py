"""A programme with whose it is, and what the independent verification says of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any

from mahovik.motion.programme import Fourier, Programme, Samples
from mahovik.motion.required import RequiredMotion
from mahovik.plan.array import Array
from mahovik.stand.identity import identities
from mahovik.stand.model import Stand


def programme_of(
    stand: Stand,
    motion: RequiredMotion,
    bias: Array,
    winding: tuple[int, ...],
    course: Fourier | Samples,
    report: Mapping[str, Any],
) -> Programme:
    """The programme of a stand for a motion."""
    whose = identities(stand)
    return Programme(
        stand=stand.name,
        structure=whose.structure,
        physics=whose.physics,
        motion=motion.name,
        flywheels=tuple(s.name for s in stand.flywheels),
        periodic=motion.periodic,
        span=motion.span,
        bias=bias,
        winding=winding,
        course=course,
        report=report,
    )


def certified(stand: Stand, motion: RequiredMotion, programme: Programme) -> Programme:
    """The programme with the findings of the independent verification in its report."""
    from mahovik.verify.programme import verify_programme

    findings = verify_programme(stand, motion, programme)
    named = {each.name: each for each in findings}
    words = {
        "verified": all(each.passed for each in findings),
        "simulation_error": named["simulation"].value if "simulation" in named else None,
        "largest_multiplier": named["Floquet"].value if "Floquet" in named else None,
        "verification": [asdict(each) for each in findings],
        "warnings": [f"{each.name}: {each.words}" for each in findings if each.warns],
    }
    return replace(programme, report={**programme.report, **words})


def wrong_items(programme: Programme) -> str:
    """Items of the verification that failed, bounds apart: those are told as such. Empty where none."""
    found = programme.report.get("verification", ())
    wrong = [each for each in found if not each["passed"] and "bound" not in each["name"].split()]
    told = [f"{each['name']} {each['value']:.3g}, at most {each['limit']:.3g}, {each['words']}" for each in wrong]
    return "; ".join(told)
